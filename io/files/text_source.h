#pragma once

#include <memory>

#include "io/files/byte_source.h"
#include "io/files/sample_type.h"

namespace volumen {

/// The samples that `file` spells out as decimal numbers from byte `offset` on, as bytes of `type` in this
/// machine's order. Reads must ask for whole samples. What is no number, or does not fit `type`, is an Error.
/// Read in a worker where there are any (io/worker).
std::unique_ptr<ByteSource> decodeText(DataFile file, std::uint64_t offset, SampleType type,
                                       const CancelToken& cancel = {});

}  // namespace volumen
