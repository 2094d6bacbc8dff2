#pragma once

#include <deque>
#include <set>

#include "ui/workspace/priors.h"

namespace volumen {

/// A study that a source lists. It may hold the prior that is searched for.
struct PriorCandidate {
  int source = 0;  ///< number of the source that lists it
  IndexedStudy study{};
};

/// A search for the prior of a picture in the studies that sources list. The functions below take it from one
/// event to the next; events that it does not wait for leave it as it is.
struct PriorSearch {
  enum class Stage { none, opening, reading };
  Series series{};                          ///< the series whose prior is wanted
  int frame = -1;                           ///< index of its frame, from 0; -1: the series as such
  std::string after{};                      ///< day of the open prior, "YYYYMMDD"; empty if none is open
  bool mayOpen = true;                      ///< if false, only reports that a later prior is listed
  std::set<int> asked{};                    ///< sources that have not answered yet
  std::deque<PriorCandidate> candidates{};  ///< not opened yet: similar descriptions first, then latest first
  PriorCandidate candidate{};               ///< the one opened last
  Stage stage = Stage::none;                ///< what is being done with `candidate`
  int opened = 0;                           ///< number of candidates opened, `candidate` included
  bool isUnread = false;                    ///< a source could not be asked
  bool isAway = false;                      ///< files of a candidate are missing or have changed
};

/// The answer of a source to the question for the studies of a patient.
struct PriorAnswer {
  int source = 0;
  std::string patientId, patientName;
  std::optional<std::vector<IndexedStudy>> studies;  ///< empty if the source could not be asked
};

/// What is to be done after an event, in this order. Nothing while the search waits.
struct PriorStep {
  PriorSearch search{};         ///< the search after the event
  SeriesPicture shown{};        ///< the prior to show beside the picture, or none
  QString told{}, warned{};     ///< sentences for the user, a success and an obstacle; empty for none
  bool opensCandidate = false;  ///< whether `search.candidate` is to be opened
};

/// Returns the first step of a search for the prior of a picture. An open prior is shown at once. The sources
/// in `search.asked`, numbers of `sources`, are to be asked.
PriorStep begunSearch(const Workspace& workspace, const SeriesPicture& picture,
                      const std::vector<const Series*>& open, const std::set<int>& sources);

/// Returns the step after the answer of a source. The last answer opens the first candidate.
PriorStep withAnswer(PriorSearch search, const Workspace& workspace, const std::vector<const Series*>& open,
                     const PriorAnswer& answer);

/// Returns the search after the files of the candidate were found. They are being read. The search ends if
/// the user opened them.
PriorSearch withFilesFound(PriorSearch search, bool areOpenedByUser);

/// Returns the step after the candidate could not be opened.
PriorStep withoutFiles(PriorSearch search);

/// Returns the step after the candidate was read. `series` are those of its files, which may differ from the
/// list and even belong to another patient.
PriorStep withStudyRead(PriorSearch search, const Workspace& workspace,
                        const std::vector<const Series*>& series);

/// Returns the search after all reading ended. A search that still waits for its candidate ends, as the load
/// was cancelled or failed.
PriorSearch withReadingOver(PriorSearch search);

}  // namespace volumen
