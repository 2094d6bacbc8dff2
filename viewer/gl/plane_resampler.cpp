#include "viewer/gl/plane_resampler.h"

#include <epoxy/gl.h>

#include <string>

#include "viewer/gl/shader_texts.h"

namespace volumen {

namespace {

constexpr int planeRayUnit = VolumeTextures::freeUnit;

}  // namespace

Status PlaneResampler::prepare(const Plan& plan, const VolumeTextures& textures, std::int64_t lines) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (lines > most)
    return Error{"A step of " + std::to_string(plan.stepVoxels) +
                 " voxels makes longer rays than OpenGL can resample here; use --resampler cpu."};
  if (!vertices_) glGenVertexArrays(1, &vertices_);
  if (lines_ != lines || gradients_ != plan.gradients)
    if (Status s = makeSlots(int(lines), plan.gradients); !s) return s;
  const auto program = programs_.of(VolumeTextures::defines(plan), shaders::planes_vert,
                                    {shaders::sample_glsl, shaders::planes_frag});
  if (!program) return program.error();
  program_ = *program;
  textures.use(program_, plan);
  const auto uniform = [&](const char* name) { return glGetUniformLocation(program_, name); };
  glUniform1i(uniform("rays"), planeRayUnit);
  glUniform1i(uniform("lineShift"), Batch::lineLog2);
  glUniform1f(uniform("lines"), float(lines_));
  glBindVertexArray(vertices_);
  return {};
}

Status PlaneResampler::makeSlots(int lines, bool gradients) {
  freeSlots();
  for (SampleTarget& slot : slots_)
    if (!slot.make({Batch::line, lines}, gradients)) {
      freeSlots();
      return Error{"OpenGL has no room for planes of float samples; use --resampler cpu."};
    }
  lines_ = lines;
  gradients_ = gradients;
  return {};
}

void PlaneResampler::freeSlots() {
  for (SampleTarget& slot : slots_) slot.free();
  lines_ = 0;
}

Status PlaneResampler::draw(const Batch& batch, int slot) {
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
  if (Status s = rays_.upload(GL_RGBA32F, 16, texels); !s) return s;
  rays_.bind(planeRayUnit);
  slots_[slot].use();
  timer_.begin(slot);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(batch.strips.size()));
  timer_.end();
  glFlush();
  return {};
}

SampleTarget::Samples PlaneResampler::map(int slot) {
  const SampleTarget::Samples samples = slots_[slot].map();
  if (samples.density) glMs_ += timer_.ms(slot);
  return samples;
}

}  // namespace volumen
