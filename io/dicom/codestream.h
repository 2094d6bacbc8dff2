#pragma once

#include "io/dicom/header.h"

namespace volumen::dicom {

/// The header of a compressed picture.
struct StreamInfo {
  int columns = 0, rows = 0, components = 0, precision = 0;
  bool isSigned = false;
};

/// Returns the frame header (SOF of JPEG or JPEG-LS) after walking all markers. Returns an Error for a stream
/// without picture, damaged markers, more than 100 scans, or fewer bytes than the coding can possibly need.
Result<StreamInfo> jpegInfo(Bytes stream);

/// The colours that a lossy three-component JPEG stream declares. Adobe's marker decides, then JFIF's (YBR),
/// then components named R, G and B, then subsampled components (YBR).
enum class JpegColours { unsaid, rgb, ybr };
JpegColours jpegColours(Bytes stream);

/// Returns the transfer syntax UID of a stream by its beginning: JPEG by its first frame header, JPEG-LS,
/// JPEG 2000 or RLE. Returns an empty text for other streams.
const char* syntaxOfStream(Bytes begin);

/// Reads the SIZ marker of a JPEG 2000 code stream (ISO 15444-1 A.5.1). Returns an Error for subsampling,
/// components of different precision, or more than 4096 tiles.
Result<StreamInfo> jpeg2000Info(Bytes stream);

/// Returns the code stream of a JPEG 2000 frame: all of it, or what follows the boxes of a JP2 file.
Bytes jpeg2000Stream(Bytes frame);

/// Checks that a stream of `streamBytes` bytes has the size, components and bits that the data set announces.
/// It also refuses pictures above 256 MiB compressed below 1/4096, which no acquired picture reaches.
Status checkStream(const StreamInfo& info, const PixelFormat& format, std::size_t streamBytes);

}  // namespace volumen::dicom
