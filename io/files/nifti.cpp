#include "io/files/nifti.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <optional>

#include "io/files/b_values.h"
#include "io/files/binary_header.h"
#include "io/files/header_numbers.h"
#include "io/files/header_text.h"
#include "io/files/image_pair.h"

namespace volumen {

namespace {

constexpr std::size_t bytesOfNifti1 = 348, bytesOfNifti2 = 540;

// The fields of a header of either version.
struct Fields {
  int version = 1;
  bool bigEndian = false, pair = false;
  std::array<std::int64_t, 8> dim{};
  std::int64_t datatype = 0, intent = 0, units = 0, qformCode = 0, sformCode = 0;
  std::array<double, 8> pixdim{};
  double voxOffset = 0, slope = 0, intercept = 0;
  std::array<double, 3> quaternion{}, qOffset{};
  std::array<double, 12> srow{};
  std::string description;
};

Fields fieldsOfNifti1(const HeaderNumbers& b) {
  Fields f;
  b.row<std::int16_t>(40, f.dim);
  f.intent = b.at<std::int16_t>(68);
  f.datatype = b.at<std::int16_t>(70);
  b.row<float>(76, f.pixdim);
  f.voxOffset = b.at<float>(108);
  f.slope = b.at<float>(112);
  f.intercept = b.at<float>(116);
  f.units = b.at<std::uint8_t>(123);
  f.description = fieldText(std::string_view(b.head).substr(148, 80));
  f.qformCode = b.at<std::int16_t>(252);
  f.sformCode = b.at<std::int16_t>(254);
  b.row<float>(256, f.quaternion);
  b.row<float>(268, f.qOffset);
  b.row<float>(280, f.srow);
  f.pair = b.head.compare(344, 3, "ni1") == 0;
  return f;
}

Fields fieldsOfNifti2(const HeaderNumbers& b) {
  Fields f;
  f.version = 2;
  f.pair = b.head.compare(4, 3, "ni2") == 0;
  f.datatype = b.at<std::int16_t>(12);
  b.row<std::int64_t>(16, f.dim);
  b.row<double>(104, f.pixdim);
  f.voxOffset = double(b.at<std::int64_t>(168));
  f.slope = b.at<double>(176);
  f.intercept = b.at<double>(184);
  f.description = fieldText(std::string_view(b.head).substr(240, 80));
  f.qformCode = b.at<std::int32_t>(344);
  f.sformCode = b.at<std::int32_t>(348);
  b.row<double>(352, f.quaternion);
  b.row<double>(376, f.qOffset);
  b.row<double>(400, f.srow);
  f.units = b.at<std::int32_t>(500);
  f.intent = b.at<std::int32_t>(504);
  return f;
}

// Returns 1 or 2; 0 if `head` is not a NIfTI or Analyze header.
int version(const std::string& head, bool& bigEndian) {
  if (head.size() < bytesOfNifti1) return 0;
  for (const bool big : {false, true}) {
    bigEndian = big;
    const std::int32_t size = HeaderNumbers{head, big}.at<std::int32_t>(0);
    if (size == std::int32_t(bytesOfNifti1)) return 1;
    if (size == std::int32_t(bytesOfNifti2) && head.size() >= bytesOfNifti2) return 2;
  }
  return 0;
}

Result<Fields> readFields(const std::string& path, bool& compressed) {
  auto start = readHead(path, 2);
  if (!start) return start.error();
  compressed = *start == "\x1f\x8b";
  auto head = readDecompressedHead(path, bytesOfNifti2);
  if (!head) return head.error();
  bool bigEndian = false;
  const int v = version(*head, bigEndian);
  if (v == 0) return Error{path + " is not a NIfTI file: its header does not begin with 348 or 540."};
  const std::string magic = v == 1 ? head->substr(344, 4) : head->substr(4, 4);
  const std::string number(1, v == 1 ? '1' : '2');
  if (magic != "n+" + number + '\0' && magic != "ni" + number + '\0')
    return Error{path + " is a damaged NIfTI file, or an Analyze header whose name does not end in .hdr."};
  Fields f = v == 1 ? fieldsOfNifti1({*head, bigEndian}) : fieldsOfNifti2({*head, bigEndian});
  f.bigEndian = bigEndian;
  return f;
}

Result<SampleType> niftiType(const Fields& f, const std::string& path) {
  switch (f.datatype) {
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
    case 256:
      return SampleType::int8;
    case 512:
      return SampleType::uint16;
    case 768:
      return SampleType::uint32;
    case 1024:
      return SampleType::int64;
    case 1280:
      return SampleType::uint64;
    case 128:
    case 2304:
      return Error{path + " is a colour image: it cannot be shown in 3D."};
    case 32:
    case 1792:
    case 2048:
      return Error{path + " holds complex numbers, which cannot be shown."};
    default:
      return Error{path + " has samples of NIfTI data type " + std::to_string(f.datatype) +
                   ", which volumen does not read."};
  }
}

// The grid in the file's unit: steps of the axes and the centre of the first voxel, RAS.
struct Affine {
  std::array<glm::dvec3, 3> steps;
  glm::dvec3 origin;
};

Affine affineOfSform(const Fields& f) {
  const auto column = [&](int c) { return glm::dvec3(f.srow[c], f.srow[4 + c], f.srow[8 + c]); };
  return {{column(0), column(1), column(2)}, column(3)};
}

Affine affineOfQform(const Fields& f) {
  auto [b, c, d] = f.quaternion;
  const double rest = 1 - (b * b + c * c + d * d);
  double a = rest > 0 ? std::sqrt(rest) : 0;
  if (rest < 0) {
    const double length = std::sqrt(b * b + c * c + d * d);
    b /= length, c /= length, d /= length;
  }
  const double qfac = f.pixdim[0] < 0 ? -1 : 1;
  return {{glm::dvec3(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)) * f.pixdim[1],
           glm::dvec3(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)) * f.pixdim[2],
           glm::dvec3(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - c * c - b * b) *
               (f.pixdim[3] * qfac)},
          glm::dvec3(f.qOffset[0], f.qOffset[1], f.qOffset[2])};
}

Affine affineOfPixdim(const Fields& f, const std::vector<std::uint64_t>& sizes) {
  const glm::dvec3 mm(std::abs(f.pixdim[1]), std::abs(f.pixdim[2]), std::abs(f.pixdim[3]));
  Affine affine{{glm::dvec3(-mm.x, 0, 0), {0, mm.y, 0}, {0, 0, mm.z}}, glm::dvec3(0)};
  for (std::size_t a = 0; a < sizes.size(); ++a)
    affine.origin -= affine.steps[a] * (double(sizes[a]) - 1) / 2.0;
  return affine;
}

// Returns the largest distance between corresponding corners of two grids, in the file's unit.
double largestDifference(const Affine& a, const Affine& b, const std::vector<std::uint64_t>& sizes) {
  double largest = 0;
  for (unsigned corner = 0; corner < (1u << sizes.size()); ++corner) {
    glm::dvec3 p = a.origin - b.origin;
    for (std::size_t n = 0; n < sizes.size(); ++n)
      if (corner >> n & 1) p += (a.steps[n] - b.steps[n]) * (double(sizes[n]) - 1);
    largest = std::max(largest, glm::length(p));
  }
  return largest;
}

// True if all numbers are present and the axes of the grid are linearly independent.
bool isPlace(const Affine& affine, const std::vector<std::uint64_t>& sizes) {
  if (glm::any(glm::isnan(affine.origin))) return false;
  for (std::size_t a = 0; a < 3; ++a) {
    if (glm::any(glm::isnan(affine.steps[a]))) return false;
    if (a < sizes.size() && affine.steps[a] == glm::dvec3(0)) return false;
  }
  const auto& [i, j, k] = affine.steps;
  if (sizes.size() == 2) return glm::cross(i, j) != glm::dvec3(0);
  return sizes.size() < 3 || glm::dot(glm::cross(i, j), k) != 0;
}

// Returns the sform, else the qform, whichever is valid first; empty if the header gives only sizes. Invalid
// or contradictory transforms add warnings.
std::optional<Affine> niftiAffine(const Fields& f, const std::vector<std::uint64_t>& sizes, double mm,
                                  std::vector<Warning>& warnings) {
  const Affine sform = affineOfSform(f), qform = affineOfQform(f);
  const bool isSform = f.sformCode > 0 && isPlace(sform, sizes),
             isQform = f.qformCode > 0 && isPlace(qform, sizes);
  const std::string instead = isSform   ? "the sform is taken."
                              : isQform ? "the qform is taken."
                                        : "the sizes of voxels alone are taken.";
  const char* const noPlace = " places no voxels (numbers that are missing, or axes that span no volume): ";
  if (f.sformCode > 0 && !isSform) warnings.push_back("The header's sform" + (noPlace + instead));
  if (f.qformCode > 0 && !isQform && !isSform) warnings.push_back("The header's qform" + (noPlace + instead));
  if (!isSform) return isQform ? std::optional(qform) : std::nullopt;
  const double apart = isQform ? largestDifference(sform, qform, sizes) * mm : 0;
  if (apart > 0.1)
    warnings.push_back("The header's sform and qform differ by up to " +
                       exactText(std::round(apart * 100) / 100) + " mm; the sform is taken.");
  return sform;
}

Status setNiftiGeometry(const Fields& f, const std::vector<std::uint64_t>& sizes, ImageHeader& image,
                        const std::string& path) {
  // Spatial units are metre, mm or micrometre; 0 is unknown and always means mm.
  const std::int64_t unit = f.units & 7;
  const double mm = unit == 1 ? 1000 : unit == 3 ? 1e-3 : 1;
  if (mm != 1)
    image.warnings.push_back(std::string("The header gives lengths in ") + (unit == 1 ? "m" : "um") +
                             "; they were converted to mm.");
  std::optional<Affine> affine = niftiAffine(f, sizes, mm, image.warnings);
  if (!affine) {
    for (std::size_t a = 0; a < sizes.size(); ++a)
      if (f.pixdim[a + 1] == 0 || !std::isfinite(f.pixdim[a + 1]))
        return setNominalGeometry(image, sizes, path);
    affine = affineOfPixdim(f, sizes);
    image.warnings.push_back(
        {"The header gives spacings but no directions: which side is left or top is not known.",
         WarningKind::noDirections});
  }
  const glm::dvec3 lpsFromRas(-mm, -mm, mm);
  std::vector<glm::dvec3> steps;
  for (std::size_t a = 0; a < 3; ++a)
    if (a < sizes.size() || affine->steps[a] != glm::dvec3(0)) steps.push_back(affine->steps[a] * lpsFromRas);
  return setGeometry(image, sizes, steps, affine->origin * lpsFromRas, path);
}

// Samples are in the file itself, or in the .img (or .img.gz) beside a .hdr.
Status findSamples(const Fields& f, bool compressed, SampleData& data, const std::string& path) {
  const double first = f.pair ? 0 : double(f.version == 1 ? bytesOfNifti1 : bytesOfNifti2);
  const double offset = !f.pair && f.voxOffset == 0 ? first + 4 : f.voxOffset;
  if (!(offset >= first && offset <= 1e12) || offset != std::floor(offset))
    return Error{path + " has the vox_offset " + exactText(f.voxOffset) + ", which is no place for samples."};
  if (!f.pair) {
    setDataAt(data, path, std::uint64_t(offset), compressed);
    return {};
  }
  const std::string name = lowerCase(path);
  if (!name.ends_with(".hdr") && !name.ends_with(".hdr.gz"))
    return Error{path + " says that it is the .hdr of a pair, but its name does not end in .hdr."};
  const auto samples = samplesOfPair(path);
  if (!samples) return samples.error();
  setDataAt(data, samples->path, std::uint64_t(offset), samples->compressed);
  return {};
}

// Axis 4 is time or diffusion direction; axis 5 holds the components of a voxel.
void nameVolumes(const std::vector<std::uint64_t>& trailing, ImageHeader& image, const std::string& path) {
  using enum OuterAxis::Kind;
  std::vector<double> bValues;
  if (trailing.size() == 1 && trailing[0] > 1) bValues = bValuesBeside(path, trailing[0], image.warnings);
  std::vector<OuterAxis> axes;
  for (std::size_t a = 0; a < trailing.size(); ++a)
    axes.push_back({a > 1 ? other : a == 1 ? component : bValues.empty() ? time : direction, trailing[a]});
  image.names = volumeNames(axes);
  for (std::size_t n = 0; n < bValues.size(); ++n) image.names[n].bValue = exactText(bValues[n]);
}

}  // namespace

bool isNiftiHead(const std::string& head) {
  bool bigEndian = false;
  return version(head, bigEndian) != 0;
}

Result<std::string> readDecompressedHead(const std::string& path, std::size_t count) {
  auto file = DataFile::open(path);
  if (!file) return file.error();
  std::string start(2, '\0');
  if (auto got = file->readAt(0, start.data(), 2); !got) return got.error();
  std::string head(count, '\0');
  auto got =
      decode(*file, 0, start == "\x1f\x8b" ? Encoding::deflate : Encoding::raw)->read(head.data(), count);
  if (!got) return got.error();
  head.resize(*got);
  return head;
}

Result<ImageHeader> readNiftiHeader(const std::string& path) {
  bool compressed = false;
  auto f = readFields(path, compressed);
  if (!f) return f.error();
  ImageHeader image;
  image.format = "NIfTI";
  image.description = f->description;
  auto type = niftiType(*f, path);
  if (!type) return type.error();
  image.data.type = *type;
  image.data.bigEndian = f->bigEndian;
  constexpr std::int64_t firstCifti = 3000, lastCifti = 3099;
  if (f->intent >= firstCifti && f->intent <= lastCifti)
    return Error{path + " is a CIFTI file (values on surfaces or a matrix), not a volume."};
  if (f->dim[0] < 1 || f->dim[0] > 7)
    return Error{path + " has " + std::to_string(f->dim[0]) + " dimensions; 1 to 7 is meant."};
  std::vector<std::uint64_t> grid, trailing;
  for (std::int64_t a = 1; a <= f->dim[0]; ++a) {
    if (f->dim[a] < 1) return Error{path + " has an axis of " + std::to_string(f->dim[a]) + " voxels."};
    (a <= 3 ? grid : trailing).push_back(std::uint64_t(f->dim[a]));
  }
  if (Status s = setCounts(image.data, {}, grid, trailing, path); !s) return s.error();
  nameVolumes(trailing, image, path);
  if (Status s = setNiftiGeometry(*f, grid, image, path); !s) return s.error();
  if (f->slope != 0 && std::isfinite(f->slope)) {
    if (!std::isfinite(f->intercept)) return Error{path + " has a scl_inter that is not finite."};
    image.slope = f->slope;
    image.intercept = f->intercept;
  }
  if (Status s = findSamples(*f, compressed, image.data, path); !s) return s.error();
  if (Status s = checkFiles(image.data); !s) return s.error();
  return image;
}

}  // namespace volumen
