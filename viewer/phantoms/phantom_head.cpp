#include "viewer/phantoms/phantom_head.h"

#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <cmath>

#include "viewer/phantoms/head/anatomy.h"
#include "viewer/volume/buffer.h"

namespace volumen {
namespace {

using head::Vec;

constexpr double widthMm = 240, heightMm = 260, thickestSliceMm = 1.25;
constexpr float airHu = -1000, veinHu = 170, arteryHu = 290, noiseHu = 9;

// The distances that tissue depends on. They matter from `inner` mm inside to `outer` mm outside.
enum Field {
  cavity,
  skin,
  skull,
  jaw,
  spine,
  tooth,
  orbit,
  airway,
  sinus,
  vein,
  artery,
  canal,
  suture,
  fieldCount
};
struct FieldEntry {
  float (*distance)(Vec p, float cavity);
  float inner, outer;
};
template <float (*distance)(Vec)>
float alone(Vec p, float) {
  return distance(p);
}
constexpr std::array<FieldEntry, fieldCount> fields = {{
    {alone<head::cranialCavity>, 24, 34},
    {head::skin, 14, 2},
    {head::skull, 4, 1},
    {alone<head::jaw>, 3, 1},
    {alone<head::spine>, 3, 1},
    {[](Vec p, float) { return head::teeth(p).distance; }, 2, 1},
    {head::orbit, 1, 1},
    {alone<head::airways>, 1, 2},
    {head::sinuses, 1, 1},
    {head::veins, 1, 2},
    {alone<head::arteries>, 1, 2},
    {alone<head::spinalCanal>, 8, 1},
    {alone<head::sutureGap>, 1, 1},
}};

constexpr glm::ivec3 blockSize(8, 8, 4);

// A block of voxels so small that most distances do not matter in it. Those are computed once, at its centre.
// The others are computed on a lattice of about a millimetre, `stride` voxels in the slice, and interpolated
// linearly. Thin structures are computed at every voxel.
class Block {
 public:
  Block(Vec low, Vec spacing, float edgeMm) : low_(low), spacing_(spacing), w_(edgeMm) {
    stride_ = spacing.x < 0.3f ? 4 : spacing.x < 0.6f ? 2 : 1;
    const Vec half = 0.5f * Vec(blockSize) * spacing;
    // In wider blocks, structures far from the centre may still matter at a corner.
    const bool wide = glm::length(half) > 6.5f;
    const float reach = 1.5f * glm::length(half) + edgeMm;
    for (int f = 0; f < fieldCount; ++f) {
      const float d = fields[f].distance(low + half, f == cavity ? 0 : atCentre_[cavity]);
      near_[f] = wide || (d > -fields[f].inner - reach && d < fields[f].outer + reach);
      atCentre_[f] = d;
    }
    if (!onlyAir()) fillLattice();
  }

  bool onlyAir() const { return !near_[skin] && atCentre_[skin] > 0; }

  /// Returns the HU at voxel x of the block, before noise. Each tissue is painted over the ones before it.
  float value(glm::ivec3 x) const {
    const Vec p = low_ + Vec(x) * spacing_;
    const float dCavity = at(cavity, x);
    float hu = airHu;
    if (dCavity > -w_) hu = outsideTheBrain(p, x, dCavity);
    paint(hu, dCavity, [&](float d) { return head::brainValue(p, std::max(-d, 0.f), w_); });
    paint(hu, at(vein, x), veinHu);
    paint(hu, at(artery, x), arteryHu);
    return hu;
  }

 private:
  static constexpr int latticeEdge = blockSize.x + 1;

  void fillLattice() {
    for (int z = 0; z < blockSize.z; ++z)
      for (int y = 0; y <= blockSize.y; y += stride_)
        for (int x = 0; x <= blockSize.x; x += stride_) {
          const Vec p = low_ + Vec(x, y, z) * spacing_;
          auto& here = lattice_[(z * latticeEdge + y) * latticeEdge + x];
          for (int f = 0; f < fieldCount; ++f)
            here[f] = near_[f] && !thin(f) ? fields[f].distance(p, here[cavity]) : atCentre_[f];
        }
  }

  // The skin bounds nothing thin. Its edge is as soft as a slice is thick, which makes it look smooth.
  float skinEdge() const { return std::max(1.35f, w_); }

  static bool thin(int f) { return f == tooth || f == suture; }

  float at(Field f, glm::ivec3 x) const {
    if (!near_[f]) return atCentre_[f];
    if (thin(f)) return fields[f].distance(low_ + Vec(x) * spacing_, at(cavity, x));
    const int i = x.x - x.x % stride_, j = x.y - x.y % stride_;
    const float u = float(x.x - i) / stride_, v = float(x.y - j) / stride_;
    const auto* row = &lattice_[(x.z * latticeEdge + j) * latticeEdge + i];
    const auto* next = row + stride_ * latticeEdge;
    return glm::mix(glm::mix(row[0][f], row[stride_][f], u), glm::mix(next[0][f], next[stride_][f], u), v);
  }

  float outsideTheBrain(Vec p, glm::ivec3 x, float dCavity) const {
    const float dSkin = at(skin, x);
    if (dSkin > skinEdge()) return airHu;
    const float dSkull = at(skull, x);
    float hu = airHu;
    if (dSkull > -w_) hu = glm::mix(airHu, softTissue(p, x, -dSkin), head::cover(dSkin, skinEdge()));
    paint(hu, dSkull, [&](float d) { return vaultValue(p, std::max(d, -dCavity), at(suture, x)); });
    paint(hu, at(jaw, x), [&](float d) { return boneValue(p, d); });
    paint(hu, at(spine, x), [&](float d) { return boneValue(p, d); });
    paint(hu, at(tooth, x), [&](float) { return toothValue(p); });
    paint(hu, at(canal, x), [&](float d) { return canalValue(p, d); });
    paint(hu, at(airway, x), airHu);
    paint(hu, std::max(at(sinus, x), dSkull + 2.2f), airHu);
    return hu;
  }

  // Paints value(d) over hu, by the share of the voxel inside the surface at distance d.
  template <class Value>
  void paint(float& hu, float d, Value value) const {
    const float share = head::cover(d, w_);
    if (share > 0) hu = glm::mix(hu, float(value(d)), share);
  }
  void paint(float& hu, float d, float value) const { hu = glm::mix(hu, value, head::cover(d, w_)); }

  float softTissue(Vec p, glm::ivec3 x, float depth) const {
    float hu = head::softTissueValue(p, std::max(depth, 0.f), w_);
    paint(hu, at(orbit, x), [&](float) { return head::orbitValue(p, w_); });
    const float dAirway = at(airway, x);
    if (dAirway < 2.5f) hu = glm::mix(hu, 45.f, head::cover(dAirway - 1.5f, w_));  // Mucous membrane.
    return hu;
  }

  // Returns compact bone near the surface, spongy bone inside.
  float boneValue(Vec p, float d) const {
    const float spongy = 480 + 130 * head::noise(p / 2.2f);
    return glm::mix(1250 + 60 * head::noise(p / 6.f), spongy, head::cover(d + 2.2f, 0.9f));
  }

  // The bones of the vault leave gaps where they meet.
  float vaultValue(Vec p, float d, float gap) const {
    return glm::mix(boneValue(p, d), 60.f, head::cover(gap, w_));
  }

  float toothValue(Vec p) const {
    const head::Tooth t = head::teeth(p);
    const float enamel = head::cover(t.crown, 0.4f) * (1 - head::cover(t.distance + 1.2f, 0.5f));
    return glm::mix(glm::mix(1700.f, 2700.f, enamel), 150.f, head::cover(t.pulp, 0.5f));
  }

  float canalValue(Vec p, float d) const {
    const float cord = glm::length(Vec(p.x / 1.3f, p.y - 35.5f, 0)) - 4.8f;
    const float hu = glm::mix(8.f, 36.f, head::cover(cord, w_));
    return glm::mix(60.f, hu, head::cover(d + 0.8f, w_));
  }

  Vec low_, spacing_;
  float w_;
  int stride_ = 1;
  std::array<float, fieldCount> atCentre_{};
  std::array<bool, fieldCount> near_{};
  std::array<std::array<float, fieldCount>, latticeEdge * latticeEdge * blockSize.z> lattice_;
};

// CT noise of standard deviation noiseHu, slightly smoothed in the slice.
class Noise {
 public:
  explicit Noise(int slice) : slice_(slice) {}

  float at(int i, int j) const {
    const float sum = grain(i, j) * 2 + grain(i + 1, j) + grain(i, j + 1);
    return sum * (noiseHu / std::sqrt(6.f));
  }

 private:
  // The sum of four uniform bytes approximates a normal variable of variance 1.
  float grain(int i, int j) const {
    const std::uint32_t h = head::hashOf(i, j, slice_ ^ 0x5eed);
    const int sum = int(h & 255) + int((h >> 8) & 255) + int((h >> 16) & 255) + int(h >> 24);
    return float(sum - 510) / 147.8f;
  }
  int slice_;
};

// Calls put(index in memory, value) for every voxel of a block.
template <class Put>
void fillBlock(const VoxelGeometry& g, glm::ivec3 first, const Put& put) {
  const glm::ivec3 last = glm::min(first + blockSize, g.size);
  const Vec spacing(g.spacing());
  const Block block(Vec(g.patientFromVoxel(first)), spacing, std::max(1.f, 0.6f * spacing.x));
  const bool onlyAir = block.onlyAir();
  for (int k = first.z; k < last.z; ++k) {
    const Noise noise(k);
    for (int j = first.y; j < last.y; ++j)
      for (int i = first.x; i < last.x; ++i) {
        const float hu = (onlyAir ? airHu : block.value(glm::ivec3(i, j, k) - first)) + noise.at(i, j);
        put((std::size_t(k) * g.size.y + j) * g.size.x + i,
            std::int16_t(std::floor(std::clamp(hu, -1024.f, 3071.f) + 0.5f)));
      }
  }
}

}  // namespace

VoxelGeometry headGeometry(int sizeInPlane) {
  const double pixelMm = widthMm / sizeInPlane;
  const double sliceMm = std::max(pixelMm, std::min(thickestSliceMm, pixelMm * 8 / 3));
  const int slices = int(std::ceil(heightMm / sliceMm));
  VoxelGeometry g{.size = {sizeInPlane, sizeInPlane, slices}};
  for (int a = 0; a < 3; ++a) g.patientFromVoxelStep[a][a] = a < 2 ? pixelMm : sliceMm;
  g.origin = -0.5 * (glm::dvec3(g.size) - 1.0) * glm::dvec3(pixelMm, pixelMm, sliceMm);
  return g;
}

VolumeParts headPhantom(int sizeInPlane) {
  const VoxelGeometry g = headGeometry(sizeInPlane);
  auto values = zeros<std::int16_t>(std::size_t(g.voxelCount()));
  const glm::ivec3 blocks = (g.size + blockSize - 1) / blockSize;
  tbb::parallel_for(0, blocks.z * blocks.y, [&](int n) {
    for (int i = 0; i < blocks.x; ++i)
      fillBlock(g, glm::ivec3(i, n % blocks.y, n / blocks.y) * blockSize,
                [&](std::size_t at, std::int16_t value) { values[at] = value; });
  });
  return headPhantom(sizeInPlane, std::move(values));
}

VolumeParts headPhantom(int sizeInPlane, std::vector<std::int16_t> values) {
  VolumeParts parts;
  parts.geometry = headGeometry(sizeInPlane);
  parts.values = std::move(values);
  parts.attributes.modality = "CT";
  parts.attributes.windows = {{40, 400}, {40, 80}, {500, 2500}};
  return parts;
}

bool areHeadPhantoms(int sizeInPlane, const std::vector<std::int16_t>& values) {
  constexpr int everyBlock = 211;  // A prime, so that no row or column of blocks is left out.
  const VoxelGeometry g = headGeometry(sizeInPlane);
  if (values.size() != std::size_t(g.voxelCount())) return false;
  const glm::ivec3 blocks = (g.size + blockSize - 1) / blockSize;
  const int count = blocks.x * blocks.y * blocks.z;
  std::atomic<bool> same = true;
  tbb::parallel_for(0, count / everyBlock, [&](int part) {
    const int n = part * everyBlock;
    const glm::ivec3 block(n % blocks.x, n / blocks.x % blocks.y, n / blocks.x / blocks.y);
    fillBlock(g, block * blockSize, [&](std::size_t at, std::int16_t value) {
      if (values[at] != value) same = false;
    });
  });
  return same;
}

}  // namespace volumen
