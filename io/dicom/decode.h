#pragma once

#include <variant>

#include "io/dicom/header.h"
#include "viewer/volume/cancel.h"

namespace volumen::dicom {

/// Stored values of a frame, the samples of a pixel side by side, i fastest: masked and sign-extended from
/// the bits stored, 8-bit signed ones widened.
using Samples = std::variant<std::vector<std::uint8_t>, std::vector<std::int16_t>, std::vector<std::uint16_t>,
                             std::vector<std::int32_t>, std::vector<std::uint32_t>, std::vector<float>,
                             std::vector<double>>;

/// A decoded frame, and what was noticed: a sentence without the file's name, or empty.
struct DecodedFrame {
  Samples samples;
  std::string note;
  bool ybr = false;  ///< its three samples are those of YBR_FULL, else of RGB
};

/// Decodes one frame from its bytes (all fragments joined). The only place where pixel data meets a decoder:
/// bytes in, a value or a reason out. Of pictures of one bit a pixel, and of bytes in big endian words, they
/// are the 16-bit words in which frame `n` lies.
Result<DecodedFrame> decodeFrame(const PixelFormat& format, const TransferSyntax& syntax, Bytes bytes,
                                 int n = 0);

/// The pixel data of a file, read frame by frame.
class PixelSource {
 public:
  /// Opens the file, and inflates a deflated one. `header` must outlive it. What is compressed is inflated
  /// and decoded in workers, where there are any (io/worker): they open the file, and nobody waits for their
  /// answers after `cancel`.
  static Result<PixelSource> open(const FileHeader& header, const CancelToken& cancel = {});
  /// Reads and decodes frame `n` (from 0). May be called from several threads at once.
  Result<DecodedFrame> frame(int n) const;
  /// The same of other bits of the samples than those of the picture (overlays in unused bits).
  Result<DecodedFrame> frame(int n, const PixelFormat& format) const;

 private:
  PixelSource(const FileHeader& header, CancelToken cancel) : header_(header), cancel_(std::move(cancel)) {}
  Status openFile();
  Status inflate(std::uint64_t fileSize);
  bool isDecodedInWorkers() const;
  Result<std::vector<std::uint8_t>> bytes(Range range) const;
  Result<DecodedFrame> decoded(int n, const PixelFormat& format) const;

  const FileHeader& header_;
  CancelToken cancel_;
  std::optional<RegularFile> file_;  // where its bytes are read here
  std::vector<std::uint8_t> inflated_;
  std::optional<DecodedFrame> mosaic_;  // the whole picture
};

/// What DCMTK's decoders need, set up once; decodeJpeg does it by itself.
void registerDecoders();

/// The decoders behind decodeFrame. The first three give samples as native ones would stand in a little
/// endian file.
Result<std::vector<std::uint8_t>> decodeRle(const PixelFormat& format, Bytes bytes);
Result<std::vector<std::uint8_t>> decodeJpeg(const PixelFormat& format, const TransferSyntax& syntax,
                                             Bytes bytes);
Result<DecodedFrame> decodeJpeg2000(const PixelFormat& format, Bytes bytes);

}  // namespace volumen::dicom
