#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/index/index.h"

namespace volumen {

/// The columns of the study browser, by which it can be sorted.
enum class StudyColumn {
  name,
  id,
  date,
  modality,
  description,
  images,
  birthDate,
  sex,
  accession,
  institution
};

/// The studies of one patient, as they stand below each other.
struct ListedPatient {
  std::vector<IndexedStudy> studies;  ///< never empty
  int images = 0, warnings = 0;       ///< of all of them
  std::string modalities;             ///< of all of them: "CT, MR", sorted
  std::string date;                   ///< of the latest
  bool offline = false;               ///< all of them are
  bool operator==(const ListedPatient&) const = default;

  /// What tells patients apart.
  std::string key() const { return studies.front().patientId + '\n' + studies.front().patientName; }
};

/// What the study browser lists.
struct StudyList {
  std::vector<IndexedStudy> recent;  ///< opened last, the latest first
  std::vector<ListedPatient> patients;
  bool operator==(const StudyList&) const = default;
};

/// Whether `a` stands before `b` by a column; names by the rules of the user's language.
struct StudySort {
  StudyColumn by = StudyColumn::date;
  bool ascending = false;
  bool operator==(const StudySort&) const = default;
};

/// The studies below their patients, both sorted; `recent` holds at most `mostRecent` of those that were ever
/// opened.
StudyList listedStudies(std::vector<IndexedStudy> studies, const StudySort& sort, std::size_t mostRecent);

/// The series of a study likewise, by number where the column is the name; those alike stay in their order.
std::vector<IndexedSeries> sortedSeries(std::vector<IndexedSeries> series, const StudySort& sort);

using StudyListPtr = std::shared_ptr<const StudyList>;
using SeriesListPtr = std::shared_ptr<const std::vector<IndexedSeries>>;

/// What was chosen to be opened: a study of the index, or one of its series (0: none in particular).
struct IndexedChoice {
  std::int64_t study = 0, series = 0;
  bool operator==(const IndexedChoice&) const = default;
};

}  // namespace volumen
