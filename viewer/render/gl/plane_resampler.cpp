#include "viewer/render/gl/plane_resampler.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

#include "viewer/render/gl/program.h"
#include "viewer/render/gl/shader_texts.h"

namespace volumen {

namespace {

enum Unit { densityUnit, gradientUnit, rayUnit };

GLuint makeTarget(GLenum format, GLenum attachment, int lines) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), Batch::line, lines, 0, GL_RGBA, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, name, 0);
  return name;
}

GLintptr gradientOffset(int lines) { return GLintptr(lines) * Batch::line * sizeof(float); }

}  // namespace

Status PlaneResampler::prepare(const Plan& plan, const VolumeTextures& textures, glm::ivec3 size,
                               std::int64_t lines) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (lines > most)
    return Error{"A step of " + std::to_string(plan.stepVoxels) +
                 " voxels makes longer rays than OpenGL can resample here; use --resampler cpu."};
  if (!vertices_) {
    glGenVertexArrays(1, &vertices_);
    glGenBuffers(1, &rayBuffer_);
    glGenTextures(1, &rayTexture_);
  }
  if (lines_ != lines || gradients_ != plan.gradients) {
    freeSlots();
    gradients_ = plan.gradients;
    lines_ = int(lines);
    for (Slot& slot : slots_)
      if (Status s = makeSlot(slot); !s) {
        freeSlots();
        return s;
      }
  }
  if (Status s = chooseProgram(plan.bits == 32); !s) return s;
  const auto bind = [](Unit unit, GLenum kind, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(kind, texture);
  };
  bind(densityUnit, GL_TEXTURE_3D, textures.density());
  bind(gradientUnit, GL_TEXTURE_3D, plan.gradients ? textures.gradients() : 0);
  bind(rayUnit, GL_TEXTURE_BUFFER, rayTexture_);
  glBindVertexArray(vertices_);
  glUseProgram(program_);
  const auto uniform = [&](const char* name) { return glGetUniformLocation(program_, name); };
  glUniform1i(uniform("density"), densityUnit);
  glUniform1i(uniform("gradient"), gradientUnit);
  glUniform1i(uniform("rays"), rayUnit);
  glUniform3i(uniform("size"), size.x, size.y, size.z);
  glUniform1i(uniform("lineShift"), Batch::lineLog2);
  glUniform1f(uniform("lines"), float(lines_));
  glUniform1f(uniform("smallest"), float(textures.smallest()));
  glUniform1f(uniform("rounding"), textures.rounding());
  return {};
}

Status PlaneResampler::chooseProgram(bool shaderFilter) {
  GLuint& program = programs_[2 * int(shaderFilter) + int(gradients_)];
  if (!program) {
    const auto made = makeProgram(std::string(shaderFilter ? "#define SHADER_FILTER\n" : "") +
                                      (gradients_ ? "#define GRADIENTS\n" : ""),
                                  shaders::planes_vert, {shaders::sample_glsl, shaders::planes_frag});
    if (!made) return made.error();
    program = *made;
  }
  program_ = program;
  return {};
}

Status PlaneResampler::makeSlot(Slot& slot) {
  while (glGetError() != GL_NO_ERROR) {
  }
  glActiveTexture(GL_TEXTURE0);
  glGenFramebuffers(1, &slot.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, slot.framebuffer);
  slot.density = makeTarget(GL_R32F, GL_COLOR_ATTACHMENT0, lines_);
  if (gradients_) slot.gradients = makeTarget(GL_RGBA32F, GL_COLOR_ATTACHMENT1, lines_);
  const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(gradients_ ? 2 : 1, both);
  glGenBuffers(1, &slot.pixels);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, slot.pixels);
  glBufferData(GL_PIXEL_PACK_BUFFER, gradientOffset(lines_) * (gradients_ ? 5 : 1), nullptr, GL_STREAM_READ);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE && glGetError() == GL_NO_ERROR)
    return {};
  return Error{"OpenGL has no room for planes of float samples; use --resampler cpu."};
}

void PlaneResampler::freeSlots() {
  for (Slot& slot : slots_) {
    glDeleteFramebuffers(1, &slot.framebuffer);
    glDeleteTextures(1, &slot.density);
    glDeleteTextures(1, &slot.gradients);
    glDeleteBuffers(1, &slot.pixels);
    slot = {};
  }
  lines_ = 0;
}

void PlaneResampler::draw(const Batch& batch, int slot) {
  auto& texels = rayTexels_;
  texels.clear();
  int ray = int(batch.strips.size());
  for (const Strip& s : batch.strips) {
    texels.insert(texels.end(), {float(s.firstLine), float(s.lines), float(s.strideLog2), float(ray)});
    ray += 2 * s.stride();
  }
  for (const Strip& s : batch.strips) {
    const RayRow& r = s.rays;
    for (std::size_t n = 0; n < r.steps.size(); ++n)
      texels.insert(texels.end(), {r.startX[n], r.startY[n], r.startZ[n], r.lastMiddle[n], r.moveX[n],
                                   r.moveY[n], r.moveZ[n], float(r.steps[n])});
    texels.insert(texels.end(), 8 * (s.stride() - r.steps.size()), 0.0f);
  }
  glBindBuffer(GL_TEXTURE_BUFFER, rayBuffer_);
  glBufferData(GL_TEXTURE_BUFFER, GLsizeiptr(texels.size() * sizeof(float)), texels.data(), GL_STREAM_DRAW);
  glActiveTexture(GL_TEXTURE0 + rayUnit);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, rayBuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, slots_[slot].framebuffer);
  glViewport(0, 0, Batch::line, lines_);
  timer_.begin(slot);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(batch.strips.size()));
  timer_.end();
  glFlush();
}

void PlaneResampler::startReading(const Batch& batch, int slot) {
  glBindFramebuffer(GL_FRAMEBUFFER, slots_[slot].framebuffer);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, slots_[slot].pixels);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, Batch::line, batch.lines, GL_RED, GL_FLOAT, nullptr);
  if (gradients_) {
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, Batch::line, batch.lines, GL_RGBA, GL_FLOAT,
                 reinterpret_cast<void*>(gradientOffset(batch.lines)));
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glFlush();
}

PlaneResampler::Samples PlaneResampler::map(const Batch& batch, int slot) {
  // Rays that miss the volume have no samples, but a buffer cannot be mapped by 0 bytes.
  const GLintptr density = gradientOffset(std::max(batch.lines, 1)), all = density * (gradients_ ? 5 : 1);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, slots_[slot].pixels);
  const auto* data =
      static_cast<const char*>(glMapBufferRange(GL_PIXEL_PACK_BUFFER, 0, all, GL_MAP_READ_BIT));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  if (!data || glGetError() != GL_NO_ERROR) return {};
  glMs_ += timer_.ms(slot);
  return {reinterpret_cast<const float*>(data),
          gradients_ ? reinterpret_cast<const float*>(data + density) : nullptr};
}

void PlaneResampler::unmap(int slot) {
  glBindBuffer(GL_PIXEL_PACK_BUFFER, slots_[slot].pixels);
  glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

}  // namespace volumen
