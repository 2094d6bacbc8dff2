#include "viewer/render/pilot.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "viewer/kernels/ray_generator.h"
#include "viewer/methods/row_painter.h"
#include "viewer/plan/resonance.h"
#include "viewer/render/block_errors.h"
#include "viewer/render/pilot_errors.h"
#include "viewer/render/pilot_tiles.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Distance of a pilot's rays in pixels: near enough to share blocks and memory, far enough to differ. It is
// no integer, since rays could otherwise all hit a pattern of pixels at the same place.
constexpr double pixelsApart = 4.236;
constexpr int tilesATask = 8;
constexpr std::size_t leastPart = 96;  // half as many missed most wrong pixels of one picture in 1,127

// Limit of further tries with shorter steps after a failure. (After a success longer steps are tried once.)
// Going cell by cell would take longer than the last try.
constexpr int mostFurtherTries = 2;
constexpr double shorter = 0.99;  // factor that excludes the same step

// Factor between the largest relative error of the pilot's rays and the one that is told for all: a sample of
// some hundred rays does not hold the worst of a thousand.
constexpr double errorMargin = 1.5;

// Largest fraction of rays to redo. If more rays exceed the limit, too many wrong rays stay below it.
constexpr double mostRedone = 0.01;

// The second step that is tried for a draft, voxels.
constexpr double shorterInDrafts = 0.4393;

// Largest RMSE of what a draft shows, 1/255: above it surfaces look grained like wood. It is no promise.
constexpr double mostGrain = 3.2;

// If a part of the tiles decides, its errors may reach this share of the promise.
constexpr double mostOfPart = 0.9;

// Error budget of the fine rays as a fraction of the level's promise for 99 % of pixels. It costs little and
// is added to the measured error.
constexpr double shareOfTruth = 1.0 / 32;

glm::ivec2 sizeOfPilot(glm::ivec2 size) { return glm::ivec2(glm::ceil(glm::dvec2(size) / pixelsApart)); }

class Pilot {
 public:
  Pilot(const Plan& plan, RenderCaches& caches, RenderStats& stats, const CancelToken& cancel)
      : plan_(plan),
        caches_(caches),
        stats_(stats),
        cancel_(cancel),
        size_(sizeOfPilot(plan.options.size)),
        tiles_(pilotTiles(plan, caches.facts(), size_)) {}

  Result<PilotFinding> operator()() {
    RenderOptions finer = plan_.options;
    finer.stopAt = std::min(plan_.stopTransmittance, shareOfTruth / 255);
    finer.tolerance = errorOfTruth() / 255;
    auto fine = planOf(finer, {});
    if (!fine) return fine.error();
    fine_ = std::move(*fine);
    if (plan_.options.quality == Quality::draft) return ofDraft();
    // A part of the tiles is enough where the errors leave room for what it may have missed.
    const std::size_t all = tiles_.size(), few = all / 4 >= leastPart ? all / 4 : half();
    auto found = tried(stepUpTo(plan_.pilotSteps->first, 0).value_or(plan_.pilotSteps->first), few);
    for (int more = 0; found && more < mostFurtherTries; ++more) {
      const auto step = betterStep(*found, found->off, shorter);
      if (!step) break;
      const bool wasKept = found->told.kept;
      const auto next = tried(*step, few);
      if (!next || next->told.kept || !wasKept) found = next;
      if (wasKept || !next || next->told.kept) break;
    }
    if (!found) return found.error();
    if (found->told.kept) return found->told;
    // Two to four times as many tiles leave less that may have been missed.
    const auto step = found->told.rays == 0 ? found->told.stepVoxels
                                            : betterStep(*found, (found->off + found->likely) / 2, 1);
    if (!step) return found->told;
    found = tried(*step, all);
    if (!found) return found.error();
    return found->told;
  }

 private:
  // Returns the number of half of the tiles, or of all if they are few.
  std::size_t half() const { return std::max(std::min(tiles_.size(), leastPart), tiles_.size() / 2); }

  // Returns the error budget of the fine rays, 1/255.
  double errorOfTruth() const {
    const Quality quality = plan_.options.quality;
    if (quality == Quality::draft) return levelOf(Quality::standard).rayBudget;
    return promiseOf(quality).most99 * shareOfTruth;
  }

  // Lets a draft take plain steps if the means over blocks of pixels keep its promise. A tile of rays covers
  // about one block.
  Result<PilotFinding> ofDraft() {
    const std::size_t count = half();
    PilotFinding told;
    for (const double most : {plan_.pilotSteps->first, shorterInDrafts}) {
      const auto step = stepUpTo(most, std::min(most, plan_.pilotSteps->shortest));
      if (!step || (told.rays > 0 && *step == told.stepVoxels)) continue;
      const auto tried = drawn(*step, count);
      if (!tried) return tried.error();
      followTruth(count);
      if (cancel_.cancelled()) return Error{"cancelled"};
      told = tried->asIf;
      BlockErrors errors(componentsThatDiffer(plan_.scene.background.transparent));
      for (std::size_t n = 0; n < count; ++n) {
        errors.beginBlock(chanceOf(n, count));
        forEachPixel(tiles_[n], [&](std::size_t pixel) {
          glm::dvec4 off;
          for (int c = 0; c < 4; ++c)
            off[c] = 255 * (double(tried->picture.rgba[4 * pixel + c]) - finePicture_.rgba[4 * pixel + c]);
          errors.add(off, shows(tried->picture, pixel) || shows(finePicture_, pixel));
        });
      }
      const BlockErrors::Bounds worst = errors.worst();
      told.rays = errors.shown();
      told.blockRmse = worst.rmse;
      told.meanColour = worst.meanColour;
      told.kept = told.rays > 0 && worst.rmse <= mostOfPart * draftPromise.mostRmse &&
                  worst.meanColour <= mostOfPart * draftPromise.mostMeanColour &&
                  worst.rmseOfShown <= mostGrain;
      if (told.kept || told.rays == 0) break;
    }
    return told;
  }

  // `off` is the largest error relative to its promise; `likely` is the same without allowance for missed
  // pixels.
  struct Found {
    PilotFinding told;
    double off = 0, likely = 0;
  };

  // A picture drawn by plain steps as if they were kept, and how far every other step alone is from each
  // pixel.
  struct Tried {
    PilotFinding asIf;
    Picture picture;
    std::vector<float> nested;  ///< 1/255; about 0 if no ray can be redone
  };

  // Returns the longest step from `least` to `most` that may be tried for this camera.
  std::optional<double> stepUpTo(double most, double least) const {
    return evenlySpreadStep(alongVoxelOf(*plan_.scene.camera, caches_.volume()->geometry()), most, least);
  }

  // Returns the next step to try, if any, for errors that are `off`: they grow with the square of the step.
  // After a failure it is at most `longest` times the last.
  std::optional<double> betterStep(const Found& found, double off, double longest) const {
    if (found.told.rays == 0) return {};
    const double tried = found.told.stepVoxels;
    const double wanted = tried * std::sqrt(0.85 / std::max(off, 1e-3));
    if (found.told.kept) return stepUpTo(wanted, 1.1 * tried);
    const double least = plan_.pilotSteps->shortest;
    if (wanted < 0.9 * least) return {};
    return stepUpTo(std::min(std::max(wanted, 1.1 * least), longest * tried), least);
  }

  // Returns the plan of the whole picture at the size of the pilot's picture.
  Result<Plan> planOf(const RenderOptions& options, const std::optional<PilotFinding>& finding) const {
    auto plan = makePlan(plan_.scene, caches_.facts(), options, finding);
    if (plan) plan->options.size = size_;
    return plan;
  }

  // Draws the first `count` tiles by plain steps.
  Result<Tried> drawn(double step, std::size_t count) const {
    // Planned as if the pilot had accepted them.
    PilotFinding accepted{step, true};
    accepted.redoneAbove = plan_.pilotSteps->redoneAbove;
    const auto plain = planOf(plan_.options, accepted);
    if (!plain) return plain.error();
    Tried tried{accepted, {}, {}};
    tried.nested = follow(*plain, 0, count, tried.picture);
    if (cancel_.cancelled()) return Error{"cancelled"};
    return tried;
  }

  // Tries plain steps at the first `count` tiles.
  Result<Found> tried(double step, std::size_t count) {
    const auto steps = drawn(step, count);
    if (!steps) return steps.error();
    followTruth(count);
    if (cancel_.cancelled()) return Error{"cancelled"};
    return finding(count, *steps);
  }

  // Draws the fine picture at the first `count` tiles, with its own error.
  void followTruth(std::size_t count) {
    const std::vector<float> error = follow(fine_, fineTiles_, count, finePicture_);
    fineTiles_ = std::max(fineTiles_, count);
    truthError_.resize(std::size_t(size_.x) * size_.y);
    for (std::size_t n = 0; n < error.size(); ++n) truthError_[n] = std::max(truthError_[n], error[n]);
  }

  // Draws a plan at the tiles [from, to) only. Returns the possible error of its pixels.
  std::vector<float> follow(const Plan& plan, std::size_t from, std::size_t to, Picture& picture) const {
    if (from >= to) return {};
    RenderStats stats;
    const RenderInputs inputs(plan, caches_, stats);
    stats_.gradientsMs += stats.gradientsMs;
    const RayGenerator setup(plan, caches_.volume()->geometry());
    std::vector<float> error;
    const RowPainter painter(plan, inputs, picture, error);
    const auto count = std::int64_t(to - from), tasks = (count + tilesATask - 1) / tilesATask;
    parallelFor(tasks, plan.options.threads, [&](std::int64_t first, std::int64_t last) {
      RayRow rays;
      RowPainter::Task task;
      for (std::int64_t n = first; n < last && !cancel_.cancelled(); ++n) {
        std::vector<glm::ivec2> corners;
        for (std::int64_t k = n * tilesATask; k < std::min(count, (n + 1) * tilesATask); ++k)
          corners.push_back(tiles_[from + std::size_t(k)].corner);
        setup.makeTiles(corners, rays);
        painter.paint(rays, {}, task);
      }
    });
    return error;
  }

  // Returns the probability with which a tile is among the first `count`.
  double chanceOf(std::size_t n, std::size_t count) const {
    return tiles_[n].chance * double(count) / double(tiles_.size());
  }

  template <class Visit>
  void forEachPixel(const PilotTile& tile, const Visit& visit) const {
    const glm::ivec2 end = glm::min(tile.corner + RayGenerator::tile, size_);
    for (int y = tile.corner.y; y < end.y; ++y)
      for (int x = tile.corner.x; x < end.x; ++x) visit(std::size_t(y) * size_.x + x);
  }

  // Returns whether a pixel of a tile visibly differs from the background.
  bool shows(const Picture& picture, std::size_t pixel) const {
    const Background& b = plan_.scene.background;
    const glm::vec4 empty = b.transparent ? glm::vec4(0) : glm::vec4(b.colour, 1);
    for (int c = 0; c < 4; ++c)
      if (std::abs(picture.rgba[4 * pixel + c] - empty[c]) > 0.5f / 255) return true;
    return false;
  }

  // Error of plain steps at a pixel: `largest` component in 1/255, and the mean of all squares. The possible
  // error of the fine picture is added in the worse direction. The few rays that are redone count as right.
  struct PixelError {
    double largest = 0, square = 0;
  };
  PixelError errorAt(std::size_t pixel, const Tried& tried) const {
    PixelError e;
    const bool isRedone = this->isRedone(pixel, tried);
    for (std::size_t n = 4 * pixel; n < 4 * pixel + 4; ++n) {
      const double apart =
          isRedone ? 0 : 255 * std::abs(double(tried.picture.rgba[n]) - double(finePicture_.rgba[n]));
      const bool isSure = n % 4 == 3 && !plan_.scene.background.transparent;
      const double off = isSure ? apart : apart + truthError_[pixel];
      e.largest = std::max(e.largest, off);
      e.square += off * off / componentsThatDiffer(plan_.scene.background.transparent);
    }
    return e;
  }

  // Returns what PilotFinding::errorScale is relative to, 1/255.
  static double changeFromTwice(std::size_t pixel, const Tried& tried) {
    return PilotFinding::leastChange + tried.nested[pixel];
  }
  static bool isRedone(std::size_t pixel, const Tried& tried) {
    return tried.asIf.redoneAbove > 0 && tried.nested[pixel] > 255 * tried.asIf.redoneAbove;
  }

  // Evaluates the first `count` tiles.
  Found finding(std::size_t count, const Tried& tried) const {
    PilotErrors errors;
    double redone = 0, shown = 0, errorScale = 0;
    for (std::size_t n = 0; n < count; ++n) {
      errors.beginTile(chanceOf(n, count));
      forEachPixel(tiles_[n], [&](std::size_t pixel) {
        // Promises for all pixels hold if those showing anything keep them.
        if (!shows(tried.picture, pixel) && !shows(finePicture_, pixel)) return;
        const PixelError e = errorAt(pixel, tried);
        errors.add(e.largest, e.square);
        shown += 1 / chanceOf(n, count);
        if (isRedone(pixel, tried))
          redone += 1 / chanceOf(n, count);
        else
          errorScale = std::max(errorScale, e.largest / changeFromTwice(pixel, tried));
      });
    }
    const double step = tried.asIf.stepVoxels;
    if (errors.rays() == 0) return {{step}};
    const LevelPromise& promised = promiseOf(plan_.options.quality);
    // Rays that are far off are mostly redone.
    const bool redoes = tried.asIf.redoneAbove > 0, isPart = count < tiles_.size();
    const PilotErrors::Missed missed{redoes ? 1.0 : 2.0, promised.most99 / (redoes ? 6 : 20),
                                     isPart ? 3.0 : 2.0};
    const PilotErrors::Bounds likely = errors.likely(), worst = errors.worst(missed);
    const double promisedRmse = 255 * std::pow(10, -promised.leastPsnrDb / 20);
    const auto offOf = [&](const PilotErrors::Bounds& b) {
      return std::max(b.rmse / promisedRmse, b.percentile99 / promised.most99);
    };
    const double redoneShare = redone / shown;
    const double off = std::max(offOf(worst), std::min(redoneShare / mostRedone, 2.0));
    const bool kept = off <= (isPart ? mostOfPart : 1);
    // A part of the tiles tells of the promise alone, as it may have missed a small piece with larger errors.
    const PilotErrors::Bounds told =
        kept && isPart ? PilotErrors::Bounds{promisedRmse, promised.most99} : worst;
    return {{step, kept, errors.rays(), 20 * std::log10(255 / std::max(told.rmse, 1e-3)), told.percentile99,
             tried.asIf.redoneAbove, redoneShare, errorMargin * errorScale},
            off,
            offOf(likely)};
  }

  const Plan& plan_;
  RenderCaches& caches_;
  RenderStats& stats_;
  const CancelToken& cancel_;
  glm::ivec2 size_;  ///< Size of the pilot's picture
  std::vector<PilotTile> tiles_;
  Plan fine_;            ///< Cell by cell, finer than the level
  Picture finePicture_;  ///< Drawn by fine_
  std::vector<float> truthError_;
  std::size_t fineTiles_ = 0;  ///< Number of tiles it holds
};

}  // namespace

Result<PilotFinding> probe(const Plan& plan, RenderCaches& caches, RenderStats& stats,
                           const CancelToken& cancel) {
  return Pilot(plan, caches, stats, cancel)();
}

}  // namespace volumen
