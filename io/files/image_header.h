#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/files/sample_data.h"
#include "io/files/volume_names.h"
#include "io/study/warning.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// What the header of an image file says, whatever its format: one grid, one or several volumes on it.
struct ImageHeader {
  std::string format;  ///< "NRRD", "NIfTI", "MetaImage", "Analyze", "MGH", "GIPL", "VTK", "MRC"
  std::string description, modality;
  SampleData data;
  VoxelGeometry geometry;
  double slope = 1, intercept = 0;
  std::vector<VolumeName> names;  ///< one a volume; empty where nothing tells them apart
  std::vector<std::pair<std::string, std::string>> keyValues;  ///< of NRRD: each key once
  std::vector<Warning> warnings;
};

/// Headers and lists of data files may be this long.
constexpr std::size_t mostHeaderBytes = 1 << 20;
constexpr std::size_t mostDataFiles = 10000;

/// Names the data files that a header at `path` lists, each resolved below its folder. Refused: none, more
/// than mostDataFiles, and what resolveBeside() refuses.
Status setDataFiles(SampleData& data, const std::vector<std::string>& names, const std::string& path);

/// Sets the geometry from the steps (mm, LPS) of the one to three axes of the grid; `sizes` has as many
/// entries. A missing third axis gets 1 mm along the normal, with a warning. Refused: what is not finite,
/// zero, or does not span space.
Status setGeometry(ImageHeader& header, const std::vector<std::uint64_t>& sizes,
                   std::vector<glm::dvec3> steps, glm::dvec3 origin, const std::string& path);

/// Where no spacing is known: a nominal 1 mm, not calibrated, with a warning.
Status setNominalGeometry(ImageHeader& header, const std::vector<std::uint64_t>& sizes,
                          const std::string& path);

}  // namespace volumen
