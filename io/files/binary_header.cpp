#include "io/files/binary_header.h"

#include "io/files/data_file.h"
#include "io/files/nifti.h"

namespace volumen {

Result<BinaryHeader> readBinaryHeader(const std::string& path, std::size_t count) {
  const auto start = readHead(path, 2);
  if (!start) return start.error();
  auto head = readDecompressedHead(path, count);
  if (!head) return head.error();
  if (head->size() < count)
    return Error{path + " is cut off: it has " + std::to_string(head->size()) +
                 " bytes, and its header needs " + std::to_string(count) + "."};
  return BinaryHeader{std::move(*head), *start == "\x1f\x8b"};
}

void setDataAt(SampleData& data, const std::string& path, std::uint64_t offset, bool compressed) {
  data.files = {path};
  if (compressed)
    data.encoding = Encoding::deflate, data.byteSkip = std::int64_t(offset);
  else
    data.offset = offset;
}

Status setUnorientedGrid(ImageHeader& header, const std::vector<std::uint64_t>& sizes,
                         const std::vector<double>& spacings, glm::dvec3 origin, const std::string& path) {
  std::vector<glm::dvec3> steps;
  for (std::size_t a = 0; a < sizes.size(); ++a) {
    if (!(spacings[a] > 0)) return setNominalGeometry(header, sizes, path);
    glm::dvec3 step(0);
    step[int(a)] = spacings[a];
    steps.push_back(step);
  }
  header.warnings.push_back(
      {"The header gives spacings but no directions: which side is left or top is not known.",
       WarningKind::noDirections});
  return setGeometry(header, sizes, steps, origin, path);
}

Result<std::vector<std::uint64_t>> setSizes(ImageHeader& header, const std::vector<std::int64_t>& sizes,
                                            const std::string& path) {
  std::vector<std::uint64_t> grid, outer;
  std::vector<OuterAxis> axes;
  for (std::size_t a = 0; a < sizes.size(); ++a) {
    if (sizes[a] < 1) return Error{path + " has an axis of " + std::to_string(sizes[a]) + " voxels."};
    (a < 3 ? grid : outer).push_back(std::uint64_t(sizes[a]));
    if (a >= 3) axes.push_back({a == 3 ? OuterAxis::Kind::time : OuterAxis::Kind::other, outer.back()});
  }
  if (Status s = setCounts(header.data, {}, grid, outer, path); !s) return s.error();
  header.names = volumeNames(axes);
  return grid;
}

}  // namespace volumen
