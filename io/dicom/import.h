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

/// Sorts inspected files into a study. Holds little of each picture until its series is sorted.
class SeriesFinder {
 public:
  /// Takes the next file. Files come in their order.
  void add(const std::string& file, Inspection found);
  /// Adds volumes and images (unsorted, ids not numbered), refusals, and files without picture. `lost` holds
  /// files already known to be lost, of a series or beside one. With `all`, these are all files there are, so
  /// that other files listed by a DICOMDIR count as lost.
  void finish(std::vector<LostFile> lost, bool all, Study& study);

 private:
  void addOthers(std::vector<LostFile>& lost, bool all, Study& study);
  void addPictures(Study& study) const;

  std::vector<std::string> files_;
  std::vector<std::pair<std::string, Inspection>> others_;  ///< files without picture
  std::vector<Image> images_;                               ///< pictures that are not slices
  PackedHeaders pictures_;
  std::vector<std::pair<std::string, std::vector<std::size_t>>> series_;  ///< UID and numbers of pictures
  std::map<std::string, std::size_t> seriesOf_;                           ///< index in `series_` by UID
  std::set<std::string> classes_;                                         ///< classes of pictures
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
/// `pixels` is the size of a frame if known and sets how much memory a worker gets. `progress` reports the
/// bytes of its pixels.
Result<Frame> loadFrame(const std::string& path, int n, std::uint64_t pixels,
                        const std::optional<Shown>& shown = {}, const Progress& progress = {});

/// Returns frames of a file as loadFrame() does, without values, colours, overlays and shutter, which are
/// decoded only where greys follow from them. Frames in colour have no greys.
Result<std::vector<Frame>> loadFrameGreys(const std::string& path, const std::vector<int>& frames,
                                          std::uint64_t pixels);

/// Reads a frame as acquired for a picture whose longer side has `edge` pixels. Large grey frames are reduced
/// to means of blocks, no smaller than that picture needs, without overlays and shutter.
Result<Frame> loadSmallFrame(const std::string& path, int n, std::uint64_t pixels, int edge);

}  // namespace volumen::dicom
