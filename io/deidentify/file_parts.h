#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/dicom/scan.h"

namespace volumen {

/// A value of FilePart::kept that keeps every bit.
inline constexpr std::uint16_t allBits = 0xffff;

/// A part of a file to be written: `bytes`, or a range of the source file if `bytes` is empty.
struct FilePart {
  std::uint64_t offset = 0, length = 0;
  std::string bytes;
  /// Mask of the bits to keep of a range. The low byte is for its first, third, ... byte, the high byte for
  /// the others.
  std::uint16_t kept = allBits;
};

/// Sets the bits of `bytes` that are not in `kept` to 0. `bytes` must begin at an even offset within the
/// part.
template <class Byte>
void clearBits(std::span<Byte> bytes, std::uint16_t kept) {
  if (kept == allBits) return;
  for (std::size_t n = 0; n < bytes.size(); ++n)
    bytes[n] = Byte(std::uint8_t(bytes[n]) & (n % 2 ? kept >> 8 : kept & 0xff));
}

/// Collects the parts of a data set. `source` holds the bytes to which offsets refer. If it is not from the
/// file itself (inflated data), all parts hold bytes.
class FileParts {
 public:
  FileParts(dicom::Bytes source, bool isInFile) : source_(source), isInFile_(isInFile) {}

  /// Adds a range of the source, whose bits outside `kept` are cleared (FilePart::kept). A range of the file
  /// may reach beyond the bytes of `source`.
  void copy(std::uint64_t offset, std::uint64_t length, std::uint16_t kept = allBits);
  void add(std::string_view bytes);
  /// Adds an element with its header and its value, padded to an even length (PS3.5 6.2, 7.1).
  void addElement(dicom::Encoding encoding, std::uint32_t tag, std::uint16_t vr, std::string_view value);
  /// Adds the header of an element, item or delimiter.
  void addHeader(dicom::Encoding encoding, std::uint32_t tag, std::uint16_t vr, std::uint32_t length);

  std::vector<FilePart> take() && { return std::move(parts_); }

 private:
  dicom::Bytes source_;
  const bool isInFile_;
  std::vector<FilePart> parts_;
};

}  // namespace volumen
