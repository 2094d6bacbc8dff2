#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/files/byte_source.h"
#include "io/files/sample_type.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Location and format of the samples of one or several volumes.
struct SampleData {
  SampleType type = SampleType::uint8;
  bool bigEndian = false;
  bool text = false;  ///< decimal text; `encoding` is ignored
  Encoding encoding = Encoding::raw;
  std::vector<std::string> files;  ///< data files in order, each with an equal part
  std::uint64_t offset = 0;        ///< bytes to skip in each file before lineSkip counts
  int lineSkip = 0;                ///< lines to skip before encoded data
  std::int64_t byteSkip = 0;       ///< decoded bytes to skip; -1: the samples are the last bytes

  std::uint64_t leading = 1;   ///< volumes interleaved by sample
  std::uint64_t voxels = 1;    ///< samples of one volume, i fastest
  std::uint64_t trailing = 1;  ///< volumes (or groups of `leading`) in sequence

  std::uint64_t volumes() const { return leading * trailing; }
  std::uint64_t samples() const { return leading * voxels * trailing; }
};

/// Sets voxels, leading and trailing after checking the products: at most 10,000 volumes of 16 GiB each, as
/// stored and as a Volume keeps them, and no more than this machine's memory. The Error names `path`.
Status setCounts(SampleData& data, const std::vector<std::uint64_t>& leading,
                 const std::vector<std::uint64_t>& grid, const std::vector<std::uint64_t>& trailing,
                 const std::string& path);

/// Checks that every file exists and is large enough for its part, without reading it. The Error names the
/// file.
Status checkFiles(const SampleData& data);

/// Returns the type in which a Volume keeps such samples: "uint8", "int16", "uint16" or "float32" (design.md
/// 10).
const char* volumeTypeName(SampleType type);

/// Stored values in a Volume's type.
struct Samples {
  VoxelValues values;
  double slope = 1, intercept = 0;
};

/// Reads volume number `volume` (from 0; `leading` varies fastest, then `trailing`). Types that a Volume does
/// not keep are converted: int8 to int16; integers of 32 and 64 bits and doubles to real values in float32.
/// Values that do not fit float32 exactly add a sentence to `warnings`.
Result<Samples> readSamples(const SampleData& data, std::uint64_t volume, double slope, double intercept,
                            const Progress& progress, const CancelToken& cancel,
                            std::vector<std::string>& warnings);

}  // namespace volumen
