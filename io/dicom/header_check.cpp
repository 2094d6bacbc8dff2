#include "io/dicom/header_check.h"

#include <algorithm>

#include "io/dicom/attributes.h"
#include "io/dicom/separators.h"

namespace volumen::dicom {
namespace {

constexpr int mostSide = 65535;

bool areBits(const PixelFormat& f) {
  if (f.kind != PixelFormat::Kind::integer)
    return f.bitsAllocated == (f.kind == PixelFormat::Kind::float32 ? 32 : 64);
  const bool whole = (f.isBits() && f.samples == 1) || f.bitsAllocated == 8 || f.bitsAllocated == 16 ||
                     f.bitsAllocated == 32;
  return whole && f.bitsStored >= 1 && f.bitsStored <= f.highBit + 1 && f.highBit < f.bitsAllocated;
}

bool isFormat(const PixelFormat& f) {
  const bool pairs = !f.subsampled || (f.samples == 3 && f.columns % 2 == 0);
  return isPictureSize(f.columns, f.rows) && f.frames >= 1 && f.frames <= frameLimit && areBits(f) &&
         (f.samples == 1 || f.samples == 3) && (!f.isGrey() || f.samples == 1) && pairs &&
         (!f.bytesInWords || f.bitsAllocated <= 8);
}

bool isMosaic(const Mosaic& m, const PixelFormat& tile) {
  const int across = m.tilesAcross;
  return isPictureSize(m.columns, m.rows) && across >= 1 && across <= mostSide &&
         tile.columns <= m.columns / across && tile.rows <= m.rows / across &&
         tile.frames <= std::int64_t(across) * across && tile.samples == 1;
}

}  // namespace

bool isPictureSize(int columns, int rows) {
  return columns >= 1 && columns <= mostSide && rows >= 1 && rows <= mostSide;
}

bool isConsistent(const FileHeader& header, const std::string& path) {
  const PixelFormat& f = header.format;
  if (header.path != path || !isFormat(f) || (header.mosaic && !isMosaic(*header.mosaic, f))) return false;
  if (f.isBits() && header.syntax.coding != Coding::native) return false;
  const auto frames = std::size_t(f.frames);
  if (header.frames.size() != (header.mosaic ? 1 : frames)) return false;
  if (header.slices.size() != frames && header.slices.size() != 1) return false;
  if (header.notVolume.empty() && (!f.isGrey() || header.syntax.coding == Coding::unsupported)) return false;
  return std::ranges::all_of(header.slices, [&](const Slice& s) {
    return s.frame >= 0 && s.frame < f.frames && s.separators.size() == separators().size();
  });
}

}  // namespace volumen::dicom
