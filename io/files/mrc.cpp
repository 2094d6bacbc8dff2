// MRC2014 (CCP4) of electron microscopy: 1024 bytes, an extended header, the samples. Lengths are in
// Ångström.
#include "io/files/binary_header.h"
#include "io/files/header_numbers.h"
#include "io/files/header_text.h"
#include "io/files/other_formats.h"

namespace volumen {

namespace {

constexpr std::size_t bytesOfMrc = 1024, mapPlace = 208, byteOrderPlace = 212;

// Bytes are signed (MRC2014), except if IMOD's stamp and flags say otherwise, or if the header's largest
// value exceeds a signed byte.
bool hasUnsignedBytes(const HeaderNumbers& n) {
  constexpr std::int32_t imod = 1146047817, signedFlag = 1;
  if (n.at<std::int32_t>(152) == imod) return (n.at<std::int32_t>(156) & signedFlag) == 0;
  const float least = n.at<float>(76), most = n.at<float>(80);
  return least >= 0 && most > 127 && most <= 255;
}

Result<SampleType> mrcType(const HeaderNumbers& n, const std::string& path) {
  const int mode = n.at<std::int32_t>(12);
  switch (mode) {
    case 0:
      return hasUnsignedBytes(n) ? SampleType::uint8 : SampleType::int8;
    case 1:
      return SampleType::int16;
    case 2:
      return SampleType::float32;
    case 6:
      return SampleType::uint16;
    case 3:
    case 4:
      return Error{path + " holds complex numbers, which cannot be shown."};
    default:
      return Error{path + " has samples of MRC mode " + std::to_string(mode) +
                   ", which volumen does not read."};
  }
}

// MAPC, MAPR and MAPS are the spatial axes of columns, rows and sections.
Status setMrcGeometry(const HeaderNumbers& n, const std::vector<std::uint64_t>& sizes, ImageHeader& image,
                      const std::string& path) {
  constexpr double mm = 1e-7;  // one Ångström
  std::vector<glm::dvec3> steps;
  int seen = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    std::int32_t axis = n.at<std::int32_t>(64 + 4 * a);
    if (axis == 0) axis = std::int32_t(a) + 1;
    if (axis < 1 || axis > 3)
      return Error{path + " lays its samples along axis " + std::to_string(axis) + "; 1 to 3 is meant."};
    seen |= 1 << axis;
    const std::size_t at = 4 * std::size_t(axis - 1);
    const double length = n.at<float>(40 + at), intervals = n.at<std::int32_t>(28 + at);
    if (a == 2 && sizes[2] == 1 && length == 0) continue;  // setGeometry() adds a thickness and a warning
    if (!(length > 0) || !(intervals > 0)) return setNominalGeometry(image, sizes, path);
    glm::dvec3 step(0);
    step[axis - 1] = length / intervals * mm;
    steps.push_back(step);
  }
  if (seen != 0b1110) return Error{path + " lays two axes of its samples along one axis of space."};
  image.warnings.emplace_back("The header gives lengths in Ångström; they were turned into mm.");
  image.warnings.push_back(
      {"The header gives spacings but no directions: which side is left or top is not known.",
       WarningKind::noDirections});
  glm::dvec3 origin;
  for (int a = 0; a < 3; ++a) origin[a] = double(n.at<float>(196 + 4 * std::size_t(a))) * mm;
  return setGeometry(image, sizes, steps, origin, path);
}

}  // namespace

bool isMrc(const FileClaim& file) {
  if (file.head.size() < byteOrderPlace + 4)
    return file.name.ends_with(".mrc") || file.name.ends_with(".mrc.gz");
  return file.head.compare(mapPlace, 3, "MAP") == 0 || file.name.ends_with(".mrc");
}

Result<ImageHeader> readMrcHeader(const std::string& path) {
  const auto header = readBinaryHeader(path, bytesOfMrc);
  if (!header) return header.error();
  if (header->head.compare(mapPlace, 3, "MAP") != 0)
    return Error{path + " is not an MRC file of 2000 or later: MAP does not stand at byte 208."};
  const HeaderNumbers n{header->head, header->head[byteOrderPlace] == 0x11};
  ImageHeader image;
  image.format = "MRC";
  image.description = fieldText(std::string_view(header->head).substr(224, 80));
  image.data.bigEndian = n.bigEndian;
  const auto type = mrcType(n, path);
  if (!type) return type.error();
  image.data.type = *type;
  std::vector<std::int64_t> sizes;
  for (std::size_t a = 0; a < 3; ++a) sizes.push_back(n.at<std::int32_t>(4 * a));
  // A stack of volumes has as many sections a volume as intervals along z.
  const std::int64_t sections = n.at<std::int32_t>(36);
  if (n.at<std::int32_t>(88) == 401 && sections > 0 && sizes[2] % sections == 0)
    sizes = {sizes[0], sizes[1], sections, sizes[2] / sections};
  const auto grid = setSizes(image, sizes, path);
  if (!grid) return grid.error();
  if (Status s = setMrcGeometry(n, *grid, image, path); !s) return s.error();
  const std::int64_t extended = n.at<std::int32_t>(92);
  if (extended < 0) return Error{path + " has an extended header of " + std::to_string(extended) + " bytes."};
  setDataAt(image.data, path, bytesOfMrc + std::uint64_t(extended), header->compressed);
  if (Status s = checkFiles(image.data); !s) return s.error();
  return image;
}

}  // namespace volumen
