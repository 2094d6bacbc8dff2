#pragma once

#include <memory>

#include "io/files/byte_source.h"
#include "io/files/sample_type.h"

namespace volumen {

/// Samples as decimal text.
struct TextSamples {
  SampleType type = SampleType::uint8;
  std::uint64_t count = 0;  ///< further samples are not read
};

/// Returns the samples in `file`, decimal numbers from byte `offset` on, as bytes of their type in native
/// order. Reads must ask for whole samples. The Error: a word is not a number or does not fit the type. Runs
/// in a worker if there are any (io/worker).
std::unique_ptr<ByteSource> decodeText(DataFile file, std::uint64_t offset, const TextSamples& samples,
                                       const CancelToken& cancel = {});

}  // namespace volumen
