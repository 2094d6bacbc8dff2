#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/study/loaded.h"
#include "io/study/series.h"
#include "io/study/study.h"
#include "viewer/segment/mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// A volume for a command, with notes for the user on how it was found and read.
struct Opened {
  Series series;
  Loaded loaded;
  std::vector<std::string> notes;    ///< sentences for stderr
  std::vector<Series> timePoints{};  ///< all time points of its series in order; empty if there is only one

  /// Returns the exit status of a command that succeeded on this volume.
  int status() const;
};

/// Returns the exit status of a command that succeeded despite these unreadable files.
int statusWith(const std::vector<Unread>& unread);
/// Adds files that are not yet in `all`.
void addUnread(std::vector<Unread>& all, const std::vector<Unread>& more);
/// Refuses series with losses from now on (--strict).
void refuseLosses();
/// The Error: losses are refused and `unread` is not empty; `what` names the series.
Status checkStrict(const std::string& what, const std::vector<Unread>& unread);
/// Does the same for commands that work on the series. The Error also: the machine, not a file, caused a
/// loss.
Status checkLosses(const std::string& what, const std::vector<Unread>& unread);
/// Returns the sentences of warnings.
std::vector<std::string> sentences(const std::vector<Warning>& warnings);
/// Returns sentences on the losses of series with displayed frames, each once.
std::vector<std::string> unreadSentences(const std::vector<const Series*>& all);
/// Returns unreadable files as JSON: a list of path and reason.
nlohmann::ordered_json unreadJson(const std::vector<Unread>& unread);

/// Returns the reason why nothing in a study can be displayed: a sentence for the user.
Error nothingToShow(const std::string& path, const Study& study);

/// Keeps the study and the volume that were opened last, for commands of this process that open them again.
void keepOpened();

/// The activity of a command on a volume, and the memory that it takes besides the volume.
struct MemoryUse {
  const char* doing = "reading";  ///< verb in the message "there is too little memory for ... it"
  double bytesAVoxel = 0;
};
/// Segments: labels, sets of voxels and surfaces, measured.
inline constexpr MemoryUse segmenting{"segmenting", 3.4};

/// Returns openPath() of PATH, with progress on a terminal.
Result<Study> openStudyAt(const std::string& path, const CancelToken& cancel);

/// Opens PATH and loads the series that `--series` names, with progress on a terminal. If empty, it is the
/// one with most voxels. Notes report this choice, and that of one of several volumes of a UID. The Error is
/// a sentence for the user. If there is too little memory for `use`, nothing is read.
Result<Opened> openVolume(const std::string& path, const std::string& series, const CancelToken& cancel,
                          const MemoryUse& use = {});
/// Does the same for the study that openStudyAt(path) returned.
Result<Opened> openVolume(const Study& study, const std::string& path, const std::string& series,
                          const CancelToken& cancel, const MemoryUse& use = {});

/// Returns the volumes of a study with the UID in `--series`, if there are several; else none.
std::vector<std::size_t> volumesOfUid(const Study& study, const std::string& series);

/// Loads a series that was found before.
Result<Opened> openSeries(const Series& series, const CancelToken& cancel);

/// The Error: values are not HU, so --remove-table is impossible.
Status checkHounsfield(const Opened& opened);

/// Masks the displayed volume (masked()). The Error: the table is to be removed, but values are not HU.
Status takeAway(const Mask& mask, Opened& opened, const CancelToken& cancel);

/// Adds a note that a tilt is kept in the file, for commands that write a volume without correction.
void noteKeptTilt(Opened& opened);

/// Writes the notes to stderr, one line each.
void printNotes(const std::vector<std::string>& notes);

}  // namespace volumen
