#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

class DcmDataset;

namespace volumen::tests {

/// Returns a UID that no other call returns. DCMTK's own function would ask for the host's name over the
/// network.
std::string newUid();

/// A small grey DICOM picture to be written with DCMTK. Fields are what tests often vary, `edit` adds the
/// rest.
struct DicomPicture {
  std::string seriesUid = "1.2.3.4.5";
  int instance = 1;
  int columns = 4, rows = 3;
  glm::dvec3 position{0};
  std::string orientation = "1\\0\\0\\0\\1\\0";
  std::string spacing = "0.5\\0.7";        ///< PixelSpacing as written: between rows, between columns
  std::vector<std::uint16_t> pixels = {};  ///< rows x columns; a single value is repeated
  int bitsStored = 16;
  bool isSigned = false;
  /// A CT gets slope 1 and intercept 0 unless `edit` says what its values are.
  bool isRescaled = true;
  std::function<void(DcmDataset&)> edit = {};
};

/// Writes `picture` to `path`. `transferSyntaxUid` is a native one, RLE, JPEG lossless or JPEG-LS, encoded by
/// DCMTK.
void writeDicom(const std::string& path, const DicomPicture& picture,
                const char* transferSyntaxUid = "1.2.840.10008.1.2.1");

/// Read and write a file's bytes.
std::vector<std::uint8_t> readAll(const std::string& path);
void writeAll(const std::string& path, const std::vector<std::uint8_t>& bytes);

}  // namespace volumen::tests
