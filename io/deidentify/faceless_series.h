#pragma once

#include <optional>
#include <string>

#include "io/export/dicom_pixels.h"
#include "io/export/dicom_source.h"
#include "io/study/series.h"

namespace volumen {

/// The pixels of the files of a series without the face that it shows.
class FacelessSeries {
 public:
  /// Returns whether a series is worth it: a volume of CT or MR of DICOM files of one frame that says that it
  /// shows a head, or does not say what it shows (showsFaceIn3d()).
  static bool mayBeOf(const Series& series);

  /// Loads the series and takes its face away (faceOf()). The Error: it cannot be loaded, shows no head, or
  /// cancelled.
  static Result<FacelessSeries> of(const Series& series, const Progress& progress, const CancelToken& cancel);

  std::size_t size() const { return files_.size(); }
  const std::string& file(std::size_t n) const { return files_[n]; }
  /// Returns the pixels of file `n`, of the values and the rescale that the file has; empty if these cannot
  /// be kept.
  std::optional<StoredSlice> pixels(std::size_t n) const;

 private:
  FacelessSeries(VolumePtr volume, std::vector<std::string> files, DicomSource source)
      : volume_(std::move(volume)), files_(std::move(files)), source_(std::move(source)) {}

  VolumePtr volume_;
  std::vector<std::string> files_;  // one for each slice of the volume
  DicomSource source_;
};

}  // namespace volumen
