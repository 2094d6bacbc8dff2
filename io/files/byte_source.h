#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "io/files/data_file.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Encoding of samples in a file.
enum class Encoding { raw, deflate, bzip2, hex };

/// Decoded bytes in sequential order.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Reads up to `count` bytes; fewer only at the end. The Error names the file: it cannot be read, or its
  /// encoded data are damaged or cut off.
  virtual Result<std::size_t> read(void* to, std::size_t count) = 0;

  /// Reads exactly `count` bytes. The Error: the file `path` is too short.
  Status readAll(void* to, std::size_t count, const std::string& path);
  /// Skips exactly `count` bytes.
  virtual Status skip(std::uint64_t count, const std::string& path);

 protected:
  std::uint64_t total_ = 0;  // bytes read and skipped
};

/// Returns the decoded bytes of `file` from byte `offset` on. Deflate covers gzip (also several members) and
/// zlib, as the data say. Encoded data are decoded in a worker if there are any (io/worker); `cancel` stops
/// waiting for it.
std::unique_ptr<ByteSource> decode(DataFile file, std::uint64_t offset, Encoding encoding,
                                   const CancelToken& cancel = {});

/// Returns the fewest bytes that can encode `decodedBytes`. A file must hold them before memory is allocated
/// for it.
std::uint64_t leastEncodedBytes(Encoding encoding, std::uint64_t decodedBytes);

}  // namespace volumen
