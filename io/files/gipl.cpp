// GIPL (Guy's Image Processing Lab): 256 bytes, big endian, then the samples.
#include "io/files/binary_header.h"
#include "io/files/header_numbers.h"
#include "io/files/header_text.h"
#include "io/files/other_formats.h"

namespace volumen {

namespace {

constexpr std::size_t bytesOfGipl = 256, giplMagicPlace = 252;
constexpr std::uint32_t magics[] = {719555000u, 4026526128u};

Result<SampleType> giplType(int code, const std::string& path) {
  switch (code) {
    case 7:
      return SampleType::int8;
    case 8:
      return SampleType::uint8;
    case 15:
      return SampleType::int16;
    case 16:
      return SampleType::uint16;
    case 31:
      return SampleType::uint32;
    case 32:
      return SampleType::int32;
    case 64:
      return SampleType::float32;
    case 65:
      return SampleType::float64;
    default:
      return Error{path + " has samples of GIPL type " + std::to_string(code) +
                   ", which volumen does not read."};
  }
}

}  // namespace

bool isGipl(const FileClaim& file) {
  if (file.name.ends_with(".gipl") || file.name.ends_with(".gipl.gz")) return true;
  if (file.head.size() < bytesOfGipl) return false;
  const std::uint32_t magic = HeaderNumbers{file.head, true}.at<std::uint32_t>(giplMagicPlace);
  return magic == magics[0] || magic == magics[1];
}

Result<ImageHeader> readGiplHeader(const std::string& path) {
  const auto header = readBinaryHeader(path, bytesOfGipl);
  if (!header) return header.error();
  const HeaderNumbers n{header->head, true};
  const std::uint32_t magic = n.at<std::uint32_t>(giplMagicPlace);
  if (magic != magics[0] && magic != magics[1])
    return Error{path + " is not a GIPL file: its header does not end with GIPL's number."};
  ImageHeader image;
  image.format = "GIPL";
  image.description = fieldText(std::string_view(header->head).substr(26, 80));
  image.data.bigEndian = true;
  const auto type = giplType(n.at<std::uint16_t>(8), path);
  if (!type) return type.error();
  image.data.type = *type;
  std::vector<std::int64_t> sizes;
  for (std::size_t a = 0; a < 4; ++a) sizes.push_back(n.at<std::uint16_t>(2 * a));
  if (sizes[3] == 0) sizes[3] = 1;  // an image of three axes
  const auto grid = setSizes(image, sizes, path);
  if (!grid) return grid.error();
  std::vector<double> spacings;
  glm::dvec3 origin;
  for (std::size_t a = 0; a < 3; ++a) {
    spacings.push_back(n.at<float>(10 + 4 * a));
    origin[int(a)] = n.at<double>(204 + 8 * a);
  }
  if (Status s = setUnorientedGrid(image, *grid, spacings, origin, path); !s) return s.error();
  setDataAt(image.data, path, bytesOfGipl, header->compressed);
  if (Status s = checkFiles(image.data); !s) return s.error();
  return image;
}

}  // namespace volumen
