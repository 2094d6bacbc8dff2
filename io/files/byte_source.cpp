#include "io/files/byte_source.h"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/files/isolated_source.h"
#include "io/worker/worker.h"

namespace volumen {

namespace {

constexpr std::size_t bufferBytes = 1 << 18;

class RawSource : public ByteSource {
 public:
  RawSource(DataFile file, std::uint64_t offset) : file_(std::move(file)), at_(offset) {}
  Result<std::size_t> read(void* to, std::size_t count) override {
    auto got = file_.readAt(at_, to, count);
    if (got) at_ += *got;
    return got;
  }
  Status skip(std::uint64_t count, const std::string&) override {
    at_ += count;
    total_ += count;
    return {};
  }

 private:
  DataFile file_;
  std::uint64_t at_;
};

class DeflateSource : public ByteSource {
 public:
  DeflateSource(DataFile file, std::uint64_t offset)
      : path_(file.path()), encoded_(std::move(file), offset), input_(bufferBytes) {
    constexpr int anyHeader = 15 + 32;  // zlib: largest window, gzip and zlib headers recognised
    ready_ = inflateInit2(&stream_, anyHeader) == Z_OK;
  }
  ~DeflateSource() override { inflateEnd(&stream_); }
  DeflateSource(const DeflateSource&) = delete;
  DeflateSource& operator=(const DeflateSource&) = delete;

  Result<std::size_t> read(void* to, std::size_t count) override {
    if (!ready_) return Error{path_ + " cannot be decompressed: not enough memory."};
    std::size_t done = 0;
    while (done < count && !ended_) {
      constexpr std::size_t most = 1u << 30;  // zlib counts in unsigned int
      stream_.next_out = static_cast<Bytef*>(to) + done;
      stream_.avail_out = uInt(std::min(count - done, most));
      const uInt before = stream_.avail_out;
      if (Status s = step(); !s) return s.error();
      done += before - stream_.avail_out;
    }
    return done;
  }

 private:
  Status fill() {
    if (stream_.avail_in > 0) return {};
    auto got = encoded_.read(input_.data(), input_.size());
    if (!got) return got.error();
    stream_.next_in = input_.data();
    stream_.avail_in = uInt(*got);
    return {};
  }

  Status step() {
    if (Status s = fill(); !s) return s;
    const int code = inflate(&stream_, Z_NO_FLUSH);
    if (code == Z_STREAM_END) return endOfMember();
    if (code == Z_BUF_ERROR && stream_.avail_in == 0)
      return Error{path_ + " is cut off in the middle of its compressed data."};
    if (code != Z_OK && code != Z_BUF_ERROR)
      return Error{path_ + " holds damaged compressed data" +
                   (stream_.msg ? std::string(" (") + stream_.msg + ")." : ".")};
    return {};
  }

  // A gzip file may hold several members. Other trailing bytes are ignored.
  Status endOfMember() {
    if (Status s = fill(); !s) return s;
    if (stream_.avail_in > 0 && *stream_.next_in == 0x1f)
      inflateReset(&stream_);
    else
      ended_ = true;
    return {};
  }

  std::string path_;
  RawSource encoded_;
  std::vector<Bytef> input_;
  z_stream stream_{};
  bool ready_ = false, ended_ = false;
};

class Bzip2Source : public ByteSource {
 public:
  Bzip2Source(DataFile file, std::uint64_t offset)
      : path_(file.path()), encoded_(std::move(file), offset), input_(bufferBytes) {
    ready_ = BZ2_bzDecompressInit(&stream_, 0, 0) == BZ_OK;
  }
  ~Bzip2Source() override { BZ2_bzDecompressEnd(&stream_); }
  Bzip2Source(const Bzip2Source&) = delete;
  Bzip2Source& operator=(const Bzip2Source&) = delete;

  Result<std::size_t> read(void* to, std::size_t count) override {
    if (!ready_) return Error{path_ + " cannot be decompressed: not enough memory."};
    std::size_t done = 0;
    while (done < count && !ended_) {
      constexpr std::size_t most = 1u << 30;  // bzlib counts in unsigned int
      stream_.next_out = static_cast<char*>(to) + done;
      stream_.avail_out = unsigned(std::min(count - done, most));
      const unsigned before = stream_.avail_out;
      if (Status s = step(); !s) return s.error();
      done += before - stream_.avail_out;
    }
    return done;
  }

 private:
  Status step() {
    if (stream_.avail_in == 0) {
      auto got = encoded_.read(input_.data(), input_.size());
      if (!got) return got.error();
      if (*got == 0) return Error{path_ + " is cut off in the middle of its compressed data."};
      stream_.next_in = input_.data();
      stream_.avail_in = unsigned(*got);
    }
    const int code = BZ2_bzDecompress(&stream_);
    ended_ = code == BZ_STREAM_END;
    if (code == BZ_OK || ended_) return {};
    return Error{path_ + " holds damaged compressed data."};
  }

  std::string path_;
  RawSource encoded_;
  std::vector<char> input_;
  bz_stream stream_{};
  bool ready_ = false, ended_ = false;
};

class HexSource : public ByteSource {
 public:
  HexSource(DataFile file, std::uint64_t offset)
      : path_(file.path()), encoded_(std::move(file), offset), input_(bufferBytes) {}

  Result<std::size_t> read(void* to, std::size_t count) override {
    for (std::size_t done = 0; done < count; ++done) {
      int byte = 0;
      for (int digits = 0; digits < 2; ++digits) {
        auto digit = nextDigit();
        if (!digit) return digit.error();
        if (*digit < 0) return done;
        byte = byte * 16 + *digit;
      }
      static_cast<std::uint8_t*>(to)[done] = std::uint8_t(byte);
    }
    return count;
  }

 private:
  // Returns the value of the next hexadecimal digit, or -1 at the end.
  Result<int> nextDigit() {
    for (;;) {
      if (at_ == filled_) {
        auto got = encoded_.read(input_.data(), input_.size());
        if (!got) return got.error();
        if (*got == 0) return -1;
        at_ = 0;
        filled_ = *got;
      }
      const char c = input_[at_++];
      if (c >= '0' && c <= '9') return c - '0';
      if (c >= 'a' && c <= 'f') return c - 'a' + 10;
      if (c >= 'A' && c <= 'F') return c - 'A' + 10;
      if (c != ' ' && (c < '\t' || c > '\r'))
        return Error{path_ + " holds characters other than hexadecimal digits in its data."};
    }
  }

  std::string path_;
  RawSource encoded_;
  std::vector<char> input_;
  std::size_t at_ = 0, filled_ = 0;
};

}  // namespace

Status ByteSource::readAll(void* to, std::size_t count, const std::string& path) {
  auto got = read(to, count);
  if (!got) return got.error();
  total_ += *got;
  if (*got < count)
    return Error{path + " holds fewer samples than its header promises: they end after " +
                 std::to_string(total_) + " bytes."};
  return {};
}

Status ByteSource::skip(std::uint64_t count, const std::string& path) {
  std::vector<std::uint8_t> waste(std::min<std::uint64_t>(count, bufferBytes));
  while (count > 0) {
    const std::size_t part = std::min<std::uint64_t>(count, waste.size());
    if (Status s = readAll(waste.data(), part, path); !s) return s;
    count -= part;
  }
  return {};
}

std::unique_ptr<ByteSource> decode(DataFile file, std::uint64_t offset, Encoding encoding,
                                   const CancelToken& cancel) {
  if (worker::isolating() && encoding != Encoding::raw)
    return decodeIsolated(file.path(), offset, encoding, {}, cancel);
  switch (encoding) {
    case Encoding::deflate:
      return std::make_unique<DeflateSource>(std::move(file), offset);
    case Encoding::bzip2:
      return std::make_unique<Bzip2Source>(std::move(file), offset);
    case Encoding::hex:
      return std::make_unique<HexSource>(std::move(file), offset);
    case Encoding::raw:
      break;
  }
  return std::make_unique<RawSource>(std::move(file), offset);
}

std::uint64_t leastEncodedBytes(Encoding encoding, std::uint64_t decodedBytes) {
  // Limits of the formats: bzip2 packs runs of 255 bytes in 5, and 900,000 of those in some 40.
  constexpr std::uint64_t deflateRatio = 1032, bzip2Ratio = 1'500'000;
  switch (encoding) {
    case Encoding::deflate:
      return decodedBytes / deflateRatio;
    case Encoding::bzip2:
      return decodedBytes / bzip2Ratio;
    case Encoding::hex:
      return decodedBytes * 2;
    case Encoding::raw:
      break;
  }
  return decodedBytes;
}

}  // namespace volumen
