#pragma once

#include <functional>
#include <memory>

#include "viewer/acceleration/stored_voxels.h"
#include "viewer/render/render.h"

namespace volumen {

/// A picture and the plan it was drawn by.
struct Drawn {
  Picture picture;
  std::vector<float> error;  ///< Rendered::error
  Plan plan;
  RenderStats stats;
};

/// A plan that leaves nothing open, and what finding that took (completedPlan).
struct Planned {
  Plan plan;
  RenderStats stats;
};

/// Draws pictures of one volume; on the render thread only.
struct Draw {
  std::function<Result<Planned>(const Scene&, const RenderOptions&, const CancelToken&)> plan;
  std::function<Result<Drawn>(const Planned&, const CancelToken&)> picture;  ///< its times: of both
  std::function<std::size_t()> bytes{};  ///< of its own caches; empty: it has none

  /// Both at once.
  Result<Drawn> operator()(const Scene& scene, const RenderOptions& options, const CancelToken& cancel) const;
};

/// A volume as pictures read it; all that draw it share one.
using VoxelsPtr = std::shared_ptr<StoredVoxels>;
/// Makes what draws a volume, with caches of its own beside the voxels; called on the render thread.
using MakeDraw = std::function<Draw(const VoxelsPtr&)>;

/// makePlan(), completedPlan() and render() over one set of caches; OpenGL by a context of Qt's, else of
/// EGL's.
Draw drawWithCaches(const VoxelsPtr& voxels);

}  // namespace volumen
