#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/dicom/packed_headers.h"
#include "io/dicom/unread.h"
#include "io/presentation.h"
#include "io/study/image.h"
#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "viewer/slice/frame.h"
#include "viewer/volume/cancel.h"

namespace volumen {
struct Study;
}

namespace volumen::dicom {

/// Sorts files by what each turned out to be into a study. Of pictures it holds little until they are sorted,
/// a series at a time.
class SeriesFinder {
 public:
  /// The files come in their order.
  void add(const std::string& file, Inspection found);
  /// Adds volumes and images (not in order, ids not numbered), refusals, and what is no picture. `lost`: what
  /// else is known to be lost of series, or of those beside it. `all`: where these are all files that there
  /// are: what a DICOMDIR lists beyond them is lost.
  void finish(std::vector<LostFile> lost, bool all, Study& study);

 private:
  void addOthers(std::vector<LostFile>& lost, bool all, Study& study);
  void addPictures(Study& study) const;

  std::vector<std::string> files_;
  std::vector<std::pair<std::string, Inspection>> others_;  ///< no pictures
  std::vector<Image> images_;                               ///< pictures that are no slices
  PackedHeaders pictures_;
  std::vector<std::pair<std::string, std::vector<std::size_t>>> series_;  ///< UID, and numbers of pictures
  std::map<std::string, std::size_t> seriesOf_;                           ///< of a UID
  std::set<std::string> classes_;                                         ///< of pictures
};

/// Decodes the slices of a DICOM series on all cores. A slice that cannot be decoded counts as missing and is
/// named in a warning.
Result<Loaded> loadSeries(const Series& series, const Progress& progress, const CancelToken& cancel);

/// A presentation state applied to a frame: its value mapping, inversion, shutter and greys. No greys means
/// that all values are shown.
struct Shown {
  ValueMapping values;
  bool inverted = false;
  Shutter shutter;
  std::vector<NamedGrey> greys;
};

/// Loads frame `n` (from 0) of a file as acquired (io/frames.h), or as a presentation state shows it.
/// `pixels` is the size of a frame if known and sets how much memory a worker gets.
Result<Frame> loadFrame(const std::string& path, int n, std::uint64_t pixels,
                        const std::optional<Shown>& shown = {});

}  // namespace volumen::dicom
