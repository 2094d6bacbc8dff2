#include "io/deidentify/file_parts.h"

namespace volumen {

namespace {

template <class T>
void appendNumber(std::string& bytes, T number, bool bigEndian) {
  for (std::size_t n = 0; n < sizeof(T); ++n)
    bytes += char(number >> 8 * (bigEndian ? sizeof(T) - 1 - n : n) & 0xff);
}

}  // namespace

void FileParts::copy(std::uint64_t offset, std::uint64_t length, std::uint16_t kept) {
  if (length == 0) return;
  if (!isInFile_) {
    std::string bytes(reinterpret_cast<const char*>(source_.data()) + offset, length);
    clearBits(std::span(bytes), kept);
    return add(bytes);
  }
  const bool goesOn = kept == allBits && !parts_.empty() && parts_.back().bytes.empty() &&
                      parts_.back().kept == allBits && parts_.back().offset + parts_.back().length == offset;
  if (goesOn)
    parts_.back().length += length;
  else
    parts_.push_back({offset, length, {}, kept});
}

void FileParts::add(std::string_view bytes) {
  if (bytes.empty()) return;
  if (parts_.empty() || parts_.back().bytes.empty()) parts_.emplace_back();
  parts_.back().bytes += bytes;
}

void FileParts::addElement(dicom::Encoding encoding, std::uint32_t tag, std::uint16_t vr,
                           std::string_view value) {
  std::string padded(value);
  const bool isZeroPadded =
      vr == dicom::vrOf('U', 'I') || vr == dicom::vrOf('O', 'B') || vr == dicom::vrOf('U', 'N');
  if (padded.size() % 2 == 1) padded += isZeroPadded ? '\0' : ' ';
  addHeader(encoding, tag, vr, std::uint32_t(padded.size()));
  add(padded);
}

void FileParts::addHeader(dicom::Encoding encoding, std::uint32_t tag, std::uint16_t vr,
                          std::uint32_t length) {
  std::string header;
  const bool big = encoding.bigEndian;
  appendNumber(header, std::uint16_t(tag >> 16), big);
  appendNumber(header, std::uint16_t(tag & 0xffff), big);
  if (encoding.explicitVr && tag >> 16 != 0xfffe) {
    header += {char(vr >> 8), char(vr & 0xff)};
    if (dicom::hasLongLength(vr))
      header += std::string(2, '\0');
    else
      return appendNumber(header, std::uint16_t(length), big), add(header);
  }
  appendNumber(header, length, big);
  add(header);
}

}  // namespace volumen
