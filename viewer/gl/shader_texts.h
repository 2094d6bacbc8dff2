#pragma once

/// The files of resources/shaders, compiled in without their #version lines.
namespace volumen::shaders {

extern const char* const planes_vert;
extern const char* const planes_frag;
extern const char* const picture_vert;
extern const char* const sample_glsl;
extern const char* const ray_glsl;
extern const char* const shade_glsl;
extern const char* const slice_frag;
extern const char* const blend_frag;
extern const char* const cast_frag;

}  // namespace volumen::shaders
