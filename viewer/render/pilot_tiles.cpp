#include "viewer/render/pilot_tiles.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include "viewer/kernels/ray_generator.h"
#include "viewer/plan/rule_lines.h"
#include "viewer/scene/step_length.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr int tile = RayGenerator::tile;
constexpr double shareOfTiles = 1.0 / 4;
constexpr int fewestTiles = 192;  // fewer seldom determine a 99th percentile

// Path of a ray through a block: the fraction of its light that may be misjudged there, and the largest
// transmittance.
struct Way {
  float change = 0, through = 1;
};

// Returns red, green and blue times the extinction, and the extinction, 1/mm.
glm::dvec4 matterOf(const CurvePoint& p, double unitMm) {
  const double extinction = -std::log1p(-std::min(p.opacity, 0.9999)) / unitMm;
  return {extinction * p.colour, extinction};
}

glm::dvec4 matterAt(const TransferFunction& curve, double value) {
  const auto& points = curve.points;
  const auto behind =
      std::ranges::upper_bound(points, value, {}, [](const CurvePoint& p) { return double(p.value); });
  if (behind == points.begin() || behind == points.end())
    return matterOf(behind == points.end() ? points.back() : points.front(), curve.unitDistance);
  const CurvePoint &a = behind[-1], &b = *behind;
  const double s = (value - a.value) / (double(b.value) - a.value);
  return matterOf({float(value), glm::mix(a.colour, b.colour, s), glm::mix(a.opacity, b.opacity, s)},
                  curve.unitDistance);
}

struct Extremes {
  glm::dvec4 low{1e300}, high{0};
  void takeIn(const glm::dvec4& matter) { low = glm::min(low, matter), high = glm::max(high, matter); }
  void takeIn(const Extremes& e) { low = glm::min(low, e.low), high = glm::max(high, e.high); }
};

// Returns the paths of length `mm` through blocks with values between two levels: entry lowest * levels +
// highest.
std::vector<Way> waysOf(const Plan& plan, const std::vector<float>& levels, double mm) {
  const TransferFunction& curve = plan.curve;
  std::vector<Extremes> upTo(levels.size());  // over values from the level before
  for (std::size_t n = 0; n < levels.size(); ++n) {
    const float before = levels[n > 0 ? n - 1 : n];
    upTo[n].takeIn(matterAt(curve, levels[n]));
    if (n > 0) upTo[n].takeIn(matterAt(curve, before));
    for (const CurvePoint& p : curve.points)
      if (p.value >= before && p.value <= levels[n]) upTo[n].takeIn(matterOf(p, curve.unitDistance));
  }
  // Where values differ, gradients turn, and light and gradient opacity with them, which block ranges do not
  // tell.
  const bool faded = !curve.gradientOpacity.empty();
  const double turns = faded ? 1 : plan.scene.shading.lit ? 0.3 : 0;
  const double bright = std::max(1.0, brightest(plan.scene));
  std::vector<Way> ways(levels.size() * levels.size());
  for (std::size_t low = 0; low < levels.size(); ++low) {
    Extremes e;
    e.takeIn(matterAt(curve, levels[low]));
    for (std::size_t high = low; high < levels.size(); ++high) {
      if (high > low) e.takeIn(upTo[high]);
      const glm::dvec4 by = e.high - e.low;
      const double change = std::max({by.r, by.g, by.b, by.a, high > low ? turns * e.high.a : 0});
      ways[low * levels.size() + high] = {float(std::min(1.0, change * bright * mm)),
                                          faded ? 1.0f : float(std::exp(-e.low.a * mm))};
    }
  }
  return ways;
}

// Follows rays from block to block.
class BlockWalk {
 public:
  BlockWalk(const Plan& plan, const VolumeFacts& facts)
      : blockRanges_(*facts.blockRanges),
        ways_(waysOf(plan, blockRanges_.levels,
                     stepMm(*plan.scene.camera, facts.geometry, blockRanges_.edge))) {}

  // Returns the fraction of a ray's light that may be misjudged, at most 1.
  float changeOn(const RayRow& rays, int ray) const {
    const float inBlocks = 1.0f / float(blockRanges_.edge);
    const glm::vec3 move = glm::vec3(rays.moveX[ray], rays.moveY[ray], rays.moveZ[ray]) * inBlocks;
    glm::vec3 at = glm::vec3(rays.startX[ray], rays.startY[ray], rays.startZ[ray]) * inBlocks + 0.5f * move;
    const glm::vec3 last(blockRanges_.count - 1);
    float change = 0, light = 1;
    for (int n = 0; n < rays.steps[ray] && light > 1.0f / 256; ++n, at += move) {
      const glm::ivec3 block(glm::clamp(at, glm::vec3(0), last));
      const std::size_t b =
          (std::size_t(block.z) * blockRanges_.count.y + block.y) * blockRanges_.count.x + block.x;
      const Way& way = ways_[blockRanges_.lowest[b] * blockRanges_.levels.size() + blockRanges_.highest[b]];
      change += light * way.change;
      light *= way.through;
    }
    return std::min(change, 1.0f);
  }

 private:
  const BlockRanges& blockRanges_;
  std::vector<Way> ways_;
};

// Returns the largest such fraction over the rays of each tile. Rays are a block apart, so that they hit
// everything larger.
std::vector<float> changeOfTiles(const Plan& plan, const VolumeFacts& facts, glm::ivec2 size,
                                 glm::ivec2 grid) {
  std::vector<float> changes(std::size_t(grid.x) * grid.y, 1.0f);
  if (!facts.blockRanges) return changes;
  const Camera& camera = *plan.scene.camera;
  const glm::dvec3 spacing = facts.geometry.spacing();
  const double heightMm = camera.projection == Projection::parallel
                              ? camera.height
                              : 2 * camera.distance * std::tan(glm::radians(camera.fov) / 2);
  const double blocks = heightMm / (facts.blockRanges->edge * std::min({spacing.x, spacing.y, spacing.z}));
  const int rows = int(std::clamp(blocks, 1.0 * grid.y, 2.0 * size.y));
  const double scale = double(size.y) / rows;  // pixels between rays
  const glm::ivec2 count(int(std::ceil(size.x / scale)), rows);
  const RayGenerator setup(plan.scene, facts.geometry, count, facts.blockRanges->edge, plan.clip);
  const BlockWalk walk(plan, facts);
  std::vector<float> ofRays(std::size_t(count.x) * count.y);
  parallelFor(count.y, plan.options.threads, [&](std::int64_t begin, std::int64_t end) {
    RayRow rays;
    for (std::int64_t y = begin; y < end; ++y) {
      setup.makeRays(0, int(y), count.x, rays);
      for (int x = 0; x < count.x; ++x) ofRays[std::size_t(y) * count.x + x] = walk.changeOn(rays, x);
    }
  });
  std::ranges::fill(changes, 0.0f);
  for (int y = 0; y < count.y; ++y)
    for (int x = 0; x < count.x; ++x) {
      const glm::dvec2 pixel =
          (glm::dvec2(x, y) + 0.5 - glm::dvec2(count) / 2.0) * scale + glm::dvec2(size) / 2.0;
      const glm::ivec2 at = glm::clamp(glm::ivec2(glm::floor(pixel / double(tile))), glm::ivec2(0), grid - 1);
      float& change = changes[std::size_t(at.y) * grid.x + at.x];
      change = std::max(change, ofRays[std::size_t(y) * count.x + x]);
    }
  return changes;
}

struct Choice {
  bool chosen = false;
  double chance = 0;
};

// Chooses one tile in each cell of a grid, at a position that depends only on the cell. Tiles in rows and
// columns could all miss straight upright structures.
void chooseEvenly(glm::ivec2 grid, double wanted, std::vector<Choice>& choices) {
  const double shrink = std::min(1.0, std::sqrt(wanted / (double(grid.x) * grid.y)));
  const glm::ivec2 cells = glm::max(glm::ivec2(1), glm::ivec2(glm::ceil(glm::dvec2(grid) * shrink)));
  for (int y = 0; y < cells.y; ++y)
    for (int x = 0; x < cells.x; ++x) {
      // The additive recurrence of the plastic number fills a square evenly.
      const double n = x + double(y) * cells.x;
      const glm::dvec2 place = glm::fract(n * glm::dvec2(0.7548776662466927, 0.5698402909980532));
      const glm::ivec2 begin = glm::ivec2(x, y) * grid / cells, end = glm::ivec2(x + 1, y + 1) * grid / cells;
      const glm::ivec2 taken = begin + glm::ivec2(place * glm::dvec2(end - begin));
      for (int ty = begin.y; ty < end.y; ++ty)
        for (int tx = begin.x; tx < end.x; ++tx)
          choices[std::size_t(ty) * grid.x + tx] = {glm::ivec2(tx, ty) == taken,
                                                    1.0 / ((end.x - begin.x) * (end.y - begin.y))};
    }
}

// Chooses `wanted` more tiles with probabilities proportional to the squared possible error, its share in a
// mean square, up to certainty.
void chooseByChange(const std::vector<float>& changes, double wanted, std::vector<Choice>& choices) {
  const auto chanceAt = [&](float change, double scale) {
    return std::min(1.0, scale * double(change) * change);
  };
  double scale = 0;
  for (double step = 0x1p40; step > 0x1p-10; step /= 2) {
    double sum = 0;
    for (float change : changes) sum += chanceAt(change, scale + step);
    if (sum <= wanted) scale += step;
  }
  double passed = 0.5;
  for (std::size_t n = 0; n < changes.size(); ++n) {
    const double chance = chanceAt(changes[n], scale), before = std::floor(passed);
    passed += chance;
    choices[n].chosen |= std::floor(passed) > before;
    choices[n].chance = 1 - (1 - choices[n].chance) * (1 - chance);
  }
}

}  // namespace

std::vector<PilotTile> pilotTiles(const Plan& plan, const VolumeFacts& facts, glm::ivec2 size) {
  const glm::ivec2 grid = (size + (tile - 1)) / tile;
  const double all = double(grid.x) * grid.y,
               wanted = std::min(all, std::max<double>(fewestTiles, shareOfTiles * all));
  std::vector<Choice> choices(std::size_t(grid.x) * grid.y);
  chooseEvenly(grid, wanted / 2, choices);
  chooseByChange(changeOfTiles(plan, facts, size, grid), wanted / 2, choices);
  std::vector<PilotTile> tiles;
  for (std::size_t n = 0; n < choices.size(); ++n)
    if (choices[n].chosen)
      tiles.push_back({tile * glm::ivec2(int(n) % grid.x, int(n) / grid.x), choices[n].chance});
  // A quarter, or a half, of the tiles comes first.
  std::vector<PilotTile> inOrder;
  for (const std::size_t first : {0, 2, 1, 3})
    for (std::size_t n = first; n < tiles.size(); n += 4) inOrder.push_back(tiles[n]);
  return inOrder;
}

}  // namespace volumen
