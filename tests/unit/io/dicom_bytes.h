#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace volumen::tests {

using Buffer = std::vector<std::uint8_t>;

/// Builds DICOM bytes by hand, in explicit VR little endian.
struct Builder {
  Buffer bytes;

  void word(unsigned v) { bytes.insert(bytes.end(), {std::uint8_t(v), std::uint8_t(v >> 8)}); }
  void dword(std::uint32_t v) {
    word(v & 0xffff);
    word(v >> 16);
  }
  void tag(std::uint32_t t) {
    word(t >> 16);
    word(t & 0xffff);
  }
  void text(const std::string& s) { bytes.insert(bytes.end(), s.begin(), s.end()); }
  void shortElement(std::uint32_t t, const char* vr, std::string value) {
    if (value.size() % 2) value += ' ';
    tag(t);
    text(vr);
    word(unsigned(value.size()));
    text(value);
  }
  void number(std::uint32_t t, unsigned v) { shortElement(t, "US", {char(v & 0xff), char(v >> 8)}); }
  void longElement(std::uint32_t t, const char* vr, std::uint32_t length) {
    tag(t);
    text(vr);
    word(0);
    dword(length);
  }
  /// Returns a preamble and the meta header of a transfer syntax.
  static Builder file(std::string syntax = "1.2.840.10008.1.2.1") {
    Builder b{Buffer(132)};
    std::copy_n("DICM", 4, b.bytes.begin() + 128);
    if (syntax.size() % 2) syntax += '\0';
    b.shortElement(0x00020010, "UI", syntax);
    return b;
  }
};

/// Returns the attributes of a picture of 4 x 4 pixels, 16 bits. The attribute `field` is replaced by
/// `value`.
inline Builder picture(const std::string& syntax, std::uint32_t field = 0, unsigned value = 0,
                       const std::string& text = {}) {
  Builder b = Builder::file(syntax);
  b.shortElement(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
  b.shortElement(0x00080060, "CS", "CT");
  const auto number = [&](std::uint32_t tag, unsigned normal) {
    b.number(tag, tag == field ? value : normal);
  };
  number(0x00280002, 1);
  b.shortElement(0x00280004, "CS", "MONOCHROME2");
  if (field == 0x00280008) b.shortElement(field, "IS", text);
  number(0x00280010, 4);
  number(0x00280011, 4);
  number(0x00280100, 16);
  number(0x00280101, 16);
  if (field == 0x00280102) number(field, 0);
  number(0x00280103, 0);
  return b;
}

inline Buffer native(Builder b, std::uint32_t length = 32, std::size_t there = 32) {
  b.longElement(0x7fe00010, "OW", length);
  b.bytes.resize(b.bytes.size() + there);
  return b.bytes;
}

inline Buffer fragment(Builder b, const Buffer& stream) {
  b.longElement(0x7fe00010, "OB", 0xffffffff);
  b.tag(0xfffee000);
  b.dword(0);
  b.tag(0xfffee000);
  b.dword(std::uint32_t(stream.size()));
  b.bytes.insert(b.bytes.end(), stream.begin(), stream.end());
  b.tag(0xfffee0dd);
  b.dword(0);
  return b.bytes;
}

inline Buffer nested(const char* vr, bool explicitVr, int levels) {
  Builder b = Builder::file(explicitVr ? "1.2.840.10008.1.2.1" : "1.2.840.10008.1.2");
  for (int n = 0; n < levels; ++n) {
    if (n == 0 || (explicitVr && std::string(vr) == "SQ"))
      explicitVr ? b.longElement(0x00081140, vr, 0xffffffff) : (b.tag(0x00081140), b.dword(0xffffffff));
    else
      b.tag(0x00081140), b.dword(0xffffffff);
    b.tag(0xfffee000);
    b.dword(0xffffffff);
  }
  return b.bytes;
}

inline Buffer deflateBomb() {
  const Buffer zeros(128 << 20);
  Buffer packed(1 << 20);
  z_stream z{};
  deflateInit2(&z, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  z.next_in = const_cast<Bytef*>(zeros.data());
  z.avail_in = uInt(zeros.size());
  z.next_out = packed.data();
  z.avail_out = uInt(packed.size());
  deflate(&z, Z_FINISH);
  packed.resize(packed.size() - z.avail_out);
  deflateEnd(&z);
  Builder b = Builder::file("1.2.840.10008.1.2.1.99");
  b.bytes.insert(b.bytes.end(), packed.begin(), packed.end());
  return b.bytes;
}

/// Returns a JPEG lossless header for a picture of this size, some data and EOI.
inline Buffer jpegStream(unsigned width, unsigned height, std::uint8_t stray = 0) {
  Buffer s{0xff, 0xd8};
  if (stray) s.insert(s.end(), {0xff, stray});
  s.insert(s.end(), {0xff, 0xc3, 0, 11, 16, std::uint8_t(height >> 8), std::uint8_t(height),
                     std::uint8_t(width >> 8), std::uint8_t(width), 1, 1, 0x11, 0});
  s.insert(s.end(), {0xff, 0xda, 0, 8, 1, 1, 0, 1, 0, 0, 0x55, 0x55, 0xff, 0xd9});
  return s;
}

inline Buffer rleStream(std::uint32_t segments, std::uint32_t first, std::uint32_t second, std::size_t size) {
  Builder b;
  b.dword(segments);
  b.dword(first);
  b.dword(second);
  b.bytes.resize(std::max<std::size_t>(size, 12), 0x7f);
  return b.bytes;
}

/// Returns a JPEG 2000 SIZ for this size, with tiles of 1 x 1 or of the whole picture.
inline Buffer jpeg2000Stream(std::uint32_t width, std::uint32_t height, bool tiny) {
  Buffer s{0xff, 0x4f, 0xff, 0x51, 0, 41, 0, 0};
  const auto put = [&](std::uint32_t v) {
    for (int shift : {24, 16, 8, 0}) s.push_back(std::uint8_t(v >> shift));
  };
  for (std::uint32_t v : {width, height, 0u, 0u, tiny ? 1u : width, tiny ? 1u : height, 0u, 0u}) put(v);
  s.insert(s.end(), {0, 1, 15, 1, 1, 0xff, 0xd9});
  return s;
}

}  // namespace volumen::tests
