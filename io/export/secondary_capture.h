#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "io/export/study_object.h"
#include "io/files/output_file.h"

namespace volumen {

/// What a Secondary Capture says of itself.
struct CaptureTags : ObjectTags {
  std::string derivation{};         ///< how the picture was made: scene hash, level, stated error
  bool hasNames = true;             ///< texts that tell who the patient is are drawn into it
  std::optional<bool> showsFace{};  ///< a face can be recognised in it; empty: not known
  double frameMs = 100;             ///< time from frame to frame
  bool rle = false;                 ///< compress without loss (RLE); else the pixels are written as they are
  /// The pictures shown: indices of Series::files; empty: all of the series.
  std::vector<std::size_t> slices{};
};

/// Checks that a Secondary Capture can hold so many frames of `size` (columns x rows). The Error names
/// `path`.
Status checkCaptureFrames(const std::string& path, glm::ivec2 size, int frames, const CaptureTags& tags);

/// Returns the elements of a Secondary Capture made of `pictures` that patient, study and series do not have.
DicomElements captureElements(const StudyObject& object, const Series& series, const CaptureTags& tags,
                              std::span<const SourcePicture> pictures, glm::ivec2 size, int frames);

/// Writes pictures as a Secondary Capture into a new file: one as Secondary Capture Image, several as
/// Multi-frame True Color (PS3.3 A.8.1, A.8.5); RGB, 8 bits. Frames are written as they come. The file
/// appears with finish(), or not at all. Nothing in it lets anyone measure on the pictures.
class SecondaryCapture {
 public:
  /// Writes what stands before the pixels. `size` is columns x rows. The Error: the path exists or cannot be
  /// written, the series is not from DICOM files, a frame has no pixels or more than 65535 rows or columns,
  /// or uncompressed frames are more than the 4 GB that a DICOM file holds.
  static Result<SecondaryCapture> begin(const std::string& path, const Series& series,
                                        const CaptureTags& tags, glm::ivec2 size, int frames,
                                        const Progress& progress = {}, const CancelToken& cancel = {});

  /// Writes the next frame: 3 bytes a pixel, first row on top. The Error: it has another size, is one too
  /// many, or the disk is full.
  Status add(std::span<const std::uint8_t> rgb);
  /// Completes the file. The Error: frames are missing, or the path exists by now.
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
