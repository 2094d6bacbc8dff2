#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/study/loaded.h"
#include "io/study/series.h"
#include "viewer/segment/mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Study;

/// A volume that a command works on, with what the user is to be told about how it was found and read.
struct Opened {
  Series series;
  Loaded loaded;
  std::vector<std::string> notes;    ///< sentences for stderr
  std::vector<Series> timePoints{};  ///< of its series, itself included, in order; empty: it is the only one

  /// How a command ends that did its work on it.
  int status() const;
};

/// How a command ends that did its work where these could not be read.
int statusWith(const std::vector<Unread>& unread);
/// Adds what is not there yet.
void addUnread(std::vector<Unread>& all, const std::vector<Unread>& more);
/// From now on a series with losses is refused (--strict).
void refuseLosses();
/// An Error where that is so and these are losses; `what`: of what.
Status checkStrict(const std::string& what, const std::vector<Unread>& unread);
/// The same, and wherever the machine, not a file, is to blame for one: for whoever is to work on them.
Status checkLosses(const std::string& what, const std::vector<Unread>& unread);
/// The sentences of warnings.
std::vector<std::string> sentences(const std::vector<Warning>& warnings);
/// What is said of the losses of series of which frames are shown, each once.
std::vector<std::string> unreadSentences(const std::vector<const Series*>& all);
/// What could not be read, for JSON: a list of path and reason.
nlohmann::ordered_json unreadJson(const std::vector<Unread>& unread);

/// Why nothing of a study can be shown: a sentence for the user.
Error nothingToShow(const std::string& path, const Study& study);

/// Opens PATH, chooses the series that `--series` means (empty: the one with most voxels, which is noted, as
/// is which one of several volumes of a UID) and loads it, with progress on a terminal. The Error is a
/// sentence for the user.
Result<Opened> openVolume(const std::string& path, const std::string& series, const CancelToken& cancel);

/// The volumes of a study that a series' UID means, where `--series` names a UID and it holds several; else
/// none.
std::vector<std::size_t> volumesOfUid(const Study& study, const std::string& series);

/// The same for a series that was found before.
Result<Opened> openSeries(const Series& series, const CancelToken& cancel);

/// An Error where --remove-table cannot be meant: the values are not HU.
Status checkHounsfield(const Opened& opened);

/// Takes away from what is drawn what a mask says (masked). An Error where the table is to go and values are
/// not HU.
Status takeAway(const Mask& mask, Opened& opened, const CancelToken& cancel);

/// For commands that write a volume as it lies: a tilt is kept in the file, nothing is corrected there.
void noteKeptTilt(Opened& opened);

/// Writes the notes to stderr, one line each.
void printNotes(const std::vector<std::string>& notes);

}  // namespace volumen
