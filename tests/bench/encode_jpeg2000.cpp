#include "tests/bench/encode_jpeg2000.h"

#include <openjpeg.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace volumen::bench {

namespace {

using Bytes = std::vector<std::uint8_t>;

OPJ_SIZE_T append(void* data, OPJ_SIZE_T count, void* user) {
  const auto* from = static_cast<const std::uint8_t*>(data);
  auto& bytes = *static_cast<Bytes*>(user);
  bytes.insert(bytes.end(), from, from + count);
  return count;
}

}  // namespace

std::vector<std::uint8_t> encodeJpeg2000(const std::vector<std::uint16_t>& pixels, int columns, int rows,
                                         int bits) {
  opj_image_cmptparm_t component{};
  component.dx = component.dy = 1;
  component.w = OPJ_UINT32(columns), component.h = OPJ_UINT32(rows);
  component.prec = OPJ_UINT32(bits);
  const std::unique_ptr<opj_image_t, decltype(&opj_image_destroy)> image(
      opj_image_create(1, &component, OPJ_CLRSPC_GRAY), &opj_image_destroy);
  if (!image) throw std::bad_alloc();
  image->x1 = component.w, image->y1 = component.h;
  std::ranges::copy(pixels, image->comps[0].data);
  opj_cparameters_t parameters;
  opj_set_default_encoder_parameters(&parameters);
  parameters.tcp_numlayers = 1;
  parameters.cp_disto_alloc = 1;
  const std::unique_ptr<opj_codec_t, decltype(&opj_destroy_codec)> codec(opj_create_compress(OPJ_CODEC_J2K),
                                                                         &opj_destroy_codec);
  Bytes bytes;
  const std::unique_ptr<opj_stream_t, decltype(&opj_stream_destroy)> stream(
      opj_stream_default_create(OPJ_FALSE), &opj_stream_destroy);
  opj_stream_set_user_data(stream.get(), &bytes, nullptr);
  opj_stream_set_write_function(stream.get(), append);
  const bool done = opj_setup_encoder(codec.get(), &parameters, image.get()) &&
                    opj_start_compress(codec.get(), image.get(), stream.get()) &&
                    opj_encode(codec.get(), stream.get()) && opj_end_compress(codec.get(), stream.get());
  if (!done) throw std::runtime_error("a picture cannot be encoded as JPEG 2000");
  return bytes;
}

}  // namespace volumen::bench
