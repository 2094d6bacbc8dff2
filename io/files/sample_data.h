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

/// Where the samples of one or several volumes lie, and how.
struct SampleData {
  SampleType type = SampleType::uint8;
  bool bigEndian = false;
  bool text = false;  ///< numbers spelled out; `encoding` then means nothing
  Encoding encoding = Encoding::raw;
  std::vector<std::string> files;  ///< each holds an equal part, in this order
  std::uint64_t offset = 0;        ///< in each file: bytes before lineSkip counts
  int lineSkip = 0;                ///< lines to skip before what is encoded
  std::int64_t byteSkip = 0;       ///< decoded bytes to skip; -1: the samples are the last bytes

  std::uint64_t leading = 1;   ///< volumes that alternate sample by sample
  std::uint64_t voxels = 1;    ///< samples of one volume, i fastest
  std::uint64_t trailing = 1;  ///< volumes (or groups of `leading`) one behind the other

  std::uint64_t volumes() const { return leading * trailing; }
  std::uint64_t samples() const { return leading * voxels * trailing; }
};

/// Sets voxels, leading and trailing after checking the products: at most 10,000 volumes, of 16 GiB each as
/// stored and as a Volume keeps them, and no more than this machine has. `path` is for the sentence.
Status setCounts(SampleData& data, const std::vector<std::uint64_t>& leading,
                 const std::vector<std::uint64_t>& grid, const std::vector<std::uint64_t>& trailing,
                 const std::string& path);

/// Whether every file is there and large enough to hold its part, without reading it. The Error names the
/// file.
Status checkFiles(const SampleData& data);

/// "uint8", "int16", "uint16" or "float32": what a Volume keeps such samples as (design.md 10).
const char* volumeTypeName(SampleType type);

/// Stored values as a Volume keeps them.
struct Samples {
  VoxelValues values;
  double slope = 1, intercept = 0;
};

/// Reads volume number `volume` (from 0: first along `leading`, then along `trailing`). Types that a Volume
/// does not keep (int8 becomes int16; 32 and 64 bit integers and doubles float32 real values) are converted;
/// what does not fit float32 exactly adds a sentence to `warnings`.
Result<Samples> readSamples(const SampleData& data, std::uint64_t volume, double slope, double intercept,
                            const Progress& progress, const CancelToken& cancel,
                            std::vector<std::string>& warnings);

}  // namespace volumen
