#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "io/files/data_file.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// How the bytes of samples are encoded in a file.
enum class Encoding { raw, deflate, bzip2, hex };

/// Decoded bytes, front to back.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Reads up to `count` bytes; fewer only at the end. An Error names the file: it cannot be read, or its
  /// encoded data are damaged or cut off.
  virtual Result<std::size_t> read(void* to, std::size_t count) = 0;

  /// Reads exactly `count` bytes, or an Error where `path` is too short.
  Status readAll(void* to, std::size_t count, const std::string& path);
  /// Skips exactly `count` bytes.
  virtual Status skip(std::uint64_t count, const std::string& path);

 protected:
  std::uint64_t total_ = 0;  // bytes read and skipped
};

/// The decoded bytes of `file` from byte `offset` on. Deflate: gzip (several members too) or zlib, whichever
/// the data are. What is encoded is decoded in a worker where there are any (io/worker), whose bytes nobody
/// waits for after `cancel`.
std::unique_ptr<ByteSource> decode(DataFile file, std::uint64_t offset, Encoding encoding,
                                   const CancelToken& cancel = {});

/// The fewest bytes that can encode `decodedBytes`: what a file must hold before memory is set aside for it.
std::uint64_t leastEncodedBytes(Encoding encoding, std::uint64_t decodedBytes);

}  // namespace volumen
