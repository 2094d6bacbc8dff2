#pragma once

#include <QLineEdit>
#include <QTreeWidget>
#include <memory>
#include <vector>

#include "ui/controller/thumbnails.h"
#include "ui/data/reference_key.h"
#include "ui/data/series_key.h"
#include "ui/data/shown_series.h"
#include "ui/workspace/workspace.h"

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
  explicit StudiesPanel(QWidget* parent = nullptr);

  /// Wide enough for how many slices a series has, and in which plane.
  int fittingWidth() const;
  /// Adds what a path holds, instead of what it held when it was opened before.
  void addStudy(const QString& path, const std::shared_ptr<const Study>& study);
  /// What was added by this path; null: nothing that is in the list.
  std::shared_ptr<const Study> studyOf(const QString& path) const;
  /// What of it is not in the list.
  void setUnlisted(const Unlisted& unlisted);
  /// Writes all again, after names were hidden or shown.
  void showNames();
  /// Marks the series on screen; its volume, where it is in memory, has the thumbnail at once.
  void markShown(const Series& shown, const VolumePtr& volume);
  /// All volumes that are in the list.
  std::vector<const Series*> allSeries() const;
  /// Those that rows stand for: of the steps of a series the one that a click shows.
  std::vector<const Series*> listedSeries() const;
  /// The same and the frames of what is no volume.
  std::vector<const Series*> allPictures() const;
  /// All objects that refer to pictures.
  std::vector<ReferencePtr> references() const;
  /// The files that have no pictures and are no such objects, each with what it is: "F: DICOM file without
  /// pixel data (CR)".
  QStringList filesWithoutPixels() const;
  QTreeWidget* tree() const { return tree_; }
  /// The mime type of a series that is dragged.
  static inline const QString draggedSeries = QStringLiteral("application/x-volumen-series");
  /// The series that is dragged; null where it is not in the list.
  const Series* seriesOf(const QMimeData& dragged) const;

 Q_SIGNALS:
  void seriesChosen(const volumen::Series& series);
  void referenceChosen(const volumen::ReferencePtr& object);
  /// Of what is open.
  void listChanged();
  /// They are to be taken off the list.
  void removeRequested(const std::vector<volumen::SeriesKey>& series,
                       const std::vector<volumen::ReferenceKey>& references);
  /// All that is listed is to be closed.
  void closeAllRequested(const volumen::Unlisted& listed);

 private:
  struct Opened {
    QString path;
    std::shared_ptr<const Study> study;
    std::vector<Series> frames;  // of what is no volume

    // First the volumes, then the frames; null beyond them.
    const Series* seriesAt(std::size_t n) const;
    // The number of a volume.
    std::size_t numberOf(const Series& volume) const { return std::size_t(&volume - study->volumes.data()); }
    // The numbers of all, the steps of one series together and in their order.
    std::vector<std::vector<std::size_t>> rows() const;
  };

  const Opened* openedOf(const QTreeWidgetItem* item) const;
  const Series* seriesOf(const QTreeWidgetItem* item) const;
  std::vector<const Series*> stepsOf(const QTreeWidgetItem* item) const;
  ReferencePtr referenceOf(const QTreeWidgetItem* item) const;
  bool isListed(const Series& series) const { return !unlisted_.series.contains(keyOf(series)); }
  bool isListed(const Opened& opened) const;
  bool isListed(const Reference& object) const { return !unlisted_.references.contains(keyOf(object)); }
  QTreeWidgetItem* studyItem(const Series& series);
  QTreeWidgetItem* childNamed(QTreeWidgetItem* parent, const QString& key, const QString& text);
  void addSeries(const Opened& opened, std::vector<std::size_t> row);
  void addReference(const Opened& opened, std::size_t n);
  void showReferences();
  void addRefused(const QString& path, const Study& study);
  void setThumbnail(const Series& series, const QImage& thumbnail);
  void showMenu(QPoint position);
  void remove(QTreeWidgetItem* item);
  void closeAll();
  void removePath(const QString& path);
  void filter(const QString& text);

  QLineEdit* search_;
  QTreeWidget* tree_;
  Thumbnails thumbnails_;
  std::vector<Opened> studies_;  // those that are closed, too: undo brings them back
  Unlisted unlisted_;
};

}  // namespace volumen
