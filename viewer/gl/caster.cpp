#include "viewer/gl/caster.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

#include "viewer/gl/shader_texts.h"

namespace volumen {

namespace {

enum CastUnit {
  castRayUnit = VolumeTextures::freeUnit,
  curveUnit,
  bucketUnit,
  factorUnit,
  lightUnit,
  shadeUnit,
  beforeUnit
};

// Limits the nested loops of a pass to a quarter of the iterations that llvmpipe allows.
int stepsOfPass(const RayInputs& f) {
  const int turnsOfStep = 1 + f.curve->hops + std::max(1, int(f.transfer->gradientOpacity.size())) +
                          2 * int(f.lighting->lights.size());
  return std::max(1, (1 << 14) / turnsOfStep);
}

const char* shadeDefine(const Plan& plan) {
  if (!plan.lit || plan.method == Method::preshaded) return "";
  if (plan.shader == Shader::table) return "#define TABLE\n";
  if (plan.shader == Shader::map)
    return plan.mapLookup == MapLookup::nearest ? "#define MAP_NEAREST\n" : "#define MAP\n";
  return plan.scene.shading.localViewer ? "#define LOCAL\n" : "#define PHONG\n";
}

std::string definesOf(const Plan& plan) {
  static constexpr const char* modes[] = {"#define COMPOSITE\n", "#define MIP\n", "#define MINIP\n",
                                          "#define AVERAGE\n"};
  std::string text = modes[int(plan.scene.mode)] + VolumeTextures::defines(plan);
  if (plan.method == Method::preshaded) return text + "#define PRESHADED\n";
  if (plan.scene.mode == Mode::composite && plan.gradientOpacity) text += "#define GRADIENT_OPACITY\n";
  if (!plan.colouredLight) text += "#define GREY\n";
  return text + shadeDefine(plan);
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

Status Caster::prepare(const Plan& plan, const RayInputs& inputs, const VolumeTextures& textures) {
  if (!vertices_) glGenVertexArrays(1, &vertices_);
  if (Status s = chooseProgram(plan); !s) return s;
  if (Status s = uploadTables(plan, inputs); !s) return s;
  setUniforms(plan, inputs, textures);
  stepsOfPass_ = stepsOfPass(inputs);
  return {};
}

Status Caster::chooseProgram(const Plan& plan) {
  const auto program =
      programs_.of(definesOf(plan), shaders::picture_vert,
                   {shaders::sample_glsl, shaders::ray_glsl, shaders::shade_glsl, shaders::cast_frag});
  if (!program) return program.error();
  program_ = *program;
  return {};
}

Status Caster::uploadTables(const Plan& plan, const RayInputs& inputs) {
  if (Status s = curve_.upload(GL_RGBA32F, 16, curveTexels(*inputs.curve)); !s) return s;
  const std::vector<float> first(inputs.curve->first.begin(), inputs.curve->first.end());
  if (Status s = buckets_.upload(GL_R32F, 4, first); !s) return s;
  if (Status s = factors_.upload(GL_RG32F, 8, factorTexels(*inputs.transfer)); !s) return s;
  if (Status s = lights_.upload(GL_RGBA32F, 16, lightTexels(*inputs.lighting)); !s) return s;
  if (plan.shader == Shader::map)
    return inputs.map->coloured ? shades_.upload(GL_RGBA32F, 16, inputs.map->nodes)
                                : shades_.upload(GL_RG32F, 8, inputs.map->nodes);
  if (plan.shader == Shader::table) return shades_.upload(GL_R32I, 4, inputs.table->bgr);
  return {};
}

void Caster::setUniforms(const Plan& plan, const RayInputs& f, const VolumeTextures& textures) {
  textures.use(program_, plan);
  const std::pair<const char*, CastUnit> units[] = {
      {"rays", castRayUnit}, {"curve", curveUnit},  {"buckets", bucketUnit}, {"factors", factorUnit},
      {"lights", lightUnit}, {"shades", shadeUnit}, {"before", beforeUnit}};
  for (const auto& [name, unit] : units) glUniform1i(uniform(name), unit);
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

bool Caster::makeTarget(glm::ivec2 size) { return target_.size() == size || target_.make(GL_RGBA32F, size); }

Status Caster::draw(const RayBand& band, float inverseUnitMm) {
  if (Status s = uploadRays(band, inverseUnitMm, rays_); !s) return s;
  const std::pair<const BufferTexture*, CastUnit> buffers[] = {
      {&rays_, castRayUnit},   {&curve_, curveUnit},  {&buckets_, bucketUnit},
      {&factors_, factorUnit}, {&lights_, lightUnit}, {&shades_, shadeUnit}};
  for (const auto& [buffer, unit] : buffers) buffer->bind(unit);
  glUseProgram(program_);
  glBindVertexArray(vertices_);
  glUniform1i(uniform("width"), band.stride);
  int first = 0;
  do {
    if (first > 0) std::swap(target_, before_);
    if (!makeTarget({band.stride, int(band.rows.size())}))
      return Error{"OpenGL has no room for the picture; use --resampler cpu."};
    glUniform1i(uniform("firstStep"), first);
    glUniform1i(uniform("behindStep"), first += stepsOfPass_);
    bindTexture(beforeUnit, GL_TEXTURE_2D, before_.texture());
    target_.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
  } while (first < band.longest);
  return {};
}

}  // namespace volumen
