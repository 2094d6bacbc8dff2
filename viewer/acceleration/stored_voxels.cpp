#include "viewer/acceleration/stored_voxels.h"

#include <algorithm>
#include <new>

#include "viewer/volume/available_memory.h"
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

// Returns the number of voxels of a grid with its rows padded to rowStride().
std::size_t paddedVoxels(glm::ivec3 size, int voxelBytes) {
  return std::size_t(rowStride(size.x, voxelBytes)) * size.y * size.z;
}

}  // namespace

std::size_t StoredVoxels::held() const {
  std::size_t sum = 0;
  if (facts_ && facts_->blockRanges)
    sum += facts_->blockRanges->bytes() + facts_->gradientBounds.size() * sizeof(float);
  if (density16_) sum += density16_->copy.bytes();
  if (density32_) sum += density32_->copy.bytes();
  if (density8_) sum += density8_->bytes.bytes();
  if (gradients16_) sum += gradients16_->gradients.xyzd.bytes();
  if (bricks16_) sum += bricks16_->bricks.bytes();
  if (gradients32_) sum += gradients32_->gradients.xyz0.bytes();
  if (voxels8_) sum += voxels8_->gradients.words.bytes();
  return sum;
}

bool StoredVoxels::hasRoomFor(std::uint64_t bytes) const {
  if (isAvailable(bytes)) return true;
  if (!makeRoom_) return false;
  try {
    makeRoom_(bytes);
  } catch (const std::bad_alloc&) {
    return false;
  }
  return isAvailable(bytes);
}

// Makes room for `bytes` and counts them from now on.
void StoredVoxels::begin(std::size_t bytes) {
  bytes_ = held();
  if (makeRoom_) makeRoom_(bytes);
  bytes_ += bytes;
}

const VolumeFacts& StoredVoxels::facts() {
  if (facts_) return *facts_;
  facts_ = factsOf(*volume_);
  bytes_ = held();
  return *facts_;
}

const Density16& StoredVoxels::densities16() {
  if (density16_) return *density16_;
  const double slope = volume_->slope();
  const ValueRange range = facts().range;
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
          begin(stored.size() * sizeof(std::int16_t));
          d.copy = converted<std::int16_t>(stored, [&](T v) { return std::int16_t(int(v) - shift); });
          d.data = d.copy.data();
        }
        if (std::is_same_v<T, std::uint16_t>) d.scale.intercept += 32768 * slope;
      },
      volume_->stored());
  d.scale.low = (range.low - d.scale.intercept) / slope;
  d.scale.high = (range.high - d.scale.intercept) / slope;
  density16_ = std::move(d);
  bytes_ = held();
  return *density16_;
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
        begin(stored.size() * sizeof(float));
        d.copy = converted<float>(stored, [&](T v) { return inUnits(volume_->realValue(v), units); });
        d.data = d.copy.data();
      },
      volume_->stored());
  d.scale = {units.slope, units.intercept, (range.low - units.intercept) / units.slope,
             (range.high - units.intercept) / units.slope};
  density32_ = std::move(d);
  bytes_ = held();
  return *density32_;
}

const Density8& StoredVoxels::densitiesIn8() {
  if (density8_) return *density8_;
  const ByteScale scale = byteScale(*volume_, facts().range);
  begin(std::size_t(volume_->geometry().voxelCount()));
  density8_ = densities8(*volume_, scale);
  bytes_ = held();
  return *density8_;
}

// Frees the gradients by the last operator first: two sets need not fit into memory.
const Gradients16& StoredVoxels::gradientsIn16(GradientOperator by) {
  if (gradients16_ && gradients16_->by == by) return gradients16_->gradients;
  gradients16_.reset();
  bricks16_.reset();
  begin(4 * sizeof(std::int16_t) * paddedVoxels(volume_->size(), 4 * sizeof(std::int16_t)));
  gradients16_ = {by, gradients16By(*volume_, by)};
  bytes_ = held();
  return gradients16_->gradients;
}

const GradientBricks16& StoredVoxels::gradientsOfBricks(const std::vector<std::uint8_t>& kept) {
  const auto areThere = [&] {
    return std::ranges::equal(kept, bricks16_->kept, [](auto asked, auto is) { return asked <= is; });
  };
  if (bricks16_ && areThere()) return bricks16_->bricks;
  bricks16_.reset();
  begin(GradientBricks16::bytesOf(std::ranges::count(kept, 1), GradientBricks16::countOf(volume_->size())));
  bricks16_ = {kept, sobelBricks16(*volume_, kept)};
  bytes_ = held();
  return bricks16_->bricks;
}

const Gradients32& StoredVoxels::gradientsIn32(GradientOperator by) {
  if (gradients32_ && gradients32_->by == by) return gradients32_->gradients;
  gradients32_.reset();
  begin(4 * sizeof(float) * std::size_t(volume_->geometry().voxelCount()));
  gradients32_ = {by, gradients32By(*volume_, by)};
  bytes_ = held();
  return gradients32_->gradients;
}

const Voxels8& StoredVoxels::voxelsIn8(GradientOperator by) {
  if (voxels8_ && voxels8_->by == by) return voxels8_->gradients;
  const ByteScale scale = byteScale(*volume_, facts().range);
  voxels8_.reset();
  begin(sizeof(std::uint32_t) * paddedVoxels(volume_->size(), sizeof(std::uint32_t)));
  voxels8_ = {by, voxels8By(*volume_, by, scale)};
  bytes_ = held();
  return voxels8_->gradients;
}

}  // namespace volumen
