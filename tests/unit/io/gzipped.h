#pragma once

#include <zlib.h>

#include <QByteArray>

namespace volumen::tests {

/// Returns the bytes compressed by gzip.
inline QByteArray gzipped(const QByteArray& plain) {
  QByteArray packed(qsizetype(compressBound(uLong(plain.size())) + 64), '\0');
  z_stream stream{};
  constexpr int gzipWindow = 15 + 16;
  deflateInit2(&stream, 9, Z_DEFLATED, gzipWindow, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
  stream.avail_in = uInt(plain.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = uInt(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(qsizetype(stream.total_out));
  deflateEnd(&stream);
  return packed;
}

}  // namespace volumen::tests
