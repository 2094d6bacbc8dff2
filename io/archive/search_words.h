#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/index/index.h"

namespace volumen {

/// A range of dates, YYYYMMDD, ends included.
struct DateRange {
  std::string first, last;
  bool operator==(const DateRange&) const = default;
};

/// A word of a search, with all that it may mean.
struct SearchWord {
  std::string text;                ///< part of a name, an ID, an accession number or a description; NFC
  std::string modality;            ///< a defined term: "CT"; may be empty
  std::optional<DateRange> dates;  ///< 2026-03-14, 20260314, 14.3.2026, 2026-03, 2026, 20260101-20260314
  bool operator==(const SearchWord&) const = default;
};

/// Returns the words as a user types them. `now` is a date, YYYYMMDD, for "today" and "yesterday".
std::vector<SearchWord> searchWords(const std::string& words, const std::string& now);

/// Returns whether a study has all words, each in one of its meanings. The comparison ignores case and
/// accents, in any script.
bool hasAll(const std::vector<SearchWord>& words, const IndexedStudy& study);

/// The keys of one question at the level of studies (PS3.4 C.6.2.1), UTF-8, with wildcards. Empty ones match
/// everything.
struct StudyKeys {
  std::string patientName, patientId, accessionNumber, description, dates, modality;
  bool operator==(const StudyKeys&) const = default;
};

/// Returns questions that together find the studies with these words. They ask for one word only, the one
/// that fewest studies should have, so their answers must be tested by hasAll(). Some archives distinguish
/// case, and some cannot compare what is not ASCII. So a text is asked for as typed, in capitals, in small
/// letters, capitalised, and with wildcards for what is not ASCII. A question that matches everything is the
/// last.
std::vector<StudyKeys> questionsFor(const std::vector<SearchWord>& words);

}  // namespace volumen
