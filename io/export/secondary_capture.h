#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "io/export/study_object.h"
#include "io/files/output_file.h"

namespace volumen {

/// Attributes of a written Secondary Capture, and how its pixels are stored.
struct CaptureTags : ObjectTags {
  std::string derivation{};         ///< DerivationDescription: scene hash, level of detail, stated error
  bool hasNames = true;             ///< true if texts in the picture identify the patient
  std::optional<bool> showsFace{};  ///< true if a face can be recognised in it; empty if unknown
  double frameMs = 100;             ///< time from frame to frame, ms
  bool rle = false;                 ///< true to compress without loss (RLE), false to write native pixels
  /// The pictures shown, as indices of Series::files. Empty stands for all of the series.
  std::vector<std::size_t> slices{};
};

/// Returns an Error that names `path` if a Secondary Capture cannot hold `frames` frames of `size` (columns
/// x rows).
Status checkCaptureFrames(const std::string& path, glm::ivec2 size, int frames, const CaptureTags& tags);

/// Returns the elements of a Secondary Capture made of `pictures`, except those of patient, study and
/// series. `size` is columns x rows.
DicomElements captureElements(const StudyObject& object, const Series& series, const CaptureTags& tags,
                              std::span<const SourcePicture> pictures, glm::ivec2 size, int frames);

/// Writes 8-bit RGB pictures as a Secondary Capture into a new file. One picture becomes a Secondary Capture
/// Image, several become a Multi-frame True Color one (PS3.3 A.8.1, A.8.5). Each frame is written when it is
/// added. The file appears with finish(), or not at all. It has no pixel spacing or position, so readers
/// cannot measure on it.
class SecondaryCapture {
 public:
  /// Writes all elements before the pixels. `size` is columns x rows. Returns an Error if `path` exists or
  /// cannot be written, if the series is not from DICOM files, or if the frames fail checkCaptureFrames().
  static Result<SecondaryCapture> begin(const std::string& path, const Series& series,
                                        const CaptureTags& tags, glm::ivec2 size, int frames,
                                        const Progress& progress = {}, const CancelToken& cancel = {});

  /// Writes the next frame: 3 bytes a pixel, top row first. Returns an Error if it has another size, is one
  /// too many, or the disk is full.
  Status add(std::span<const std::uint8_t> rgb);
  /// Completes the file. Returns an Error if frames are missing or `path` exists by now.
  Status finish();

 private:
  SecondaryCapture(OutputFile out, std::string path, glm::ivec2 size, int frames, bool rle);
  Status startPixels();
  Status write(std::span<const std::uint8_t> bytes) { return out_.write(bytes.data(), bytes.size()); }
  std::size_t frameBytes() const { return std::size_t(size_.x) * std::size_t(size_.y) * 3; }

  OutputFile out_;
  std::string path_;
  glm::ivec2 size_;
  int frames_, written_ = 0;
  bool rle_;
};

}  // namespace volumen
