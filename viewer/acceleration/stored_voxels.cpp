#include "viewer/acceleration/stored_voxels.h"

#include "viewer/volume/float_units.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Returns a copy of the samples, each converted by `convert`, using all cores.
template <class T, class From, class Convert>
Buffer<T> converted(const std::vector<From>& stored, Convert convert) {
  Buffer<T> out(stored.size());
  constexpr std::int64_t chunk = 1 << 18;
  const std::int64_t count = std::int64_t(stored.size());
  parallelFor((count + chunk - 1) / chunk, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin * chunk; n < std::min(count, end * chunk); ++n) out[n] = convert(stored[n]);
  });
  return out;
}

}  // namespace

const VolumeFacts& StoredVoxels::facts() {
  if (!facts_) facts_ = factsOf(*volume_);
  return *facts_;
}

const Density16& StoredVoxels::densities16() {
  if (density16_) return *density16_;
  const double slope = volume_->slope();
  Density16 d;
  d.scale = {slope, volume_->intercept(), 0, 0};
  // A kernel reads a voxel and its neighbour along i in one load. With one voxel along i that would read past
  // the end of the samples.
  const bool ownSamples = volume_->size().x > 1;
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (std::is_same_v<T, float>) {
          return;
        } else if (sizeof(T) == 2 && ownSamples) {
          d.data = reinterpret_cast<const std::int16_t*>(stored.data());
          if (std::is_same_v<T, std::uint16_t>) d.flip = 0x80008000u;
        } else {
          const int shift = std::is_same_v<T, std::uint16_t> ? 32768 : 0;
          d.copy = converted<std::int16_t>(stored, [&](T v) { return std::int16_t(int(v) - shift); });
          d.data = d.copy.data();
        }
        if (std::is_same_v<T, std::uint16_t>) d.scale.intercept += 32768 * slope;
      },
      volume_->stored());
  const ValueRange range = facts().range;
  d.scale.low = (range.low - d.scale.intercept) / slope;
  d.scale.high = (range.high - d.scale.intercept) / slope;
  return density16_.emplace(std::move(d));
}

const Density32& StoredVoxels::densities32() {
  if (density32_) return *density32_;
  Density32 d;
  const ValueRange range = facts().range;
  const FloatUnits units = floatUnits(range);
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (std::is_same_v<T, float>) d.data = stored.data();
        if (d.data && units == FloatUnits()) return;
        d.copy = converted<float>(stored, [&](T v) { return inUnits(volume_->realValue(v), units); });
        d.data = d.copy.data();
      },
      volume_->stored());
  d.scale = {units.slope, units.intercept, (range.low - units.intercept) / units.slope,
             (range.high - units.intercept) / units.slope};
  return density32_.emplace(std::move(d));
}

const Density8& StoredVoxels::densitiesIn8() {
  if (!density8_) density8_ = densities8(*volume_, byteScale(*volume_, facts().range));
  return *density8_;
}

const Gradients16& StoredVoxels::gradientsIn16(GradientOperator by) {
  if (!gradients16_ || gradients16_->by != by) {
    gradients16_.reset();  // Frees the old gradients first: two sets need not fit into memory.
    gradients16_ = {by, gradients16By(*volume_, by)};
  }
  return gradients16_->gradients;
}

const Gradients32& StoredVoxels::gradientsIn32(GradientOperator by) {
  if (!gradients32_ || gradients32_->by != by) {
    gradients32_.reset();
    gradients32_ = {by, gradients32By(*volume_, by)};
  }
  return gradients32_->gradients;
}

const Voxels8& StoredVoxels::voxelsIn8(GradientOperator by) {
  if (!voxels8_ || voxels8_->by != by) {
    voxels8_.reset();
    voxels8_ = {by, voxels8By(*volume_, by, byteScale(*volume_, facts().range))};
  }
  return voxels8_->gradients;
}

}  // namespace volumen
