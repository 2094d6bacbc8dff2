#include "viewer/recipe/step_kinds.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace volumen {

BitMask StepInput::own() const {
  const auto found = masks_.find(step_.segment);
  return found == masks_.end() ? BitMask(volume.geometry()) : found->second;
}

const BitMask& StepInput::segment(const char* field) const { return masks_.at(word(field)); }

std::vector<glm::ivec3> StepInput::voxelsAt(const char* field) const {
  std::vector<glm::ivec3> voxels;
  const VoxelGeometry& grid = volume.geometry();
  for (const glm::dvec3& p : places(field)) {
    const glm::dvec3 at = glm::floor(grid.voxelFromPatient(p) + 0.5);
    if (glm::all(glm::greaterThanEqual(at, glm::dvec3(0))) &&
        glm::all(glm::lessThan(at, glm::dvec3(grid.size))))
      voxels.emplace_back(at);
  }
  return voxels;
}

std::span<const StepKind> stepKinds() {
  static const std::vector<StepKind> all = [] {
    std::vector<StepKind> rows = stepsOfValues();
    for (auto* more : {&stepsOfParts, &stepsOfShape}) std::ranges::move(more(), std::back_inserter(rows));
    return rows;
  }();
  return all;
}

const StepKind* stepKind(const std::string& name) {
  const auto kinds = stepKinds();
  const auto found = std::ranges::find_if(kinds, [&](const StepKind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

}  // namespace volumen
