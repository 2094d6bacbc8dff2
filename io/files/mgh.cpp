// MGH and MGZ of FreeSurfer: 284 bytes, big endian, then the samples; .mgz is gzipped.
#include "io/files/binary_header.h"
#include "io/files/header_numbers.h"
#include "io/files/other_formats.h"

namespace volumen {

namespace {

constexpr std::size_t bytesOfMgh = 284;

Result<SampleType> mghType(int code, const std::string& path) {
  switch (code) {
    case 0:
      return SampleType::uint8;
    case 1:
      return SampleType::int32;
    case 3:
      return SampleType::float32;
    case 4:
      return SampleType::int16;
    case 10:
      return SampleType::uint16;
    default:
      return Error{path + " has samples of MGH type " + std::to_string(code) +
                   ", which volumen does not read."};
  }
}

// Directions and centre are RAS; the centre is voxel size / 2.
Status setMghGeometry(const HeaderNumbers& n, const std::vector<std::uint64_t>& sizes, ImageHeader& image,
                      const std::string& path) {
  const glm::dvec3 lpsFromRas(-1, -1, 1);
  const auto vector = [&](std::size_t place) {
    return glm::dvec3(n.at<float>(place), n.at<float>(place + 4), n.at<float>(place + 8)) * lpsFromRas;
  };
  std::vector<glm::dvec3> steps;
  glm::dvec3 origin = vector(78);
  for (std::size_t a = 0; a < 3; ++a) {
    if (vector(42 + 12 * a) == glm::dvec3(0)) {
      image.warnings.emplace_back(
          "The header gives an axis the direction 0, 0, 0: its directions are not used.");
      return setUnorientedGrid(image, sizes, {n.at<float>(30), n.at<float>(34), n.at<float>(38)}, {}, path);
    }
    steps.push_back(vector(42 + 12 * a) * double(n.at<float>(30 + 4 * a)));
    origin -= steps[a] * (double(sizes[a]) / 2);
  }
  return setGeometry(image, sizes, steps, origin, path);
}

}  // namespace

bool isMgh(const FileClaim& file) {
  return file.name.ends_with(".mgh") || file.name.ends_with(".mgz") || file.name.ends_with(".mgh.gz");
}

Result<ImageHeader> readMghHeader(const std::string& path) {
  const auto header = readBinaryHeader(path, bytesOfMgh);
  if (!header) return header.error();
  const HeaderNumbers n{header->head, true};
  if (n.at<std::int32_t>(0) != 1)
    return Error{path + " is not an MGH file: its header does not begin with version 1."};
  ImageHeader image;
  image.format = "MGH";
  image.data.bigEndian = true;
  const auto type = mghType(n.at<std::int32_t>(20), path);
  if (!type) return type.error();
  image.data.type = *type;
  std::vector<std::int64_t> sizes;
  for (std::size_t a = 0; a < 4; ++a) sizes.push_back(n.at<std::int32_t>(4 + 4 * a));
  const auto grid = setSizes(image, sizes, path);
  if (!grid) return grid.error();
  const bool hasGeometry = n.at<std::int16_t>(28) > 0;
  const Status placed =
      hasGeometry ? setMghGeometry(n, *grid, image, path) : setNominalGeometry(image, *grid, path);
  if (!placed) return placed.error();
  setDataAt(image.data, path, bytesOfMgh, header->compressed);
  if (Status s = checkFiles(image.data); !s) return s.error();
  return image;
}

}  // namespace volumen
