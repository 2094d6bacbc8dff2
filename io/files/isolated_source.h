#pragma once

#include <optional>

#include "io/files/byte_source.h"
#include "io/files/text_source.h"

namespace volumen {

/// Returns the source of decode(), or of decodeText() for `text` samples, run in a worker (io/worker).
/// Workers must be available.
std::unique_ptr<ByteSource> decodeIsolated(const std::string& path, std::uint64_t offset, Encoding encoding,
                                           const std::optional<TextSamples>& text, const CancelToken& cancel);

}  // namespace volumen
