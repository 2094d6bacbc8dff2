#include "viewer/render/gl/caster.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "viewer/render/gl/shader_texts.h"

namespace volumen {

namespace {

enum Unit { densityUnit, gradientUnit, rayUnit, curveUnit, bucketUnit, factorUnit, lightUnit, shadeUnit };

const char* shadeDefine(const Plan& plan) {
  if (!plan.lit || plan.method == Method::preshaded) return "";
  if (plan.shader == Shader::table) return "#define TABLE\n";
  if (plan.shader == Shader::map)
    return plan.mapLookup == MapLookup::nearest ? "#define MAP_NEAREST\n" : "#define MAP\n";
  return plan.scene.shading.localViewer ? "#define LOCAL\n" : "#define PHONG\n";
}

std::string definesOf(const Plan& plan) {
  const bool composite = plan.scene.mode == Mode::composite, preshaded = plan.method == Method::preshaded;
  static constexpr const char* modes[] = {"#define COMPOSITE\n", "#define MIP\n", "#define MINIP\n",
                                          "#define AVERAGE\n"};
  std::string text = modes[int(plan.scene.mode)];
  if (preshaded || plan.bits == 32) text += "#define SHADER_FILTER\n";
  if (preshaded) return text + "#define PRESHADED\n";
  if (composite && plan.gradients) text += "#define GRADIENTS\n";
  if (composite && plan.gradientOpacity) text += "#define GRADIENT_OPACITY\n";
  return text + shadeDefine(plan);
}

template <class T>
Status uploadAll(BufferTexture& to, GLenum format, int texelBytes, const std::vector<T>& values) {
  const std::size_t bytes = values.size() * sizeof(T);
  return to.upload(format, bytes / texelBytes, values.data(), bytes);
}

std::vector<float> curveTexels(const CurveTable& c) {
  std::vector<float> out;
  for (int s = 0; s < c.segments; ++s)
    out.insert(out.end(), {c.node[s], c.start[s], c.opacity[s], c.opacityRise[s], c.red[s], c.redRise[s],
                           c.green[s], c.greenRise[s], c.blue[s], c.blueRise[s], 0, 0});
  return out;
}

std::vector<float> lightTexels(const Lighting& lighting) {
  std::vector<float> out;
  for (const ShadingLight& light : lighting.lights)
    for (const glm::vec3& v : {light.l, light.h, light.diffuse, light.specular})
      out.insert(out.end(), {v.x, v.y, v.z, 0});
  out.resize(std::max<std::size_t>(out.size(), 4));
  return out;
}

std::vector<float> factorTexels(const TransferFunction& curve) {
  std::vector<float> out;
  for (const GradientOpacityPoint& p : curve.gradientOpacity)
    out.insert(out.end(), {float(p.gradient), float(p.factor)});
  if (out.empty()) out = {0, 1};
  return out;
}

}  // namespace

int Caster::uniform(const char* name) const { return glGetUniformLocation(program_, name); }

Status Caster::prepare(const Plan& plan, const TraceFrame& frame, const VolumeTextures& textures) {
  if (!vertices_) {
    glGenVertexArrays(1, &vertices_);
    glGenFramebuffers(1, &framebuffer_);
  }
  if (Status s = chooseProgram(plan); !s) return s;
  if (Status s = uploadTables(plan, frame); !s) return s;
  setUniforms(plan, frame, textures);
  return {};
}

Status Caster::chooseProgram(const Plan& plan) {
  const std::string defines = definesOf(plan);
  unsigned& program = programs_[defines];
  if (!program) {
    const auto made =
        makeProgram(defines, shaders::picture_vert,
                    {shaders::sample_glsl, shaders::ray_glsl, shaders::shade_glsl, shaders::cast_frag});
    if (!made) return made.error();
    program = *made;
  }
  program_ = program;
  return {};
}

Status Caster::uploadTables(const Plan& plan, const TraceFrame& frame) {
  if (Status s = uploadAll(curve_, GL_RGBA32F, 16, curveTexels(*frame.curve)); !s) return s;
  const std::vector<float> first(frame.curve->first.begin(), frame.curve->first.end());
  if (Status s = uploadAll(buckets_, GL_R32F, 4, first); !s) return s;
  if (Status s = uploadAll(factors_, GL_RG32F, 8, factorTexels(*frame.transfer)); !s) return s;
  if (Status s = uploadAll(lights_, GL_RGBA32F, 16, lightTexels(*frame.lighting)); !s) return s;
  if (plan.shader == Shader::map) return uploadAll(shades_, GL_RGBA32F, 16, frame.map->nodes);
  if (plan.shader == Shader::table) return uploadAll(shades_, GL_R32I, 4, frame.table->bgr);
  return {};
}

void Caster::setUniforms(const Plan& plan, const TraceFrame& f, const VolumeTextures& textures) {
  const bool preshaded = plan.method == Method::preshaded;
  glUseProgram(program_);
  glActiveTexture(GL_TEXTURE0 + densityUnit);
  glBindTexture(GL_TEXTURE_3D, preshaded ? 0 : textures.density());
  glActiveTexture(GL_TEXTURE0 + gradientUnit);
  glBindTexture(GL_TEXTURE_3D, preshaded ? textures.shaded() : plan.gradients ? textures.gradients() : 0);
  const std::pair<const char*, Unit> units[] = {
      {"density", densityUnit}, {"gradient", gradientUnit}, {"rays", rayUnit},     {"curve", curveUnit},
      {"buckets", bucketUnit},  {"factors", factorUnit},    {"lights", lightUnit}, {"shades", shadeUnit}};
  for (const auto& [name, unit] : units) glUniform1i(uniform(name), unit);
  glUniform3i(uniform("size"), f.size.x, f.size.y, f.size.z);
  glUniform1f(uniform("smallest"), float(textures.smallest()));
  glUniform1f(uniform("rounding"), textures.rounding());
  glUniform1f(uniform("stopTransmittance"), f.stopTransmittance);
  glUniform1f(uniform("curveLow"), f.curve->low);
  glUniform1f(uniform("perBucket"), f.curve->perBucket);
  glUniform1i(uniform("bucketCount"), int(f.curve->first.size()));
  glUniform1i(uniform("hops"), f.curve->hops);
  glUniform1i(uniform("factorCount"), std::max(1, int(f.transfer->gradientOpacity.size())));
  float realGradient[9];
  for (int n = 0; n < 9; ++n) realGradient[n] = f.gradientMatrix[n] * f.gradientUnit;
  glUniformMatrix3fv(uniform("gradientMatrix"), 1, GL_TRUE, realGradient);
  glUniform1f(uniform("inverseFloor"), f.inverseFloor);
  const Lighting& l = *f.lighting;
  glUniform3f(uniform("flatLight"), l.flat.r, l.flat.g, l.flat.b);
  glUniform3f(uniform("viewer"), l.viewer.x, l.viewer.y, l.viewer.z);
  glUniform1i(uniform("lightCount"), int(l.lights.size()));
  glUniform1f(uniform("ambient"), l.ambient);
  glUniform1f(uniform("shininess"), l.shininess);
  glUniform1i(uniform("twoSided"), l.twoSided);
  glUniform1i(uniform("specular"), l.specular);
  if (f.map) glUniform1i(uniform("mapSize"), f.map->n);
  if (!f.table) return;
  glUniform1f(uniform("perGradient"), f.table->perGradient);
  glUniform1f(uniform("densityLow"), f.table->densityLow);
  glUniform1f(uniform("perDensity"), f.table->perDensity);
}

bool Caster::makeTarget(int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  if (width_ == width && height_ == height) return true;
  while (glGetError() != GL_NO_ERROR) {
  }
  glDeleteTextures(1, &target_);
  glGenTextures(1, &target_);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, target_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target_, 0);
  width_ = width;
  height_ = height;
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE && glGetError() == GL_NO_ERROR;
}

const std::vector<float>& Caster::draw(const RayBand& band, float inverseUnitMm) {
  pixels_.clear();
  const int rows = int(band.rows.size());
  if (!makeTarget(band.stride, rows) || !uploadRays(band, inverseUnitMm, rays_)) return pixels_;
  const std::pair<const BufferTexture*, Unit> buffers[] = {{&rays_, rayUnit},       {&curve_, curveUnit},
                                                           {&buckets_, bucketUnit}, {&factors_, factorUnit},
                                                           {&lights_, lightUnit},   {&shades_, shadeUnit}};
  for (const auto& [buffer, unit] : buffers) buffer->bind(unit);
  glUseProgram(program_);
  glBindVertexArray(vertices_);
  glUniform1i(uniform("width"), band.stride);
  glDisable(GL_BLEND);
  glViewport(0, 0, band.stride, rows);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  pixels_.resize(std::size_t(4) * band.stride * rows);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, band.stride, rows, GL_RGBA, GL_FLOAT, pixels_.data());
  if (glGetError() != GL_NO_ERROR) pixels_.clear();
  return pixels_;
}

}  // namespace volumen
