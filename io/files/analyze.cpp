// Analyze 7.5: a header of 348 bytes in NAME.hdr, samples in NAME.img.
#include <cmath>

#include "io/files/binary_header.h"
#include "io/files/header_numbers.h"
#include "io/files/header_text.h"
#include "io/files/image_pair.h"
#include "io/files/nifti.h"
#include "io/files/other_formats.h"

namespace volumen {

namespace {

constexpr std::size_t bytesOfAnalyze = 348;

Result<SampleType> analyzeType(int code, const std::string& path) {
  switch (code) {
    case 2:
      return SampleType::uint8;
    case 4:
      return SampleType::int16;
    case 8:
      return SampleType::int32;
    case 16:
      return SampleType::float32;
    case 64:
      return SampleType::float64;
    case 128:
      return Error{path + " is a colour image: it cannot be shown in 3D."};
    case 32:
      return Error{path + " holds complex numbers, which cannot be shown."};
    default:
      return Error{path + " has samples of Analyze data type " + std::to_string(code) +
                   ", which volumen does not read."};
  }
}

Status findImage(SampleData& data, double offset, const std::string& path) {
  if (!(offset >= 0 && offset <= 1e12) || offset != std::floor(offset))
    return Error{path + " has the vox_offset " + exactText(offset) + ", which is no place for samples."};
  const auto samples = samplesOfPair(path);
  if (!samples) return samples.error();
  setDataAt(data, samples->path, std::uint64_t(offset), samples->compressed);
  return {};
}

}  // namespace

bool isAnalyze(const FileClaim& file) {
  const bool named = file.name.ends_with(".hdr") || file.name.ends_with(".hdr.gz");
  if (!named || !isNiftiHead(file.head)) return false;
  const std::string magic = file.head.substr(344, 3);
  return magic != "n+1" && magic != "ni1" && file.head.substr(4, 2) != "n+" && file.head.substr(4, 2) != "ni";
}

Result<ImageHeader> readAnalyzeHeader(const std::string& path) {
  const auto header = readBinaryHeader(path, bytesOfAnalyze);
  if (!header) return header.error();
  const bool bigEndian =
      HeaderNumbers{header->head, true}.at<std::int32_t>(0) == std::int32_t(bytesOfAnalyze);
  const HeaderNumbers n{header->head, bigEndian};
  ImageHeader image;
  image.format = "Analyze";
  image.description = fieldText(std::string_view(header->head).substr(148, 80));
  image.data.bigEndian = bigEndian;
  const auto type = analyzeType(n.at<std::int16_t>(70), path);
  if (!type) return type.error();
  image.data.type = *type;
  std::array<std::int64_t, 8> dim;
  n.row<std::int16_t>(40, dim);
  if (dim[0] < 1 || dim[0] > 7)
    return Error{path + " has " + std::to_string(dim[0]) + " dimensions; 1 to 7 is meant."};
  const auto grid = setSizes(image, {dim.begin() + 1, dim.begin() + 1 + dim[0]}, path);
  if (!grid) return grid.error();
  std::array<double, 3> pixdim;
  n.row<float>(80, pixdim);
  for (double& mm : pixdim) mm = std::abs(mm);  // some programs write flips as negative spacings
  if (Status s = setUnorientedGrid(image, *grid, {pixdim.begin(), pixdim.end()}, glm::dvec3(0), path); !s)
    return s.error();
  if (Status s = findImage(image.data, n.at<float>(108), path); !s) return s.error();
  if (Status s = checkFiles(image.data); !s) return s.error();
  return image;
}

}  // namespace volumen
