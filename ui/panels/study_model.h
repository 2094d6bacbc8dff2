#pragma once

#include <QAbstractItemModel>
#include <compare>
#include <map>
#include <optional>
#include <set>

#include "ui/data/study_list.h"

class QMimeData;

namespace volumen {

/// Of choices of the index that are dragged, under the mime type of any series that is.
QMimeData* draggedChoice(const IndexedChoice& choice);
/// Null: something else is dragged.
std::optional<IndexedChoice> choiceIn(const QMimeData& dragged);

/// Names a row of the study browser, wherever it stands: the same in the next list. Default: none.
struct StudyRowKey {
  bool recent = false;  ///< in the group of what was opened last; alone: the group
  std::string patientId = {}, patientName = {};
  std::int64_t study = 0, series = 0;
  auto operator<=>(const StudyRowKey&) const = default;
};

/// The rows of the study browser: what was opened last in a group of its own, then patients; below them
/// studies; below these their series, which are asked for when they are first wanted.
class StudyModel : public QAbstractItemModel {
  Q_OBJECT
 public:
  explicit StudyModel(QObject* parent = nullptr);

  /// Shows another list; series that are known already stay, and are asked for again.
  void setList(const StudyListPtr& list, const StudySort& sort);
  const StudyList& list() const { return *list_; }
  /// Takes the series of a study that were wanted.
  void setSeries(std::int64_t study, const SeriesListPtr& series);
  /// Writes all again, after names were hidden or shown.
  void showNames();

  /// What a row stands for; null: no such thing. A patient with one study stands for that, too.
  const IndexedStudy* studyAt(const QModelIndex& index) const;
  const IndexedSeries* seriesAt(const QModelIndex& index) const;
  /// The study, or the series; {0, 0} for groups and patients of several studies.
  IndexedChoice choiceAt(const QModelIndex& index) const;
  /// Of a patient of several studies the row of the latest; else the row itself.
  QModelIndex latestOf(const QModelIndex& index) const;
  /// All studies of a patient; else the one of the row. None of a series.
  std::vector<std::int64_t> studiesOf(const QModelIndex& index) const;
  bool isRecentGroup(const QModelIndex& index) const;
  /// The first one below the group of those opened last.
  QModelIndex firstPatient() const;
  StudyRowKey keyOf(const QModelIndex& index) const;
  /// Invalid: it is not in the list.
  QModelIndex indexOf(const StudyRowKey& key) const;

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& child) const override;
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  bool hasChildren(const QModelIndex& parent = {}) const override;
  bool canFetchMore(const QModelIndex& parent) const override;
  void fetchMore(const QModelIndex& parent) override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QStringList mimeTypes() const override;
  QMimeData* mimeData(const QModelIndexList& indexes) const override;

 Q_SIGNALS:
  /// setSeries() is wanted.
  void seriesWanted(qint64 study);

 private:
  bool hasRecent() const { return !list_->recent.empty(); }
  const ListedPatient* patientAt(const QModelIndex& index) const;
  const std::vector<IndexedStudy>& studiesBelow(int top) const;
  QString patientCell(const ListedPatient& patient, StudyColumn column) const;
  QString cell(const QModelIndex& index) const;
  QString toolTip(const QModelIndex& index) const;
  bool isOffline(const QModelIndex& index) const;

  StudyListPtr list_ = std::make_shared<const StudyList>();
  StudySort sort_;
  std::map<std::int64_t, SeriesListPtr> series_;  // by study
  std::set<std::int64_t> wanted_;                 // studies whose series were asked for
};

}  // namespace volumen
