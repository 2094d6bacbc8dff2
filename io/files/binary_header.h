#pragma once

#include <string>

#include "io/files/image_header.h"

namespace volumen {

/// The first `count` bytes of a file, decompressed if it is gzip.
struct BinaryHeader {
  std::string head;
  bool compressed = false;
};

/// Reads a header of fixed length. The Error names the file if it is shorter.
Result<BinaryHeader> readBinaryHeader(const std::string& path, std::size_t count);

/// Sets samples that begin at byte `offset` of (decompressed) `path`.
void setDataAt(SampleData& data, const std::string& path, std::uint64_t offset, bool compressed);

/// Sets a grid along the axes with `spacings` in mm, and a warning that directions are unknown. The geometry
/// is not calibrated if a spacing is not above 0.
Status setUnorientedGrid(ImageHeader& header, const std::vector<std::uint64_t>& sizes,
                         const std::vector<double>& spacings, glm::dvec3 origin, const std::string& path);

/// Splits sizes into those of the grid (three) and those that count volumes; sets counts and names. The
/// Error: sizes below 1, or more than setCounts allows.
Result<std::vector<std::uint64_t>> setSizes(ImageHeader& header, const std::vector<std::int64_t>& sizes,
                                            const std::string& path);

}  // namespace volumen
