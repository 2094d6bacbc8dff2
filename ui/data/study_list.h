#pragma once

#include <QString>
#include <map>
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
  institution,
  place
};

/// The studies of one patient, listed below each other.
struct ListedPatient {
  std::vector<IndexedStudy> studies;  ///< never empty
  int images = 0, warnings = 0;       ///< sums over the studies; -1 if the images of one are unknown
  std::string modalities;             ///< of all studies: "CT, MR", sorted
  std::string date;                   ///< of the latest study
  bool offline = false;               ///< true if all studies are
  bool operator==(const ListedPatient&) const = default;

  /// Returns ID and name, which identify a patient.
  std::string key() const { return studies.front().patientId + '\n' + studies.front().patientName; }
};

/// The lists of the study browser.
struct StudyList {
  std::vector<IndexedStudy> recent;  ///< the last opened ones, the latest first
  std::vector<ListedPatient> patients;
  /// Studies of an archive that are on this computer, too, with the number of their images here.
  std::map<std::int64_t, int> here{};
  std::map<std::int64_t, QString> places{};  ///< names of the places of studies, in a list of several places
  QString notice{};        ///< a sentence on the list, such as that there may be more studies; may be empty
  bool isGrowing = false;  ///< more studies may follow
  bool operator==(const StudyList&) const = default;
};

/// The column and direction to sort by. Texts are compared by the rules of the user's language.
struct StudySort {
  StudyColumn by = StudyColumn::date;
  bool ascending = false;
  bool operator==(const StudySort&) const = default;
};

/// Returns the studies below their patients, both sorted. `recent` holds at most `mostRecent` of those ever
/// opened.
StudyList listedStudies(std::vector<IndexedStudy> studies, const StudySort& sort, std::size_t mostRecent,
                        std::map<std::int64_t, QString> places = {});

/// Returns the series of a study sorted likewise, by number for the column name. Equal ones keep their order.
std::vector<IndexedSeries> sortedSeries(std::vector<IndexedSeries> series, const StudySort& sort);

using StudyListPtr = std::shared_ptr<const StudyList>;
using SeriesListPtr = std::shared_ptr<const std::vector<IndexedSeries>>;

/// The user's choice to open: a study of the index, or one of its series (0: none in particular).
struct IndexedChoice {
  std::int64_t study = 0, series = 0;
  bool operator==(const IndexedChoice&) const = default;
};

}  // namespace volumen
