#pragma once

#include <optional>

#include "io/files/byte_source.h"
#include "io/files/sample_type.h"

namespace volumen {

/// decode(), or decodeText() where there is a `text` type, in a worker (io/worker). Only where there are any.
std::unique_ptr<ByteSource> decodeIsolated(const std::string& path, std::uint64_t offset, Encoding encoding,
                                           std::optional<SampleType> text, const CancelToken& cancel);

}  // namespace volumen
