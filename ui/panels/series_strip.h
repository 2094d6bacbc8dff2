#pragma once

#include <QListWidget>
#include <set>

#include "ui/data/study_list.h"

namespace volumen {

/// The series of one study as thumbnails with what they are below; "!" where there is a warning, its sentence
/// in the tooltip; those whose files are not there are grey. Thumbnails are wanted for what is visible alone.
class SeriesStrip : public QListWidget {
  Q_OBJECT
 public:
  explicit SeriesStrip(QWidget* parent = nullptr);

  /// 0 and null: of no study.
  void showStudy(std::int64_t study, const SeriesListPtr& series);
  std::int64_t study() const { return study_; }
  /// Null: there is none.
  void setThumbnail(std::int64_t series, const QImage& thumbnail);
  /// Writes all again, after names were hidden or shown.
  void showNames();
  /// What an item stands for.
  IndexedChoice choiceOf(const QListWidgetItem* item) const;
  /// Null: it is not of this study.
  const IndexedSeries* seriesOf(const QListWidgetItem* item) const;

 Q_SIGNALS:
  /// Of these alone, the first one first.
  void thumbnailsWanted(const std::vector<std::int64_t>& series);

 protected:
  QStringList mimeTypes() const override;
  QMimeData* mimeData(const QList<QListWidgetItem*>& items) const override;
  void resizeEvent(QResizeEvent*) override;
  void showEvent(QShowEvent*) override;

 private:
  void wantVisible();

  std::int64_t study_ = 0;
  SeriesListPtr series_ = std::make_shared<const std::vector<IndexedSeries>>();
  std::set<std::int64_t> made_;  // series that have their thumbnail, or have none
};

}  // namespace volumen
