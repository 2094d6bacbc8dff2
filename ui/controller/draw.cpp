#include "ui/controller/draw.h"

#include <algorithm>
#include <new>
#include <set>
#include <tuple>

#include "results/pictures/reduced_copy.h"
#include "ui/controller/qt_gl_context.h"
#include "viewer/render/memory_need.h"
#include "viewer/volume/available_memory.h"

namespace volumen {

namespace {

using CachesPtr = std::shared_ptr<RenderCaches>;

CachesPtr cachesOf(const VoxelsPtr& voxels) {
  auto caches = std::make_shared<RenderCaches>(voxels);
  caches->setGlContextFactory([] {
    auto context = makeQtGlContext();
    return context ? std::move(context) : makeEglContext();
  });
  return caches;
}

// Draws a volume, or a reduced copy of it if there is too little memory.
class Source {
 public:
  explicit Source(const VoxelsPtr& voxels) : voxels_(voxels), whole_(cachesOf(voxels)) {
    try {
      whole_->facts();  // here, so that it does not count as time of the first frame
    } catch (const std::bad_alloc&) {
      // The first plan tells of it.
    }
  }

  Result<Planned> plan(const Scene& scene, const RenderOptions& options, const CancelToken& cancel) try {
    Result<Plan> asked = makePlan(scene, whole_->facts(), options);
    if (!asked) return asked.error();
    if (Status chosen = choose(*asked); !chosen) return chosen.error();
    if (copy_) asked = makePlan(asked->scene, copy_->facts(), options);
    if (!asked) return asked.error();
    RenderStats stats;
    Result<Plan> done = completedPlan(*asked, copy_ ? *copy_ : *whole_, stats, cancel);
    if (!done) return done.error();
    return Planned{std::move(*done), stats, copy_};
  } catch (const std::bad_alloc&) {
    return Error{"There is not enough memory to draw this volume; close other programs or series."};
  }

  Result<Drawn> picture(const Planned& planned, const CancelToken& cancel) {
    Result<Rendered> rendered = render(planned.plan, planned.copy ? *planned.copy : *whole_, cancel);
    if (!rendered) return rendered.error();
    if (!planned.copy) drawnWhole_.insert(kindOf(planned.plan));
    RenderStats stats = rendered->stats;
    stats.pilotMs += planned.stats.pilotMs;
    stats.gradientsMs += planned.stats.gradientsMs;
    stats.totalMs += planned.stats.pilotMs + planned.stats.gradientsMs;
    return Drawn{std::move(rendered->picture), std::move(rendered->error), std::move(rendered->plan), stats,
                 planned.copy ? std::vector{warning_} : std::vector<Warning>()};
  }

  // Returns the bytes kept besides the voxels of the volume.
  std::size_t bytes() const {
    return whole_->bytes() + (copy_ ? copy_->bytes() + copyVoxels_->bytes() + copy_->volume()->bytes() : 0);
  }

 private:
  // Returns what determines the data that a plan keeps of the volume.
  static std::tuple<int, bool, Resampler> kindOf(const Plan& plan) {
    return {plan.bits, plan.gradients, plan.resampler};
  }

  // Sets copy_, or resets it if the volume itself can be drawn.
  Status choose(const Plan& plan) {
    if (hasRoomFor(plan)) {
      copy_.reset(), copyVoxels_.reset();
      return {};
    }
    if (copy_) return {};
    const Volume& volume = *whole_->volume();
    const auto copy = copyToDraw(plan, volume, whole_->facts(), volume.attributes().name);
    if (!copy) return copy.error();
    if (!*copy) return {};
    copyVoxels_ = std::make_shared<StoredVoxels>((*copy)->volume);
    copy_ = cachesOf(copyVoxels_);
    warning_ = (*copy)->warning;
    return {};
  }

  // Returns whether all gradients fit, or else those of visible bricks, which each new curve computes again.
  bool hasRoomFor(const Plan& plan) {
    const Volume& volume = *whole_->volume();
    const bool isThere = plan.method == Method::reference || drawnWhole_.contains(kindOf(plan));
    if (isThere && !voxels_->sparesGradients()) return true;
    const bool all = !isThere && voxels_->hasRoomFor(bytesToDraw(plan, volume.geometry(), volume.stored()));
    voxels_->spareGradients(!all);
    if (all) return true;
    const std::uint64_t needed = leastBytesToDraw(plan, volume, whole_->facts());
    return voxels_->hasRoomFor(needed - std::min<std::uint64_t>(needed, voxels_->brickBytes()));
  }

  const VoxelsPtr voxels_;
  VoxelsPtr copyVoxels_;
  CachesPtr whole_, copy_;
  Warning warning_{{}, WarningKind::reduced};
  std::set<std::tuple<int, bool, Resampler>> drawnWhole_;  // kinds whose data exist
};

}  // namespace

Result<Drawn> Draw::operator()(const Scene& scene, const RenderOptions& options,
                               const CancelToken& cancel) const {
  const Result<Planned> planned = plan(scene, options, cancel);
  if (!planned) return planned.error();
  return picture(*planned, cancel);
}

Draw drawWithCaches(const VoxelsPtr& voxels) {
  auto source = std::make_shared<Source>(voxels);
  return {[source](const Scene& scene, const RenderOptions& options, const CancelToken& cancel) {
            return source->plan(scene, options, cancel);
          },
          [source](const Planned& planned, const CancelToken& cancel) {
            return source->picture(planned, cancel);
          },
          [source] { return source->bytes(); }};
}

}  // namespace volumen
