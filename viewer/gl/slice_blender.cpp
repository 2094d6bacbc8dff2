#include "viewer/gl/slice_blender.h"

#include <epoxy/gl.h>

#include <limits>

#include "viewer/gl/shader_texts.h"

namespace volumen {

namespace {

enum SliceUnit { sliceRayUnit = VolumeTextures::freeUnit, sliceUnit };

}  // namespace

Status SliceBlender::prepare(const Plan& plan, const VolumeTextures& textures) {
  const auto blend = blendPrograms_.of("", shaders::picture_vert, {shaders::blend_frag});
  if (!blend) return blend.error();
  blendProgram_ = *blend;
  const auto slice = slicePrograms_.of(VolumeTextures::defines(plan), shaders::picture_vert,
                                       {shaders::sample_glsl, shaders::ray_glsl, shaders::slice_frag});
  if (!slice) return slice.error();
  sliceProgram_ = *slice;
  if (!vertices_) glGenVertexArrays(1, &vertices_);
  mode_ = plan.scene.mode;
  blending_ = mode_ == Mode::composite ? plan.blending : Blending::floats;
  gradients_ = plan.gradients;
  textures.use(sliceProgram_, plan);
  glUniform1i(glGetUniformLocation(sliceProgram_, "rays"), sliceRayUnit);
  glUseProgram(blendProgram_);
  glUniform1i(glGetUniformLocation(blendProgram_, "shaded"), sliceUnit);
  glBindVertexArray(vertices_);
  return {};
}

bool SliceBlender::makeTargets() {
  for (SampleTarget& slot : slots_) slot.free();
  glDeleteTextures(1, &shaded_);
  for (SampleTarget& slot : slots_)
    if (!slot.make(size_, gradients_)) return false;
  const GLenum format = blending_ == Blending::floats   ? GL_RGBA32F
                        : blending_ == Blending::bits16 ? GL_RGBA16
                                                        : GL_RGBA8;
  if (!frame_.make(format, size_)) return false;
  shaded_ = makePlainTexture(GL_RGBA32F, size_);
  return glGetError() == GL_NO_ERROR;
}

void SliceBlender::clearFrame() const {
  const float most = std::numeric_limits<float>::max();
  const float empty = mode_ == Mode::mip ? -most : mode_ == Mode::minip ? most : 0;
  frame_.use();
  glClearColor(empty, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
}

Status SliceBlender::begin(const RayBand& band, float inverseUnitMm) {
  size_ = {band.stride, int(band.rows.size())};
  if (!makeTargets()) return Error{"OpenGL has no room for slices of the picture; use --resampler cpu."};
  clearFrame();
  if (Status s = uploadRays(band, inverseUnitMm, rays_); !s) return s;
  rays_.bind(sliceRayUnit);
  glUseProgram(sliceProgram_);
  glUniform1i(glGetUniformLocation(sliceProgram_, "width"), size_.x);
  return {};
}

void SliceBlender::drawSlice(int n, int slot) {
  glUseProgram(sliceProgram_);
  glUniform1i(glGetUniformLocation(sliceProgram_, "slice"), n);
  slots_[slot].use();
  timer_.begin(slot);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  timer_.end();
  slots_[slot].startReading(size_.y);
}

SampleTarget::Samples SliceBlender::map(int slot) {
  const SampleTarget::Samples samples = slots_[slot].map();
  if (samples.density) glMs_ += timer_.ms(slot);
  return samples;
}

void SliceBlender::useBlending() const {
  glEnable(GL_BLEND);
  switch (mode_) {
    case Mode::composite:
      glBlendEquation(GL_FUNC_ADD);
      glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
      break;
    case Mode::mip:
      glBlendEquation(GL_MAX);
      break;
    case Mode::minip:
      glBlendEquation(GL_MIN);
      break;
    case Mode::average:
      glBlendEquation(GL_FUNC_ADD);
      glBlendFunc(GL_ONE, GL_ONE);
      break;
  }
}

void SliceBlender::blend(const float* rgba) {
  bindTexture(sliceUnit, GL_TEXTURE_2D, shaded_);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT, rgba);
  frame_.use();
  glUseProgram(blendProgram_);
  useBlending();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
}

}  // namespace volumen
