#pragma once

#include <functional>
#include <memory>

#include "io/study/warning.h"
#include "viewer/acceleration/stored_voxels.h"
#include "viewer/render/render.h"

namespace volumen {

/// A picture and the plan it was drawn from.
struct Drawn {
  Picture picture;
  std::vector<float> error;  ///< Rendered::error
  Plan plan;
  RenderStats stats;
  std::vector<Warning> warnings{};  ///< of this picture, besides those of its series
};

/// A complete plan (completedPlan) and the statistics of its completion.
struct Planned {
  Plan plan;
  RenderStats stats;
  std::shared_ptr<RenderCaches> copy{};  ///< set if a reduced copy is drawn
};

/// Draws pictures of one volume; for the render thread only.
struct Draw {
  std::function<Result<Planned>(const Scene&, const RenderOptions&, const CancelToken&)> plan;
  std::function<Result<Drawn>(const Planned&, const CancelToken&)> picture;  ///< times include planning
  std::function<std::size_t()> bytes{};  ///< of its own caches; empty if it has none

  /// Plans and draws.
  Result<Drawn> operator()(const Scene& scene, const RenderOptions& options, const CancelToken& cancel) const;
};

/// A volume in the form that rendering reads; all views of it share one.
using VoxelsPtr = std::shared_ptr<StoredVoxels>;
/// Makes the functions that draw a volume, with their own caches beside the voxels. Called on the render
/// thread.
using MakeDraw = std::function<Draw(const VoxelsPtr&)>;

/// Returns makePlan(), completedPlan() and render() over one set of caches. OpenGL uses a context from Qt,
/// else from EGL. If there is too little memory, pictures are drawn of a reduced copy and say so
/// (copyToDraw).
Draw drawWithCaches(const VoxelsPtr& voxels);

}  // namespace volumen
