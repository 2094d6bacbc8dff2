#include "viewer/render/methods/slice_row.h"

#include <algorithm>
#include <limits>

namespace volumen {

void unitsOfSlice(const RayRow& rays, int n, float inverseUnitMm, std::vector<float>& units) {
  units.resize(rays.steps.size());
  // Without a branch, so that the compiler takes several rays at a time.
  const int* steps = rays.steps.data();
  const float *full = rays.stepMm.data(), *last = rays.lastStepMm.data();
  float* out = units.data();
  for (std::size_t ray = 0, count = units.size(); ray < count; ++ray) {
    const float whole = full[ray], rest = last[ray];
    const int left = steps[ray] - n;
    const float some = left > 1 ? whole : rest;
    out[ray] = (left > 0 ? some : 0.0f) * inverseUnitMm;
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
