#pragma once

#include <string>

#include "io/contours.h"
#include "io/frames.h"
#include "io/open.h"
#include "io/report.h"
#include "io/segmentation.h"

namespace volumen::tests {

/// Returns whether there is a value, or else a sentence that names the file.
template <class Value>
bool isReadOrRefused(const Result<Value>& loaded, const std::string& path) {
  return loaded || (loaded.message().starts_with(path + ": ") && loaded.message().ends_with("."));
}

/// Reads the file as the kind it claims to be, and uses the result.
inline bool survives(const std::string& path) {
  const Result<Study> study = openStudy(path);
  if (!study) return false;
  for (const DerivedObject& object : study->derived) {
    const Result<Presentation> state = loadPresentation(path);
    const Result<Segmentation> segmentation = loadSegmentation(path);
    const Result<StructureSet> contours = loadContours(path);
    if (!isReadOrRefused(state, path) || !isReadOrRefused(segmentation, path) ||
        !isReadOrRefused(contours, path) || !isReadOrRefused(loadReport(path), path) ||
        !isReadOrRefused(loadKeyObjects(path), path))
      return false;
    if (state) {
      const FramePresentation how = presentationOf(
          *state, object.pictures.empty() ? "" : object.pictures[0].sopInstanceUid, 0, {128, 128});
      for (const Graphic& graphic : how.graphics)
        if (outlineOf(graphic).size() < graphic.points.size()) return false;
    }
    if (segmentation) {
      VoxelGeometry grid;
      grid.size = {16, 16, 4};
      std::size_t segments = 0;
      for (const Segmented& map : segmentedOf(*segmentation, grid)) segments += map.segments.size();
      if (segments != segmentation->segments.size()) return false;
      const Result<VoxelGeometry> own = gridOf(*segmentation);
      if (own && own->voxelCount() < 1) return false;
    }
    if (contours)
      for (const RegionOfInterest& region : contours->regions)
        for (const Contour& contour : region.contours)
          if (!(areaOf(contour) >= 0)) return false;
  }
  return true;
}

}  // namespace volumen::tests
