#pragma once

#include <optional>

#include "io/files/byte_source.h"
#include "io/files/text_source.h"

namespace volumen {

/// decode(), or decodeText() where there are `text` samples, in a worker (io/worker). Only where there are
/// any.
std::unique_ptr<ByteSource> decodeIsolated(const std::string& path, std::uint64_t offset, Encoding encoding,
                                           const std::optional<TextSamples>& text, const CancelToken& cancel);

}  // namespace volumen
