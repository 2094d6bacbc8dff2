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

/// The header of an image file of any format: one grid with one or several volumes.
struct ImageHeader {
  std::string format;  ///< "NRRD", "NIfTI", "MetaImage", "Analyze", "MGH", "GIPL", "VTK", "MRC"
  std::string description, modality;
  SampleData data;
  VoxelGeometry geometry;
  double slope = 1, intercept = 0;
  std::vector<VolumeName> names;  ///< one a volume; empty if nothing distinguishes them
  std::vector<std::pair<std::string, std::string>> keyValues;  ///< NRRD only; keys are unique
  std::vector<Warning> warnings;
};

/// Limits of headers and of lists of data files.
constexpr std::size_t mostHeaderBytes = 1 << 20;
constexpr std::size_t mostDataFiles = 10000;

/// Sets the data files that a header at `path` lists; each is resolved below its folder. The Error: no files,
/// more than mostDataFiles, or an Error of resolveBeside().
Status setDataFiles(SampleData& data, const std::vector<std::string>& names, const std::string& path);

/// Sets the geometry from the steps (mm, LPS) of one to three grid axes; `sizes` has as many entries. A
/// missing third axis gets 1 mm along the normal, with a warning. The Error: steps are not finite, zero, or
/// linearly dependent.
Status setGeometry(ImageHeader& header, const std::vector<std::uint64_t>& sizes,
                   std::vector<glm::dvec3> steps, glm::dvec3 origin, const std::string& path);

/// Sets a nominal spacing of 1 mm with a warning; the geometry is not calibrated. Used if spacing is unknown.
Status setNominalGeometry(ImageHeader& header, const std::vector<std::uint64_t>& sizes,
                          const std::string& path);

}  // namespace volumen
