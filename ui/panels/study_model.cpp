#include "ui/panels/study_model.h"

#include <QGuiApplication>
#include <QLocale>
#include <QMimeData>
#include <QPalette>
#include <QUrl>
#include <QUuid>
#include <algorithm>
#include <tuple>

#include "results/text/text.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/dragged_series.h"
#include "ui/workspace/indexed_text.h"

namespace volumen {

namespace {

// Packs the position of a row into the 64 bits of an index: group or patient `top`, `study` below it.
enum class RowKind : quintptr { top, study, series };

quintptr packed(RowKind kind, int top = 0, int study = 0) {
  return quintptr(kind) | quintptr(top) << 2 | quintptr(study) << 34;
}
RowKind kindOf(const QModelIndex& index) { return RowKind(index.internalId() & 3); }
int topOf(const QModelIndex& index) { return int(index.internalId() >> 2 & 0xffffffffu); }
int studyOf(const QModelIndex& index) { return int(index.internalId() >> 34); }

// Tells choices of this program from those of others, whose numbers mean other studies.
const QByteArray& programToken() {
  static const QByteArray token = QUuid::createUuid().toByteArray(QUuid::WithoutBraces);
  return token;
}

QString marked(bool hasWarnings, const QString& text) {
  return hasWarnings ? QStringLiteral("! ") + text : text;
}

QString studyCell(const IndexedStudy& study, StudyColumn column) {
  switch (column) {
    case StudyColumn::name:
      return marked(study.warnings > 0, patientNameText(study.patientName));
    case StudyColumn::id:
      return idText(study.patientId);
    case StudyColumn::date:
      return dateText(study.date);
    case StudyColumn::modality:
      return shownText(study.modalities);
    case StudyColumn::description:
      return shownText(study.description);
    case StudyColumn::birthDate:
      return dateText(study.birthDate);
    case StudyColumn::sex:
      return shownText(study.sex);
    case StudyColumn::accession:
      return idText(study.accessionNumber);
    case StudyColumn::institution:
      return institutionText(study.institution);
    case StudyColumn::place:
      return {};
    case StudyColumn::images:
      break;
  }
  return countText(study.images);
}

QString seriesCell(const IndexedSeries& series, StudyColumn column) {
  switch (column) {
    case StudyColumn::name:
      return marked(!series.warnings.empty(), seriesNameText(series));
    case StudyColumn::id:
    case StudyColumn::birthDate:
    case StudyColumn::sex:
    case StudyColumn::accession:
    case StudyColumn::institution:
    case StudyColumn::place:
      return {};
    case StudyColumn::date:
      return dateText(series.date);
    case StudyColumn::modality:
      return shownText(series.modality);
    case StudyColumn::description:
      return contentText(series);
    case StudyColumn::images:
      break;
  }
  return countText(std::max(series.images, series.frames));
}

}  // namespace

// "TOKEN:KEY:STUDY:SERIES", the key in percent-encoding.
QMimeData* draggedChoice(const SourceChoice& choice) {
  auto* dragged = new QMimeData;
  const QByteArrayList parts{programToken(), QUrl::toPercentEncoding(choice.source),
                             QByteArray::number(qint64(choice.choice.study)),
                             QByteArray::number(qint64(choice.choice.series))};
  dragged->setData(draggedSeriesType, parts.join(':'));
  return dragged;
}

std::optional<SourceChoice> choiceIn(const QMimeData& dragged) {
  const QByteArrayList parts = dragged.data(draggedSeriesType).split(':');
  if (parts.size() != 4 || parts[0] != programToken()) return {};
  return SourceChoice{QUrl::fromPercentEncoding(parts[1]), {parts[2].toLongLong(), parts[3].toLongLong()}};
}

StudyModel::StudyModel(QObject* parent) : QAbstractItemModel(parent) {}

void StudyModel::setList(const StudyListPtr& list, const StudySort& sort) {
  beginResetModel();
  list_ = list;
  const bool isOther = std::exchange(sort_, sort) != sort;
  if (isOther)
    for (auto& [study, series] : series_)
      series = std::make_shared<const std::vector<IndexedSeries>>(sortedSeries(*series, sort_));
  wanted_.clear();
  tops_.clear();
  auto gone = std::exchange(series_, {});
  for (const ListedPatient& patient : list_->patients)
    for (const IndexedStudy& study : patient.studies) series_.insert(gone.extract(study.id));
  endResetModel();
  for (const auto& [study, series] : series_) Q_EMIT seriesWanted(study);
}

void StudyModel::setSeries(std::int64_t study, const SeriesListPtr& series) {
  auto sorted = std::make_shared<const std::vector<IndexedSeries>>(sortedSeries(*series, sort_));
  SeriesListPtr& known = series_[study];
  if (known && *known == *sorted) return;
  // Updates the study below its patient and in the recent group.
  Q_EMIT layoutAboutToBeChanged();
  known = std::move(sorted);
  for (const QModelIndex& index : persistentIndexList()) {
    const bool isGone = kindOf(index) == RowKind::series && !seriesAt(index);
    if (isGone) changePersistentIndex(index, {});
  }
  Q_EMIT layoutChanged();
}

void StudyModel::showNames() {
  Q_EMIT layoutAboutToBeChanged();
  Q_EMIT layoutChanged();
}

const std::vector<IndexedStudy>& StudyModel::studiesBelow(int top) const {
  if (hasRecent() && top == 0) return list_->recent;
  return list_->patients[std::size_t(top - hasRecent())].studies;
}

const ListedPatient* StudyModel::patientAt(const QModelIndex& index) const {
  if (!index.isValid() || kindOf(index) != RowKind::top || isRecentGroup(index)) return nullptr;
  return &list_->patients[std::size_t(index.row() - hasRecent())];
}

bool StudyModel::isRecentGroup(const QModelIndex& index) const {
  return index.isValid() && kindOf(index) == RowKind::top && hasRecent() && index.row() == 0;
}

const IndexedStudy* StudyModel::studyAt(const QModelIndex& index) const {
  if (!index.isValid()) return nullptr;
  if (const ListedPatient* patient = patientAt(index))
    return patient->studies.size() == 1 ? &patient->studies.front() : nullptr;
  if (kindOf(index) == RowKind::top) return nullptr;
  const std::size_t n = std::size_t(kindOf(index) == RowKind::study ? index.row() : studyOf(index));
  return &studiesBelow(topOf(index))[n];
}

const IndexedSeries* StudyModel::seriesAt(const QModelIndex& index) const {
  if (!index.isValid() || kindOf(index) != RowKind::series) return nullptr;
  const auto known = series_.find(studyAt(index)->id);
  if (known == series_.end() || std::size_t(index.row()) >= known->second->size()) return nullptr;
  return &(*known->second)[std::size_t(index.row())];
}

IndexedChoice StudyModel::choiceAt(const QModelIndex& index) const {
  const IndexedStudy* study = studyAt(index);
  const IndexedSeries* series = seriesAt(index);
  return study ? IndexedChoice{study->id, series ? series->id : 0} : IndexedChoice{};
}

QModelIndex StudyModel::latestOf(const QModelIndex& index) const {
  const ListedPatient* patient = patientAt(index);
  if (!patient || patient->studies.size() < 2) return index;
  const auto latest = std::ranges::max_element(patient->studies, [](const auto& a, const auto& b) {
    return std::tie(a.date, a.time) < std::tie(b.date, b.time);
  });
  return this->index(int(latest - patient->studies.begin()), 0, index.siblingAtColumn(0));
}

std::vector<std::int64_t> StudyModel::studiesOf(const QModelIndex& index) const {
  if (!index.isValid() || isRecentGroup(index) || kindOf(index) == RowKind::series) return {};
  if (kindOf(index) == RowKind::study) return {studyAt(index)->id};
  std::vector<std::int64_t> studies;
  for (const IndexedStudy& study : patientAt(index)->studies) studies.push_back(study.id);
  return studies;
}

QModelIndex StudyModel::firstPatient() const { return index(hasRecent(), 0); }

StudyRowKey StudyModel::keyOf(const QModelIndex& index) const {
  if (!index.isValid()) return {};
  if (isRecentGroup(index)) return {.recent = true};
  const bool recent = hasRecent() && topOf(index) == 0 && kindOf(index) != RowKind::top;
  const ListedPatient* patient = patientAt(index);
  const IndexedStudy& study = patient ? patient->studies.front() : *studyAt(index);
  const IndexedSeries* series = seriesAt(index);
  return {recent, study.patientId, study.patientName, patient ? 0 : study.id, series ? series->id : 0};
}

// Returns the row of a patient; -1 if there is none.
int StudyModel::topOfPatient(const StudyRowKey& key) const {
  if (tops_.empty())
    for (int top = hasRecent(); top < rowCount(); ++top)
      tops_[list_->patients[std::size_t(top - hasRecent())].key()] = top;
  const auto found = tops_.find(key.patientId + '\n' + key.patientName);
  return found == tops_.end() ? -1 : found->second;
}

QModelIndex StudyModel::indexOf(const StudyRowKey& key) const {
  if (key == StudyRowKey{}) return {};
  if (key.recent && !hasRecent()) return {};
  const int top = key.recent ? 0 : topOfPatient(key);
  if (top < 0 || key.study == 0) return index(top, 0);
  const std::vector<IndexedStudy>& studies = studiesBelow(top);
  const auto study = std::ranges::find(studies, key.study, &IndexedStudy::id);
  if (study == studies.end()) return {};
  const QModelIndex found = index(int(study - studies.begin()), 0, index(top, 0));
  for (int n = 0; key.series != 0 && n < rowCount(found); ++n)
    if (seriesAt(index(n, 0, found))->id == key.series) return index(n, 0, found);
  return key.series == 0 ? found : QModelIndex();
}

QModelIndex StudyModel::index(int row, int column, const QModelIndex& parent) const {
  if (row < 0 || column < 0 || column >= columnCount() || row >= rowCount(parent)) return {};
  if (!parent.isValid()) return createIndex(row, column, packed(RowKind::top));
  if (kindOf(parent) == RowKind::top) return createIndex(row, column, packed(RowKind::study, parent.row()));
  return createIndex(row, column, packed(RowKind::series, topOf(parent), parent.row()));
}

QModelIndex StudyModel::parent(const QModelIndex& child) const {
  if (!child.isValid() || kindOf(child) == RowKind::top) return {};
  if (kindOf(child) == RowKind::study) return createIndex(topOf(child), 0, packed(RowKind::top));
  return createIndex(studyOf(child), 0, packed(RowKind::study, topOf(child)));
}

int StudyModel::rowCount(const QModelIndex& parent) const {
  if (!parent.isValid()) return int(list_->patients.size()) + hasRecent();
  if (parent.column() != 0 || kindOf(parent) == RowKind::series) return 0;
  if (kindOf(parent) == RowKind::top) return int(studiesBelow(parent.row()).size());
  const auto known = series_.find(studyAt(parent)->id);
  return known == series_.end() ? 0 : int(known->second->size());
}

int StudyModel::columnCount(const QModelIndex&) const { return int(StudyColumn::place) + 1; }

bool StudyModel::hasChildren(const QModelIndex& parent) const {
  if (parent.isValid() && parent.column() == 0 && kindOf(parent) == RowKind::study)
    return studyAt(parent)->series != 0;
  return rowCount(parent) > 0;
}

bool StudyModel::canFetchMore(const QModelIndex& parent) const {
  return parent.isValid() && kindOf(parent) == RowKind::study && !series_.contains(studyAt(parent)->id) &&
         !wanted_.contains(studyAt(parent)->id);
}

void StudyModel::fetchMore(const QModelIndex& parent) {
  if (!canFetchMore(parent)) return;
  const std::int64_t study = studyAt(parent)->id;
  wanted_.insert(study);
  Q_EMIT seriesWanted(study);
}

QString StudyModel::patientCell(const ListedPatient& patient, StudyColumn column) const {
  const IndexedStudy& first = patient.studies.front();
  switch (column) {
    case StudyColumn::name:
      return marked(patient.warnings > 0, patientNameText(first.patientName));
    case StudyColumn::id:
    case StudyColumn::birthDate:
    case StudyColumn::sex:
      return studyCell(first, column);
    case StudyColumn::accession:
    case StudyColumn::institution:
      return patient.studies.size() == 1 ? studyCell(first, column) : QString();
    case StudyColumn::date:
      return dateText(patient.date);
    case StudyColumn::modality:
      return shownText(patient.modalities);
    case StudyColumn::description:
      return patient.studies.size() == 1 ? studyCell(first, column)
                                         : tr("%1 studies").arg(QLocale().toString(patient.studies.size()));
    case StudyColumn::place:
      return {};
    case StudyColumn::images:
      break;
  }
  return countText(patient.images);
}

// Returns the places of a study, or of all studies of a patient.
QString StudyModel::placesOf(const QModelIndex& index) const {
  QStringList places;
  for (const std::int64_t study : studiesOf(index))
    if (const auto place = list_->places.find(study); place != list_->places.end()) places << place->second;
  places.removeDuplicates();
  return places.join(QStringLiteral(", "));
}

QString StudyModel::cell(const QModelIndex& index) const {
  const auto column = StudyColumn(index.column());
  if (isRecentGroup(index)) return column == StudyColumn::name ? tr("Opened last") : QString();
  if (const IndexedSeries* series = seriesAt(index)) return seriesCell(*series, column);
  if (column == StudyColumn::place) return placesOf(index);
  const ListedPatient* patient = patientAt(index);
  const IndexedStudy* study = kindOf(index) == RowKind::study ? studyAt(index) : nullptr;
  const QString text = patient ? patientCell(*patient, column)
                       : study ? studyCell(*study, column)
                               : QString();
  return column == StudyColumn::name && isHere(index) ? tr("%1 (here)").arg(text) : text;
}

QString StudyModel::toolTip(const QModelIndex& index) const {
  if (const IndexedSeries* series = seriesAt(index)) return toolTipOf(everythingOf(*series));
  if (const IndexedStudy* study = studyAt(index)) {
    QStringList lines = everythingOf(*study);
    if (const auto here = list_->here.find(study->id); here != list_->here.end())
      lines << tr("On this computer: %1 of its images").arg(countText(here->second));
    if (isKept_ && isKept_(study->studyUid)) lines << tr("Kept on this computer when room is short");
    return toolTipOf(lines);
  }
  const ListedPatient* patient = patientAt(index);
  if (!patient) return {};
  const IndexedStudy& first = patient->studies.front();
  return toolTipOf(
      {patientNameText(first.patientName), idText(first.patientId), warningsText(patient->warnings)});
}

bool StudyModel::isOffline(const QModelIndex& index) const {
  if (const IndexedSeries* series = seriesAt(index)) return series->offline;
  if (const ListedPatient* patient = patientAt(index)) return patient->offline;
  const IndexedStudy* study = studyAt(index);
  return study && study->offline;
}

// Returns whether a study, or each study of a patient, is on this computer, too.
bool StudyModel::isHere(const QModelIndex& index) const {
  const std::vector<std::int64_t> studies = studiesOf(index);
  return !studies.empty() &&
         std::ranges::all_of(studies, [&](std::int64_t study) { return list_->here.contains(study); });
}

QVariant StudyModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const bool isNumber = StudyColumn(index.column()) == StudyColumn::images;
  switch (role) {
    case Qt::DisplayRole:
      return cell(index);
    case Qt::ToolTipRole:
      return toolTip(index);
    case Qt::ForegroundRole:
      return isOffline(index) ? QGuiApplication::palette().brush(QPalette::Disabled, QPalette::Text)
                              : QVariant();
    case Qt::TextAlignmentRole:
      return isNumber ? int(Qt::AlignRight | Qt::AlignVCenter) : QVariant();
    default:
      return {};
  }
}

QVariant StudyModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (role == Qt::TextAlignmentRole)
    return int((StudyColumn(section) == StudyColumn::images ? Qt::AlignRight : Qt::AlignLeft) |
               Qt::AlignVCenter);
  const QString names[] = {tr("Name"),        tr("ID"),          tr("Date"),
                           tr("Modality"),    tr("Description"), tr("Images"),
                           tr("Birth date"),  tr("Sex"),         tr("Accession number"),
                           tr("Institution"), tr("Found in")};
  return role == Qt::DisplayRole ? names[section] : QVariant();
}

Qt::ItemFlags StudyModel::flags(const QModelIndex& index) const {
  if (!index.isValid()) return {};
  const Qt::ItemFlags shown = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
  return choiceAt(index).study != 0 ? shown | Qt::ItemIsDragEnabled : shown;
}

QStringList StudyModel::mimeTypes() const { return {draggedSeriesType}; }

QMimeData* StudyModel::mimeData(const QModelIndexList& indexes) const {
  return indexes.isEmpty() ? nullptr : draggedChoice({source_, choiceAt(indexes.front())});
}

}  // namespace volumen
