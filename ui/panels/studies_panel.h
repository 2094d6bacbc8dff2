#pragma once

#include <QLineEdit>
#include <QTreeWidget>
#include <vector>

#include "ui/controller/thumbnails.h"
#include "ui/data/loaded_series.h"
#include "ui/document/open_studies.h"

class QMenu;
class QMimeData;

namespace volumen {

/// What was opened: patients, studies, series of slices or frames with a thumbnail, the steps of one series
/// (in time, by direction) in one row; "!" where there is a warning, all that is known in the tooltip. Below
/// them the objects that refer to pictures, with how many of these are not in the list. A click asks for a
/// series or an object, a right click for what else can be done with it. What could not be read is named
/// below with its reason.
class StudiesPanel : public QWidget {
  Q_OBJECT
 public:
  explicit StudiesPanel(OpenStudies& studies, QWidget* parent = nullptr);

  /// Wide enough for how many slices a series has, and in which plane.
  int fittingWidth() const;
  /// Writes all again, after names were hidden or shown.
  void showNames();
  /// Marks the series on screen; its volume, where it is in memory, has the thumbnail at once.
  void markShown(const Series& shown, const VolumePtr& volume);
  /// Those that rows stand for: of the steps of a series the one that a click shows.
  std::vector<const Series*> listedSeries() const;
  QTreeWidget* tree() const { return tree_; }
  /// The series that is dragged; null where it is not in the list.
  const Series* seriesOf(const QMimeData& dragged) const;

 Q_SIGNALS:
  void seriesChosen(const volumen::Series& series);
  void objectChosen(const volumen::DerivedObjectPtr& object);
  void attributesRequested(const volumen::Series& series);
  /// Segments of these objects are to be edited.
  void segmentsRequested(const QStringList& paths);
  /// They are to be taken off the list.
  void removeRequested(const std::vector<volumen::SeriesKey>& series,
                       const std::vector<volumen::DerivedKey>& derived);
  /// All that is listed is to be closed.
  void closeAllRequested(const volumen::Unlisted& listed);

 private:
  const OpenStudy* openedOf(const QTreeWidgetItem* item) const;
  const Series* seriesOf(const QTreeWidgetItem* item) const;
  std::vector<const Series*> stepsOf(const QTreeWidgetItem* item) const;
  DerivedObjectPtr derivedObjectOf(const QTreeWidgetItem* item) const;
  QTreeWidgetItem* studyItem(const Series& series);
  QTreeWidgetItem* childNamed(QTreeWidgetItem* parent, const QString& key, const QString& text);
  void showStudy(const QString& path);
  void showUnlisted(bool comesBack);
  void addSeries(const OpenStudy& opened, std::vector<std::size_t> row);
  void addDerivedObject(const OpenStudy& opened, std::size_t n);
  void showDerivedObjects();
  void addRefused(const QString& path, const Study& study);
  void setThumbnail(const Series& series, const QImage& thumbnail);
  void showMenu(QPoint position);
  void remove(QTreeWidgetItem* item);
  void closeAll();
  void removePath(const QString& path);
  void filter(const QString& text);

  OpenStudies& studies_;
  QLineEdit* search_;
  QTreeWidget* tree_;
  Thumbnails thumbnails_;
};

}  // namespace volumen
