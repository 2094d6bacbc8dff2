#pragma once

#include <string>

#include "viewer/gl/caster.h"
#include "viewer/gl/gl_context.h"
#include "viewer/gl/plane_resampler.h"
#include "viewer/gl/slice_blender.h"
#include "viewer/gl/volume_textures.h"

namespace volumen {

/// All that a RenderCaches holds in OpenGL. What has names in it goes with the context.
struct GlState {
  std::unique_ptr<GlContext> context;
  std::string renderer;  ///< GL_RENDERER
  VolumeTextures textures;
  PlaneResampler resampler;
  Caster caster;
  SliceBlender blender;
};

/// Makes the context with the factory and looks at what it can do. An Error is a sentence with a way out.
Result<std::unique_ptr<GlState>> makeGlState(const GlContextFactory& factory);

}  // namespace volumen
