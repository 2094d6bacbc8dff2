#pragma once

#include <QListWidget>
#include <set>

#include "ui/data/study_list.h"

namespace volumen {

/// The series of one study as thumbnails with captions. "!" marks a warning, told by the tooltip. Grey series
/// are offline. Requests thumbnails of visible items only.
class SeriesStrip : public QListWidget {
  Q_OBJECT
 public:
  explicit SeriesStrip(QWidget* parent = nullptr);

  /// Sets the key of the source whose series are shown.
  void setSource(const QString& key) { source_ = key; }
  /// Shows the series of a study. 0 and null show nothing.
  void showStudy(std::int64_t study, const SeriesListPtr& series);
  std::int64_t study() const { return study_; }
  /// Sets a thumbnail; null if the series has none.
  void setThumbnail(std::int64_t series, const QImage& thumbnail);
  /// Rewrites all texts after names were hidden or shown.
  void showNames();
  /// Returns the study and series of an item.
  IndexedChoice choiceOf(const QListWidgetItem* item) const;
  /// Returns null if the item is not of this study.
  const IndexedSeries* seriesOf(const QListWidgetItem* item) const;

 Q_SIGNALS:
  /// Requests only these thumbnails, in this order.
  void thumbnailsWanted(const std::vector<std::int64_t>& series);

 protected:
  QStringList mimeTypes() const override;
  QMimeData* mimeData(const QList<QListWidgetItem*>& items) const override;
  void resizeEvent(QResizeEvent*) override;
  void showEvent(QShowEvent*) override;

 private:
  void wantVisible();

  QString source_;
  std::int64_t study_ = 0;
  SeriesListPtr series_ = std::make_shared<const std::vector<IndexedSeries>>();
  std::set<std::int64_t> made_;  // series whose thumbnail is set or does not exist
};

}  // namespace volumen
