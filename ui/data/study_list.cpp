#include "ui/data/study_list.h"

#include <QCollator>
#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <utility>

namespace volumen {

namespace {

// The sort key of a row: compared by the number, then by the text.
struct SortKey {
  std::int64_t number = 0;
  QCollatorSortKey text;
};

class SortKeys {
 public:
  SortKey operator()(const std::string& text, std::int64_t number = 0) const {
    return {number, collator_.sortKey(QString::fromStdString(text).toCaseFolded())};
  }

 private:
  QCollator collator_;
};

bool isBefore(const SortKey& a, const SortKey& b) {
  return a.number != b.number ? a.number < b.number : a.text.compare(b.text) < 0;
}

// Sorts by the key that `keyOf` makes of each row. Rows with equal keys keep their order.
template <class Row, class KeyOf>
void sortRows(std::vector<Row>& rows, bool ascending, const KeyOf& keyOf) {
  std::vector<std::pair<SortKey, std::size_t>> order;
  order.reserve(rows.size());
  for (std::size_t n = 0; n < rows.size(); ++n) order.emplace_back(keyOf(rows[n]), n);
  std::ranges::stable_sort(order, [&](const auto& a, const auto& b) {
    return ascending ? isBefore(a.first, b.first) : isBefore(b.first, a.first);
  });
  std::vector<Row> sorted;
  sorted.reserve(rows.size());
  for (const auto& [key, n] : order) sorted.push_back(std::move(rows[n]));
  rows = std::move(sorted);
}

using Places = std::map<std::int64_t, QString>;

SortKey studyKey(const IndexedStudy& study, StudyColumn by, const SortKeys& keys, const Places& places) {
  switch (by) {
    case StudyColumn::place: {
      const auto place = places.find(study.id);
      return keys(place == places.end() ? std::string() : place->second.toStdString());
    }
    case StudyColumn::name:
      return keys(study.patientName);
    case StudyColumn::id:
      return keys(study.patientId);
    case StudyColumn::date:
      return keys(study.date + study.time);
    case StudyColumn::modality:
      return keys(study.modalities);
    case StudyColumn::description:
      return keys(study.description);
    case StudyColumn::birthDate:
      return keys(study.birthDate);
    case StudyColumn::sex:
      return keys(study.sex);
    case StudyColumn::accession:
      return keys(study.accessionNumber);
    case StudyColumn::institution:
      return keys(study.institution);
    case StudyColumn::images:
      break;
  }
  return keys({}, study.images);
}

SortKey patientKey(const ListedPatient& patient, StudyColumn by, const SortKeys& keys, const Places& places) {
  if (by == StudyColumn::date) return keys(patient.date);
  if (by == StudyColumn::modality) return keys(patient.modalities);
  if (by == StudyColumn::images) return keys({}, patient.images);
  return studyKey(patient.studies.front(), by, keys, places);
}

void addUp(ListedPatient& patient) {
  std::set<std::string> modalities;
  patient.offline = true;
  for (const IndexedStudy& study : patient.studies) {
    patient.images = study.images < 0 || patient.images < 0 ? -1 : patient.images + study.images;
    patient.warnings += study.warnings;
    patient.date = std::max(patient.date, study.date);
    patient.offline = patient.offline && study.offline;
    for (std::size_t at = 0; at < study.modalities.size();) {
      const std::size_t comma = std::min(study.modalities.find(", ", at), study.modalities.size());
      modalities.insert(study.modalities.substr(at, comma - at));
      at = comma + 2;
    }
  }
  for (const std::string& modality : modalities)
    patient.modalities += (patient.modalities.empty() ? "" : ", ") + modality;
}

std::vector<IndexedStudy> openedLast(const std::vector<IndexedStudy>& studies, std::size_t most) {
  std::vector<IndexedStudy> opened;
  std::ranges::copy_if(studies, std::back_inserter(opened),
                       [](const IndexedStudy& s) { return !s.openedAt.empty(); });
  std::ranges::stable_sort(opened, std::greater(), &IndexedStudy::openedAt);
  if (opened.size() > most) opened.resize(most);
  return opened;
}

std::int64_t numberIn(const std::string& text) {
  std::int64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

StudyList listedStudies(std::vector<IndexedStudy> studies, const StudySort& sort, std::size_t mostRecent,
                        std::map<std::int64_t, QString> places) {
  StudyList list;
  list.places = std::move(places);
  list.recent = openedLast(studies, mostRecent);
  const SortKeys keys;
  sortRows(studies, sort.ascending,
           [&](const IndexedStudy& study) { return studyKey(study, sort.by, keys, list.places); });
  std::map<std::pair<std::string, std::string>, std::size_t> rows;
  for (IndexedStudy& study : studies) {
    const auto [row, isNew] = rows.try_emplace({study.patientId, study.patientName}, list.patients.size());
    if (isNew) list.patients.emplace_back();
    list.patients[row->second].studies.push_back(std::move(study));
  }
  for (ListedPatient& patient : list.patients) addUp(patient);
  sortRows(list.patients, sort.ascending,
           [&](const ListedPatient& patient) { return patientKey(patient, sort.by, keys, list.places); });
  return list;
}

std::vector<IndexedSeries> sortedSeries(std::vector<IndexedSeries> series, const StudySort& sort) {
  const SortKeys keys;
  sortRows(series, sort.ascending, [&](const IndexedSeries& s) {
    switch (sort.by) {
      case StudyColumn::name:
        return keys(s.number, numberIn(s.number));
      case StudyColumn::date:
        return keys(s.date + s.time);
      case StudyColumn::modality:
        return keys(s.modality);
      case StudyColumn::description:
        return keys(s.description);
      case StudyColumn::images:
        return keys({}, s.images);
      case StudyColumn::id:
      case StudyColumn::birthDate:
      case StudyColumn::sex:
      case StudyColumn::accession:
      case StudyColumn::institution:
      case StudyColumn::place:
        break;
    }
    return keys({});
  });
  return series;
}

}  // namespace volumen
