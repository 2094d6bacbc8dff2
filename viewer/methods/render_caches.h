#pragma once

#include <memory>

#include "viewer/gl/gl_context.h"
#include "viewer/plan/facts.h"
#include "viewer/volume/volume.h"

namespace volumen {

class StoredVoxels;

/// The expensive, reusable data of one volume, each made on first use: facts, stored density, gradients, GL
/// textures. Each is keyed by exactly what it was computed from. Not thread-safe, and neither are several
/// caches that share their voxels.
class RenderCaches {
 public:
  explicit RenderCaches(VolumePtr volume);
  /// Shares the facts, densities and gradients of `voxels`; all other data belong to these caches alone.
  explicit RenderCaches(std::shared_ptr<StoredVoxels> voxels);
  ~RenderCaches();
  RenderCaches(RenderCaches&&) noexcept;
  RenderCaches& operator=(RenderCaches&&) noexcept;

  const VolumePtr& volume() const;
  const VolumeFacts& facts();
  /// Returns the bytes of the data that only these caches hold.
  std::size_t bytes() const;

  /// Sets the source of the OpenGL context, which is made when a plan first needs one. That happens on the
  /// rendering thread, on which these caches must then also be destroyed. The default is EGL without a
  /// display. Drops an existing context.
  void setGlContextFactory(GlContextFactory factory);

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace volumen
