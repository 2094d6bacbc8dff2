#include "viewer/render/pilot.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "viewer/render/methods/row_painter.h"
#include "viewer/render/rays.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// The rays of a pilot stand in tiles, that many pixels apart: near enough to meet the same blocks and memory,
// far enough to differ. More of them would tell little more.
constexpr int pixelsApart = 4, mostTiles = 256, tilesATask = 4;

// First pixels of tiles of a picture, one in each cell of a grid, at a place that only the cell decides:
// tiles in rows and columns could all pass by what is straight and upright. First a quarter of them.
std::vector<glm::ivec2> tilesOf(glm::ivec2 size) {
  constexpr int tile = RaySetup::tile;
  const double shrink = std::min(1.0, std::sqrt(double(mostTiles) * tile * tile / (double(size.x) * size.y)));
  const glm::ivec2 grid = glm::max(glm::ivec2(1), glm::ivec2(glm::dvec2(size) / double(tile) * shrink));
  std::vector<glm::ivec2> corners;
  for (bool early : {true, false})
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) {
        if (((x + y) % 4 == 0) != early) continue;
        // The additive recurrence of the plastic number, which fills a square evenly.
        const double n = x + double(y) * grid.x;
        const glm::dvec2 chance = glm::fract(n * glm::dvec2(0.7548776662466927, 0.5698402909980532));
        const glm::ivec2 begin = glm::ivec2(x, y) * size / grid, end = glm::ivec2(x + 1, y + 1) * size / grid;
        corners.push_back(begin + glm::ivec2(chance * glm::dvec2(end - begin - (tile - 1))));
      }
  return corners;
}

class Pilot {
 public:
  Pilot(const Plan& plan, RenderCaches& caches, RenderStats& stats, const CancelToken& cancel)
      : plan_(plan),
        caches_(caches),
        stats_(stats),
        cancel_(cancel),
        size_((plan.options.size + (pixelsApart - 1)) / pixelsApart),
        tiles_(tilesOf(size_)) {}

  Result<Plan> operator()() {
    auto fine = planOf(plan_.options.quality == Quality::high ? Quality::exact : Quality::high, {});
    if (!fine) return fine.error();
    fine_ = std::move(*fine);
    auto found = tried(plan_.pilotSteps->first);
    if (!found) return found.error();
    if (const auto step = betterStep(*found)) {
      const auto second = tried(*step);
      if (!second) return second.error();
      if (second->told.kept || !found->told.kept) found = second;
    }
    return makePlan(plan_.scene, caches_.facts(), plan_.options, found->told);
  }

 private:
  // `off`: the largest of its errors as a share of what is promised, or of what has to be kept for that.
  struct Found {
    PilotFinding told;
    double off = 0;
  };

  // What to try after that, if anything: errors grow with the square of the step, or faster where samples
  // that stand a simple share of a voxel apart meet every cell in the same places.
  std::optional<double> betterStep(const Found& found) const {
    constexpr double unit = 1.0 / 32;
    if (found.told.rays == 0) return {};
    const double tried = found.told.stepVoxels;
    const double wanted = std::min(1.0, tried * std::sqrt(0.85 / std::max(found.off, 1e-3)));
    const double step = std::floor(wanted / unit) * unit;
    if (found.told.kept) return step > 1.15 * tried ? std::optional(step) : std::nullopt;
    const double least = std::ceil(plan_.pilotSteps->shortest / unit) * unit;
    const bool canKeep = wanted >= 0.9 * least && least < tried;
    return canKeep ? std::optional(std::max(step, least)) : std::nullopt;
  }

  // The plan of the whole picture, but for the size of the one that the rays belong to.
  Result<Plan> planOf(Quality quality, const std::optional<PilotFinding>& finding) const {
    RenderOptions options = plan_.options;
    options.quality = quality;
    auto plan = makePlan(plan_.scene, caches_.facts(), options, finding);
    if (plan) plan->options.size = size_;
    return plan;
  }

  // What the rays tell of plain steps; a quarter of them where that tells already that they are of no use.
  Result<Found> tried(double step) {
    // As they would be drawn if they were found good enough.
    const auto plain = planOf(plan_.options.quality, PilotFinding{step, true});
    if (!plain) return plain.error();
    const double shorter = plan_.pilotSteps->shortest / step;
    const std::size_t all = tiles_.size(), early = all / 4;
    Picture picture;
    Found found;
    for (std::size_t count : {early, all}) {
      follow(fine_, truthTiles_, count, truth_);
      truthTiles_ = std::max(truthTiles_, count);
      follow(*plain, count == all ? early : 0, count, picture);
      if (cancel_.cancelled()) return Error{"cancelled"};
      found = finding(step, count, picture);
      if (found.off * shorter * shorter > 1.4) break;
    }
    return found;
  }

  // Draws the picture of a plan at the tiles [from, to), and nothing elsewhere.
  void follow(const Plan& plan, std::size_t from, std::size_t to, Picture& picture) const {
    if (from >= to) return;
    RenderStats stats;
    const PlanesFrame frame(plan, caches_, stats);
    stats_.gradientsMs += stats.gradientsMs;
    const RaySetup setup(plan, caches_.volume()->geometry());
    std::vector<float> error;
    const RowPainter painter(plan, frame, picture, error);
    const auto count = std::int64_t(to - from), tasks = (count + tilesATask - 1) / tilesATask;
    parallelFor(tasks, plan.options.threads, [&](std::int64_t first, std::int64_t last) {
      RayRow rays;
      RowPainter::Task task;
      for (std::int64_t n = first; n < last && !cancel_.cancelled(); ++n) {
        const auto begin = tiles_.begin() + std::ptrdiff_t(from);
        setup.makeTiles({begin + n * tilesATask, begin + std::min(count, (n + 1) * tilesATask)}, rays);
        painter.paint(rays, {}, task);
      }
    });
  }

  // Whether a pixel of any tile differs from the background by what could be seen.
  bool shows(const Picture& picture, std::size_t pixel) const {
    const Background& b = plan_.scene.background;
    const glm::vec4 empty = b.transparent ? glm::vec4(0) : glm::vec4(b.colour, 1);
    for (int c = 0; c < 4; ++c)
      if (std::abs(picture.rgba[4 * pixel + c] - empty[c]) > 0.5f / 255) return true;
    return false;
  }

  // Of the first `count` tiles.
  Found finding(double step, std::size_t count, const Picture& plain) const {
    std::vector<std::uint8_t> followed(plain.rgba.size() / 4), shown = followed;
    for (std::size_t n = 0; n < count; ++n) {
      const glm::ivec2 corner = tiles_[n];
      const glm::ivec2 end = glm::min(corner + RaySetup::tile, size_);
      for (int y = corner.y; y < end.y; ++y)
        for (int x = corner.x; x < end.x; ++x) {
          const auto pixel = std::size_t(y) * size_.x + x;
          followed[pixel] = 1;
          shown[pixel] = shows(plain, pixel) || shows(truth_, pixel);
        }
    }
    const int rays = int(std::count(shown.begin(), shown.end(), 1));
    if (rays == 0) return {{step}, 0};
    // What is promised of all pixels is kept by those alone that show anything.
    const PictureError e = compare(plain, truth_, shown);
    const LevelPromise promised = promiseOf(plan_.options.quality);
    const double mostRmse = 255 / std::pow(10, promised.leastPsnrDb / 20);
    // As if three rays more were twice as wrong as the worst: so much may have been missed.
    const double missed = 3 * std::pow(2 * e.maximum, 2) / rays;
    // A percentile of some thousand rays is known to a tenth.
    const double all99 = compare(plain, truth_, followed).percentile99 / 0.9;
    // Finer plain steps are off too, by the square of their length: the difference hides that share.
    const double finer = fine_.cellByCell ? 0 : fine_.stepVoxels / step;
    const double off = std::max(std::sqrt(e.rmse * e.rmse + missed) / mostRmse,
                                std::max(e.percentile99, all99) / promised.most99) /
                       (1 - finer * finer);
    return {{step, off <= 1, rays, e.psnrDb, e.percentile99}, off};
  }

  const Plan& plan_;
  RenderCaches& caches_;
  RenderStats& stats_;
  const CancelToken& cancel_;
  glm::ivec2 size_;  ///< of the picture that the tiles are of
  std::vector<glm::ivec2> tiles_;
  Plan fine_;                   ///< of the next finer level
  Picture truth_;               ///< by that
  std::size_t truthTiles_ = 0;  ///< the first of them that it holds
};

}  // namespace

Result<Plan> sendPilot(const Plan& plan, RenderCaches& caches, RenderStats& stats,
                       const CancelToken& cancel) {
  return Pilot(plan, caches, stats, cancel)();
}

}  // namespace volumen
