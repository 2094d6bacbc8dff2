#pragma once

#include <string>

#include "viewer/gl/caster.h"
#include "viewer/gl/gl_context.h"
#include "viewer/gl/plane_resampler.h"
#include "viewer/gl/slice_blender.h"
#include "viewer/gl/volume_textures.h"

namespace volumen {

/// All OpenGL objects of a RenderCaches. Their names end with the context.
struct GlState {
  std::unique_ptr<GlContext> context;
  std::string renderer;  ///< Value of GL_RENDERER.
  VolumeTextures textures;
  PlaneResampler resampler;
  Caster caster;
  SliceBlender blender;
};

/// Makes the context with the factory and checks its capabilities. An Error is a sentence with a workaround.
Result<std::unique_ptr<GlState>> makeGlState(const GlContextFactory& factory);

}  // namespace volumen
