#pragma once

#include <memory>

#include "viewer/gl/gl_context.h"
#include "viewer/plan/facts.h"
#include "viewer/volume/volume.h"

namespace volumen {

class StoredVoxels;

/// What is expensive and reusable of one volume, made when first needed: facts, stored density, gradients, GL
/// textures. Each is keyed by exactly what it was computed from. Not for use from two threads at once; nor
/// are several of them that share their voxels.
class RenderCaches {
 public:
  explicit RenderCaches(VolumePtr volume);
  /// Facts, densities and gradients are those of `voxels`; all else is of these caches alone.
  explicit RenderCaches(std::shared_ptr<StoredVoxels> voxels);
  ~RenderCaches();
  RenderCaches(RenderCaches&&) noexcept;
  RenderCaches& operator=(RenderCaches&&) noexcept;

  const VolumePtr& volume() const;
  const VolumeFacts& facts();

  /// Where the OpenGL context comes from when a plan first asks for one: on the thread that renders, on which
  /// these caches must then also be destroyed. The default is EGL's, without a display. Drops a context that
  /// is there.
  void setGlContextFactory(GlContextFactory factory);

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace volumen
