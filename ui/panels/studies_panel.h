#pragma once

#include <QLineEdit>
#include <QTreeWidget>
#include <vector>

#include "results/series/loaded_series.h"
#include "ui/controller/thumbnails.h"
#include "ui/document/open_studies.h"

class QMenu;
class QMimeData;

namespace volumen {

/// The open studies: patients, studies and series with thumbnails. Time points or directions of a series
/// share a row. "!" marks a warning, and tooltips tell all details. Objects that refer to pictures follow,
/// with the number of pictures missing from the list. A click requests a series or object, a right click
/// opens a menu. Unreadable files are listed below with the reason.
class StudiesPanel : public QWidget {
  Q_OBJECT
 public:
  StudiesPanel(OpenStudies& studies, FrameService& frames, QWidget* parent = nullptr);

  /// Returns the width that shows the number of slices of a series and their plane, pixels.
  int fittingWidth() const;
  /// Rewrites all texts after names were hidden or shown.
  void showNames();
  /// Marks the series on screen. Draws its thumbnail at once if its volume is loaded.
  void markShown(const Series& shown, const VolumePtr& volume);
  /// Returns one series per row: of several time points the one that a click shows.
  std::vector<const Series*> listedSeries() const;
  QTreeWidget* tree() const { return tree_; }
  /// Returns the dragged series, or null if it is not in the list.
  const Series* seriesOf(const QMimeData& dragged) const;
  /// Sets whether a dragged series also gives its files to other programs.
  void setDragsFiles(bool on) { dragsFiles_ = on; }

 Q_SIGNALS:
  void seriesChosen(const volumen::Series& series);
  void objectChosen(const volumen::DerivedObjectPtr& object);
  void attributesRequested(const volumen::Series& series);
  /// Requests to edit the segments of these objects.
  void segmentsRequested(const QStringList& paths);
  void sendRequested(const volumen::DerivedObjectPtr& object);
  /// Requests to remove these from the list.
  void removeRequested(const std::vector<volumen::SeriesKey>& series,
                       const std::vector<volumen::DerivedKey>& derived);
  /// Requests to close all listed studies.
  void closeAllRequested(const volumen::Unlisted& listed);

 private:
  const OpenStudy* openedOf(const QTreeWidgetItem* item) const;
  const Series* seriesOf(const QTreeWidgetItem* item) const;
  QStringList draggedFiles(const QMimeData& dragged) const;
  std::vector<const Series*> stepsOf(const QTreeWidgetItem* item) const;
  DerivedObjectPtr derivedObjectOf(const QTreeWidgetItem* item) const;
  QTreeWidgetItem* studyItem(const Series& series);
  QTreeWidgetItem* childNamed(QTreeWidgetItem* parent, const QString& key, const QString& text);
  void showStudy(const QString& path);
  void showUnlisted(bool comesBack);
  void addSeries(const OpenStudy& opened, std::vector<std::size_t> row);
  void addDerivedObject(const OpenStudy& opened, std::size_t n);
  void addObjectEntries(QMenu* menu, const DerivedObjectPtr& object);
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
  bool dragsFiles_ = true;
};

}  // namespace volumen
