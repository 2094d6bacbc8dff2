#pragma once

#include "io/dicom/header.h"

namespace volumen::dicom {

/// What the header of a compressed picture says.
struct StreamInfo {
  int columns = 0, rows = 0, components = 0, precision = 0;
  bool isSigned = false;
};

/// The frame header (SOF, of JPEG and JPEG-LS) of a stream whose markers are walked up to its end. Refused:
/// no picture, damaged markers, more than 100 scans, fewer bytes than the coding can possibly need.
Result<StreamInfo> jpegInfo(Bytes stream);

/// What a JPEG stream of three colours that is not lossless says of them itself: by Adobe's mark, else that
/// of JFIF (luminance and colour differences), else components that are called R, G and B, or of which some
/// are subsampled (colour differences).
enum class JpegColours { unsaid, rgb, ybr };
JpegColours jpegColours(Bytes stream);

/// The UID of the transfer syntax of a stream that begins so (JPEG by its first frame header, JPEG-LS, JPEG
/// 2000, RLE); empty: it is none of these.
const char* syntaxOfStream(Bytes begin);

/// The SIZ marker of a JPEG 2000 code stream (ISO 15444-1 A.5.1). Refused: subsampling, colours that differ
/// in precision, more than 4096 tiles.
Result<StreamInfo> jpeg2000Info(Bytes stream);

/// The part of a JPEG 2000 frame that is the code stream: all of it, or what follows the boxes of a JP2 file.
Bytes jpeg2000Stream(Bytes frame);

/// Whether a stream of so many bytes is the picture that the data set announces: its size, its colours, and
/// a precision that fits its bits. Refused as well: pictures above 256 MiB that come from less than 1/4096 of
/// that, which no acquired picture does.
Status checkStream(const StreamInfo& info, const PixelFormat& format, std::size_t streamBytes);

}  // namespace volumen::dicom
