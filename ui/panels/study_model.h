#pragma once

#include <QAbstractItemModel>
#include <compare>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "ui/data/study_list.h"

class QMimeData;

namespace volumen {

/// A choice in the list of a source, identified by its key.
struct SourceChoice {
  QString source;
  IndexedChoice choice;
};

/// Makes the drag data of a choice, under the mime type of all dragged series.
QMimeData* draggedChoice(const SourceChoice& choice);
/// Returns the dragged choice. Nothing if something else, or a choice of another running program, is dragged.
std::optional<SourceChoice> choiceIn(const QMimeData& dragged);

/// Identifies a row of the study browser, also in a new list. A default key identifies no row.
struct StudyRowKey {
  bool recent = false;  ///< in the group of recently opened studies; without other members, the group itself
  std::string patientId = {}, patientName = {};
  std::int64_t study = 0, series = 0;
  auto operator<=>(const StudyRowKey&) const = default;
};

/// The rows of the study browser: the group of recently opened studies, then patients. Their children are
/// studies, and series below them, which are requested on first use.
class StudyModel : public QAbstractItemModel {
  Q_OBJECT
 public:
  explicit StudyModel(QObject* parent = nullptr);

  /// Sets the key of the source whose studies are listed.
  void setSource(const QString& key) { source_ = key; }
  /// Sets what tells whether a study of this UID is kept on this computer.
  void setKept(std::function<bool(const std::string& studyUid)> isKept) { isKept_ = std::move(isKept); }
  /// Shows another list. Keeps known series but requests them again.
  void setList(const StudyListPtr& list, const StudySort& sort);
  const StudyList& list() const { return *list_; }
  /// Takes the requested series of a study.
  void setSeries(std::int64_t study, const SeriesListPtr& series);
  /// Rewrites all texts after names were hidden or shown.
  void showNames();

  /// Return the study or series of a row, or null. The row of a patient with one study also stands for that
  /// study.
  const IndexedStudy* studyAt(const QModelIndex& index) const;
  const IndexedSeries* seriesAt(const QModelIndex& index) const;
  /// Returns the study or series; {0, 0} for groups and for patients with several studies.
  IndexedChoice choiceAt(const QModelIndex& index) const;
  /// Returns the row of the latest study of a patient with several studies, else the row itself.
  QModelIndex latestOf(const QModelIndex& index) const;
  /// Returns all studies of a patient, or the one of the row. Empty for a series.
  std::vector<std::int64_t> studiesOf(const QModelIndex& index) const;
  bool isRecentGroup(const QModelIndex& index) const;
  /// Returns the first patient below the group of recent studies.
  QModelIndex firstPatient() const;
  StudyRowKey keyOf(const QModelIndex& index) const;
  /// Returns an invalid index if the row is not in the list.
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
  /// Requests setSeries().
  void seriesWanted(qint64 study);

 private:
  bool hasRecent() const { return !list_->recent.empty(); }
  int topOfPatient(const StudyRowKey& key) const;
  const ListedPatient* patientAt(const QModelIndex& index) const;
  const std::vector<IndexedStudy>& studiesBelow(int top) const;
  QString patientCell(const ListedPatient& patient, StudyColumn column) const;
  QString placesOf(const QModelIndex& index) const;
  QString cell(const QModelIndex& index) const;
  QString toolTip(const QModelIndex& index) const;
  bool isOffline(const QModelIndex& index) const;
  bool isHere(const QModelIndex& index) const;

  QString source_;
  std::function<bool(const std::string&)> isKept_;
  StudyListPtr list_ = std::make_shared<const StudyList>();
  StudySort sort_;
  std::map<std::int64_t, SeriesListPtr> series_;  // series by study
  mutable std::unordered_map<std::string, int>
      tops_;                       // rows of patients by their keys, once one is looked for
  std::set<std::int64_t> wanted_;  // studies whose series were requested
};

}  // namespace volumen
