#include <openjpeg.h>

#include <algorithm>
#include <memory>

#include "io/dicom/codestream.h"
#include "io/dicom/decode.h"

namespace volumen::dicom {
namespace {

/// The read position in the bytes, for OpenJPEG's callbacks.
struct ByteCursor {
  Bytes bytes;
  std::size_t at = 0;
};

constexpr OPJ_SIZE_T endOfData = OPJ_SIZE_T(-1);

OPJ_SIZE_T readBytes(void* buffer, OPJ_SIZE_T size, void* user) {
  ByteCursor& cursor = *static_cast<ByteCursor*>(user);
  const std::size_t count = std::min<std::size_t>(size, cursor.bytes.size() - cursor.at);
  if (count == 0) return endOfData;
  std::memcpy(buffer, cursor.bytes.data() + cursor.at, count);
  cursor.at += count;
  return count;
}

OPJ_OFF_T skipBytes(OPJ_OFF_T size, void* user) {
  ByteCursor& cursor = *static_cast<ByteCursor*>(user);
  if (size < 0) return -1;
  const std::size_t count = std::min<std::size_t>(std::size_t(size), cursor.bytes.size() - cursor.at);
  cursor.at += count;
  return count == 0 && size != 0 ? -1 : OPJ_OFF_T(count);
}

OPJ_BOOL seekBytes(OPJ_OFF_T position, void* user) {
  ByteCursor& cursor = *static_cast<ByteCursor*>(user);
  if (position < 0 || std::size_t(position) > cursor.bytes.size()) return OPJ_FALSE;
  cursor.at = std::size_t(position);
  return OPJ_TRUE;
}

using Codec = std::unique_ptr<opj_codec_t, decltype(&opj_destroy_codec)>;
using Stream = std::unique_ptr<opj_stream_t, decltype(&opj_stream_destroy)>;
using Image = std::unique_ptr<opj_image_t, decltype(&opj_image_destroy)>;

Stream openStream(ByteCursor& cursor) {
  Stream stream(opj_stream_default_create(OPJ_TRUE), &opj_stream_destroy);
  opj_stream_set_user_data(stream.get(), &cursor, nullptr);
  opj_stream_set_user_data_length(stream.get(), cursor.bytes.size());
  opj_stream_set_read_function(stream.get(), readBytes);
  opj_stream_set_skip_function(stream.get(), skipBytes);
  opj_stream_set_seek_function(stream.get(), seekBytes);
  return stream;
}

Image decodeImage(Bytes bytes) {
  ByteCursor cursor{bytes};
  const Stream stream = openStream(cursor);
  const Codec codec(opj_create_decompress(OPJ_CODEC_J2K), &opj_destroy_codec);
  opj_dparameters_t parameters;
  opj_set_default_decoder_parameters(&parameters);
  opj_image_t* raw = nullptr;
  bool done = opj_setup_decoder(codec.get(), &parameters) &&
              opj_decoder_set_strict_mode(codec.get(), OPJ_TRUE) &&
              opj_read_header(stream.get(), codec.get(), &raw);
  Image image(raw, &opj_image_destroy);
  done = done && opj_decode(codec.get(), stream.get(), raw) && opj_end_decompress(codec.get(), stream.get());
  if (!done) image.reset();
  return image;
}

template <class Value>
Samples converted(const opj_image_t& image, std::size_t count) {
  const std::size_t colours = image.numcomps;
  std::vector<Value> values(count);
  for (std::size_t n = 0; n < count; ++n) values[n] = Value(image.comps[n % colours].data[n / colours]);
  return values;
}

/// Returns samples in the type that the file announces. If only the file says signed, the bits of the stream
/// are taken as signed.
Samples samplesOf(const PixelFormat& format, const StreamInfo& info, const opj_image_t& data) {
  const std::size_t count = format.frameSamples();
  if (format.isSigned && !info.isSigned) {
    const std::uint32_t sign = 1u << (info.precision - 1);
    OPJ_INT32* grey = data.comps[0].data;  // colours are never signed
    for (std::size_t n = 0; n < count; ++n) grey[n] = OPJ_INT32((std::uint32_t(grey[n]) ^ sign) - sign);
  }
  const bool isSigned = format.isSigned || info.isSigned;
  if (format.bitsAllocated == 32)
    return isSigned ? converted<std::int32_t>(data, count) : converted<std::uint32_t>(data, count);
  if (isSigned) return converted<std::int16_t>(data, count);
  return format.bitsAllocated == 8 ? converted<std::uint8_t>(data, count)
                                   : converted<std::uint16_t>(data, count);
}

bool hasSize(const opj_image_t& image, const PixelFormat& format) {
  return int(image.numcomps) == format.samples &&
         std::all_of(image.comps, image.comps + image.numcomps, [&](const opj_image_comp_t& c) {
           return c.data && int(c.w) == format.columns && int(c.h) == format.rows;
         });
}

std::string mismatch(const PixelFormat& format, const StreamInfo& info) {
  if (format.isSigned == info.isSigned) return {};
  return std::string("its JPEG 2000 stream is ") + (info.isSigned ? "signed" : "unsigned") +
         ", but the file says " +
         (format.isSigned ? "signed; its values are taken as signed"
                          : "unsigned; its values are taken as signed");
}

}  // namespace

Result<DecodedFrame> decodeJpeg2000(const PixelFormat& format, Bytes bytes) {
  bytes = jpeg2000Stream(bytes);
  const Result<StreamInfo> info = jpeg2000Info(bytes);
  if (!info) return info.error();
  if (Status s = checkStream(*info, format, bytes.size()); !s) return s.error();
  const Image image = decodeImage(bytes);
  if (!image) return Error{"its JPEG 2000 picture is damaged or cut off"};
  if (!hasSize(*image, format)) return Error{"its JPEG 2000 picture decodes to the wrong size"};
  // The decoder undoes the colour transforms of JPEG 2000 (YBR_ICT, YBR_RCT).
  return DecodedFrame{samplesOf(format, *info, *image), mismatch(format, *info),
                      format.photometric.starts_with("YBR_FULL")};
}

}  // namespace volumen::dicom
