#pragma once

#include <memory>

#include "io/files/byte_source.h"
#include "io/files/sample_type.h"

namespace volumen {

/// Samples that are spelled out.
struct TextSamples {
  SampleType type = SampleType::uint8;
  std::uint64_t count = 0;  ///< what stands behind so many is not read
};

/// The samples that `file` spells out as decimal numbers from byte `offset` on, as bytes of their type in
/// this machine's order. Reads must ask for whole samples. What is no number, or does not fit the type, is an
/// Error. Read in a worker where there are any (io/worker).
std::unique_ptr<ByteSource> decodeText(DataFile file, std::uint64_t offset, const TextSamples& samples,
                                       const CancelToken& cancel = {});

}  // namespace volumen
