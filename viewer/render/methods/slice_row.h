#pragma once

#include <vector>

#include "viewer/render/kernels/samples.h"
#include "viewer/render/methods/planes_frame.h"

namespace volumen {

/// Lengths of the n-th intervals of a row's rays in unit distances (SCENE 9); 0 where a ray has no n-th.
void unitsOfSlice(const RayRow& rays, int n, float inverseUnitMm, std::vector<float>& units);

/// The most samples that a ray of the row has.
int longestOf(const RayRow& rays);

/// Projects densities slice by slice (SCENE 9).
class ProjectedRow {
 public:
  ProjectedRow(Mode mode, std::size_t count);
  /// The samples of one slice; `units` as of unitsOfSlice.
  void add(const float* density, const float* units);
  /// The density of each ray: extreme, or mean by length. Ends the row.
  const float* result();

 private:
  Mode mode_;
  std::vector<float> values_;
  std::vector<double> sums_, lengths_;  ///< of the average
};

}  // namespace volumen
