#include "viewer/render/gl/slice_blender.h"

#include <epoxy/gl.h>

#include <limits>

#include "viewer/render/gl/shader_texts.h"

namespace volumen {

namespace {

enum Unit { densityUnit, gradientUnit, rayUnit, sliceUnit };

Error noRoom() { return Error{"OpenGL has no room for slices of the picture; use --resampler cpu."}; }

void bind(Unit unit, GLenum kind, GLuint texture) {
  glActiveTexture(GLenum(GL_TEXTURE0 + unit));
  glBindTexture(kind, texture);
}

}  // namespace

Status SliceBlender::prepare(const Plan& plan, glm::ivec3 size, const VolumeTextures& textures) {
  if (!blendProgram_) {
    const auto made = makeProgram("", shaders::picture_vert, {shaders::blend_frag});
    if (!made) return made.error();
    blendProgram_ = *made;
    glGenVertexArrays(1, &vertices_);
  }
  const std::string defines = std::string(plan.bits == 32 ? "#define SHADER_FILTER\n" : "") +
                              (plan.gradients ? "#define GRADIENTS\n" : "");
  unsigned& program = programs_[defines];
  if (!program) {
    const auto made = makeProgram(defines, shaders::picture_vert,
                                  {shaders::sample_glsl, shaders::ray_glsl, shaders::slice_frag});
    if (!made) return made.error();
    program = *made;
  }
  sliceProgram_ = program;
  mode_ = plan.scene.mode;
  blending_ = mode_ == Mode::composite ? plan.blending : Blending::floats;
  density_ = textures.density();
  gradients_ = plan.gradients ? textures.gradients() : 0;
  glUseProgram(program);
  const auto uniform = [&](const char* name) { return glGetUniformLocation(program, name); };
  glUniform1i(uniform("density"), densityUnit);
  glUniform1i(uniform("gradient"), gradientUnit);
  glUniform1i(uniform("rays"), rayUnit);
  glUniform3i(uniform("size"), size.x, size.y, size.z);
  glUniform1f(uniform("smallest"), float(textures.smallest()));
  glUniform1f(uniform("rounding"), textures.rounding());
  glUseProgram(blendProgram_);
  glUniform1i(glGetUniformLocation(blendProgram_, "shaded"), sliceUnit);
  return {};
}

unsigned SliceBlender::makeTexture(unsigned format) const {
  GLuint name = 0;
  glGenTextures(1, &name);
  bind(sliceUnit, GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), width_, height_, 0, GL_RGBA, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  return name;
}

Status SliceBlender::makeSlot(Slot& slot) {
  slot.density = makeTexture(GL_R32F);
  if (gradients_) slot.gradients = makeTexture(GL_RGBA32F);
  glGenFramebuffers(1, &slot.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, slot.framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, slot.density, 0);
  if (gradients_)
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, slot.gradients, 0);
  const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(gradients_ ? 2 : 1, both);
  glGenBuffers(1, &slot.buffer);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, slot.buffer);
  glBufferData(GL_PIXEL_PACK_BUFFER, GLsizeiptr(pixelCount() * (gradients_ ? 5 : 1) * sizeof(float)), nullptr,
               GL_STREAM_READ);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  return complete && glGetError() == GL_NO_ERROR ? Status() : noRoom();
}

Status SliceBlender::makeFrame() {
  const GLenum format = blending_ == Blending::floats   ? GL_RGBA32F
                        : blending_ == Blending::bits16 ? GL_RGBA16
                                                        : GL_RGBA8;
  frameTexture_ = makeTexture(format);
  shaded_ = makeTexture(GL_RGBA32F);
  glGenFramebuffers(1, &frame_);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, frameTexture_, 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || glGetError() != GL_NO_ERROR)
    return noRoom();
  const float most = std::numeric_limits<float>::max();
  const float empty = mode_ == Mode::mip ? -most : mode_ == Mode::minip ? most : 0;
  glClearColor(empty, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  return {};
}

void SliceBlender::freeTargets() {
  for (Slot& slot : slots_) {
    glDeleteFramebuffers(1, &slot.framebuffer);
    glDeleteTextures(1, &slot.density);
    glDeleteTextures(1, &slot.gradients);
    glDeleteBuffers(1, &slot.buffer);
    slot = {};
  }
  glDeleteFramebuffers(1, &frame_);
  glDeleteTextures(1, &frameTexture_);
  glDeleteTextures(1, &shaded_);
}

Status SliceBlender::begin(const RayBand& band, float inverseUnitMm) {
  while (glGetError() != GL_NO_ERROR) {
  }
  freeTargets();
  width_ = band.stride;
  height_ = int(band.rows.size());
  if (Status s = uploadRays(band, inverseUnitMm, rays_); !s) return s;
  for (Slot& slot : slots_)
    if (Status s = makeSlot(slot); !s) return s;
  if (Status s = makeFrame(); !s) return s;
  glBindVertexArray(vertices_);
  glViewport(0, 0, width_, height_);
  bind(densityUnit, GL_TEXTURE_3D, density_);
  bind(gradientUnit, GL_TEXTURE_3D, gradients_);
  rays_.bind(rayUnit);
  bind(sliceUnit, GL_TEXTURE_2D, shaded_);
  glUseProgram(sliceProgram_);
  glUniform1i(glGetUniformLocation(sliceProgram_, "width"), width_);
  return {};
}

void SliceBlender::drawSlice(int n, int slot) {
  glDisable(GL_BLEND);
  glUseProgram(sliceProgram_);
  glUniform1i(glGetUniformLocation(sliceProgram_, "slice"), n);
  glBindFramebuffer(GL_FRAMEBUFFER, slots_[slot].framebuffer);
  timer_.begin(slot);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  timer_.end();
  glBindBuffer(GL_PIXEL_PACK_BUFFER, slots_[slot].buffer);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, width_, height_, GL_RED, GL_FLOAT, nullptr);
  if (gradients_) {
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT,
                 reinterpret_cast<void*>(pixelCount() * sizeof(float)));
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glFlush();
}

SliceBlender::Samples SliceBlender::map(int slot) {
  glBindBuffer(GL_PIXEL_PACK_BUFFER, slots_[slot].buffer);
  const auto* data = static_cast<const float*>(
      glMapBufferRange(GL_PIXEL_PACK_BUFFER, 0,
                       GLsizeiptr(pixelCount() * (gradients_ ? 5 : 1) * sizeof(float)), GL_MAP_READ_BIT));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  if (!data || glGetError() != GL_NO_ERROR) return {};
  glMs_ += timer_.ms(slot);
  return {data, gradients_ ? data + pixelCount() : nullptr};
}

void SliceBlender::unmap(int slot) {
  glBindBuffer(GL_PIXEL_PACK_BUFFER, slots_[slot].buffer);
  glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
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
  bind(sliceUnit, GL_TEXTURE_2D, shaded_);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_FLOAT, rgba);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glUseProgram(blendProgram_);
  useBlending();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

const std::vector<float>& SliceBlender::pixels() {
  glDisable(GL_BLEND);
  pixels_.resize(4 * pixelCount());
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, pixels_.data());
  if (glGetError() != GL_NO_ERROR) pixels_.clear();
  return pixels_;
}

}  // namespace volumen
