#include "viewer/render/methods/slice_row.h"

#include <algorithm>
#include <limits>

namespace volumen {

void unitsOfSlice(const RayRow& rays, int n, float inverseUnitMm, std::vector<float>& units) {
  units.resize(rays.steps.size());
  for (std::size_t ray = 0; ray < units.size(); ++ray) {
    const int left = rays.steps[ray] - n;
    const float mm = left > 1 ? rays.stepMm[ray] : left == 1 ? rays.lastStepMm[ray] : 0;
    units[ray] = mm * inverseUnitMm;
  }
}

int longestOf(const RayRow& rays) { return *std::max_element(rays.steps.begin(), rays.steps.end()); }

ProjectedRow::ProjectedRow(Mode mode, std::size_t count) : mode_(mode) {
  constexpr float most = std::numeric_limits<float>::max();
  values_.assign(count, mode == Mode::mip ? -most : mode == Mode::minip ? most : 0);
  if (mode != Mode::average) return;
  sums_.assign(count, 0);
  lengths_.assign(count, 0);
}

void ProjectedRow::add(const float* density, const float* units) {
  for (std::size_t n = 0; n < values_.size(); ++n) {
    if (!(units[n] > 0)) continue;
    if (mode_ == Mode::mip) values_[n] = std::max(values_[n], density[n]);
    if (mode_ == Mode::minip) values_[n] = std::min(values_[n], density[n]);
    if (mode_ != Mode::average) continue;
    sums_[n] += double(units[n]) * density[n];
    lengths_[n] += units[n];
  }
}

const float* ProjectedRow::result() {
  for (std::size_t n = 0; n < lengths_.size(); ++n)
    values_[n] = lengths_[n] > 0 ? float(sums_[n] / lengths_[n]) : 0;
  return values_.data();
}

}  // namespace volumen
