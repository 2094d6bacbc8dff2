#pragma once

#include <variant>

#include "io/dicom/header.h"
#include "viewer/volume/cancel.h"

namespace volumen::dicom {

/// Stored values of a frame, with the samples of a pixel side by side, i fastest. They are masked and
/// sign-extended from the stored bits; signed 8-bit samples are widened.
using Samples = std::variant<std::vector<std::uint8_t>, std::vector<std::int16_t>, std::vector<std::uint16_t>,
                             std::vector<std::int32_t>, std::vector<std::uint32_t>, std::vector<float>,
                             std::vector<double>>;

/// A decoded frame. `note` is a remark on the decoding: a sentence without the file's name, or empty.
struct DecodedFrame {
  Samples samples;
  std::string note;
  bool ybr = false;  ///< true if its three samples are YBR_FULL, else RGB
};

/// Decodes one frame from its bytes (all fragments joined): bytes in, a value or a reason out. No other
/// function passes pixel data to a decoder. For 1-bit pixels, and for bytes in big endian words, `bytes` are
/// the 16-bit words that contain frame `n`.
Result<DecodedFrame> decodeFrame(const PixelFormat& format, const TransferSyntax& syntax, Bytes bytes,
                                 int n = 0);

/// Reads the pixel data of a file frame by frame.
class PixelSource {
 public:
  /// Opens the file and inflates it if deflated. `header` must outlive the source. Compressed data are
  /// inflated and decoded in workers if there are any (io/worker). Workers open the file themselves, and
  /// nobody waits for their answers after `cancel`.
  static Result<PixelSource> open(const FileHeader& header, const CancelToken& cancel = {});
  /// Reads and decodes frame `n` (from 0). Thread-safe.
  Result<DecodedFrame> frame(int n) const;
  /// Does the same for other bits of the samples than those of the picture (overlays in unused bits).
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
  std::optional<RegularFile> file_;  // set if this process reads the bytes itself
  std::vector<std::uint8_t> inflated_;
  std::optional<DecodedFrame> mosaic_;  // the decoded mosaic with all its tiles
};

/// Sets up DCMTK's decoders once. decodeJpeg calls it itself.
void registerDecoders();

/// The decoders behind decodeFrame. decodeRle and decodeJpeg return samples as native ones of a little endian
/// file.
Result<std::vector<std::uint8_t>> decodeRle(const PixelFormat& format, Bytes bytes);
Result<std::vector<std::uint8_t>> decodeJpeg(const PixelFormat& format, const TransferSyntax& syntax,
                                             Bytes bytes);
Result<DecodedFrame> decodeJpeg2000(const PixelFormat& format, Bytes bytes);

}  // namespace volumen::dicom
