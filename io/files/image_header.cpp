#include "io/files/image_header.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "io/files/data_file.h"

namespace volumen {

namespace {

// Returns a unit vector perpendicular to the given ones.
glm::dvec3 missingAxis(const std::vector<glm::dvec3>& steps) {
  if (steps.size() == 2) return glm::normalize(glm::cross(steps[0], steps[1]));
  const glm::dvec3 a = glm::abs(steps[0]);
  const glm::dvec3 other = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                           : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                    : glm::dvec3(0, 0, 1);
  return glm::normalize(glm::cross(other, steps[0]));
}

Status setSize(VoxelGeometry& g, const std::vector<std::uint64_t>& sizes, const std::string& path) {
  for (std::size_t a = 0; a < sizes.size(); ++a) {
    if (sizes[a] < 1 || sizes[a] > std::uint64_t(std::numeric_limits<int>::max()))
      return Error{path + " has an axis of " + std::to_string(sizes[a]) + " voxels."};
    g.size[int(a)] = int(sizes[a]);
  }
  return {};
}

// Within these limits squares and determinants are finite and meaningful.
bool isLength(double mm) { return mm > 1e-9 && mm < 1e9; }

}  // namespace

Status setDataFiles(SampleData& data, const std::vector<std::string>& names, const std::string& path) {
  if (names.empty() || names.size() > mostDataFiles)
    return Error{path + " lists " + std::to_string(names.size()) + " data files; 1 to " +
                 std::to_string(mostDataFiles) + " can be read."};
  for (const std::string& name : names) {
    auto file = resolveBeside(path, name);
    if (!file) return file.error();
    data.files.push_back(*file);
  }
  return {};
}

Status setGeometry(ImageHeader& header, const std::vector<std::uint64_t>& sizes,
                   std::vector<glm::dvec3> steps, glm::dvec3 origin, const std::string& path) {
  VoxelGeometry& g = header.geometry;
  if (Status s = setSize(g, sizes, path); !s) return s;
  for (const glm::dvec3& step : steps)
    if (!isLength(glm::length(step)))
      return Error{path + " gives a voxel spacing or direction that is zero, not finite or absurdly large."};
  if (!(glm::length(origin) < 1e9))
    return Error{path + " gives a position that is not finite or absurdly large."};
  if (steps.size() < 3)
    header.warnings.emplace_back("A single slice of unknown thickness: shown 1 mm thick.");
  while (steps.size() < 3) steps.push_back(missingAxis(steps));
  g.patientFromVoxelStep = glm::dmat3(steps[0], steps[1], steps[2]);
  g.origin = origin;
  const glm::dvec3 s = g.spacing();
  if (!(g.voxelVolume() / (s.x * s.y * s.z) > 1e-9))
    return Error{path + " gives voxel directions that do not span space."};
  return {};
}

Status setNominalGeometry(ImageHeader& header, const std::vector<std::uint64_t>& sizes,
                          const std::string& path) {
  header.geometry.calibrated = false;
  header.warnings.push_back(
      {"Not calibrated: no measurements in mm (the header gives no voxel spacing); shown with voxels of 1 "
       "mm.",
       WarningKind::notCalibrated});
  return setSize(header.geometry, sizes, path);
}

}  // namespace volumen
