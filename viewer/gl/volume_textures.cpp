#include "viewer/gl/volume_textures.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "viewer/gl/program.h"
#include "viewer/gl/target.h"

namespace volumen {

namespace {

struct Format {
  GLenum stored, layout, component;
  int voxelBytes;
};
constexpr Format density16{GL_R16, GL_RED, GL_UNSIGNED_SHORT, 2};
constexpr Format density32{GL_R32F, GL_RED, GL_FLOAT, 4};
constexpr Format gradients16{GL_RGBA16_SNORM, GL_RGBA, GL_SHORT, 8};
constexpr Format gradients32{GL_RGBA32F, GL_RGBA, GL_FLOAT, 16};

std::string inWords(glm::ivec3 n) {
  return std::to_string(n.x) + " x " + std::to_string(n.y) + " x " + std::to_string(n.z) + " voxels";
}

// Returns an empty 3D texture, bound; 0 if there is no memory for it.
GLuint makeTexture(const Format& format, glm::ivec3 n) {
  GLuint name = 0;
  clearGlErrors();
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_3D, name);
  glTexImage3D(GL_TEXTURE_3D, 0, GLint(format.stored), n.x, n.y, n.z, 0, format.layout, format.component,
               nullptr);
  if (glGetError() != GL_NO_ERROR) {
    glDeleteTextures(1, &name);
    return 0;
  }
  const bool linear = format.component != GL_FLOAT;
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, linear ? GL_LINEAR : GL_NEAREST);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, linear ? GL_LINEAR : GL_NEAREST);
  for (GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTexParameteri(GL_TEXTURE_3D, axis, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
  return name;
}

// Fills the bound texture in layers of whole slices, which keeps the driver's copies small. layer(first
// voxel, voxels) returns their data, with rows `rowVoxels` apart.
template <class Layer>
Status upload(const Format& format, glm::ivec3 n, int rowVoxels, const CancelToken& cancel,
              const Layer& layer) {
  const std::size_t slice = std::size_t(n.x) * n.y;
  const int thickness = int(std::clamp<std::size_t>((16u << 20) / (slice * format.voxelBytes), 1, n.z));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (int k = 0; k < n.z; k += thickness) {
    if (cancel.cancelled()) return Error{"cancelled"};
    const int slices = std::min(thickness, n.z - k);
    const void* data = layer(k * slice, slices * slice);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, rowVoxels);
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, k, n.x, n.y, slices, format.layout, format.component, data);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  }
  if (glGetError() != GL_NO_ERROR) return Error{"OpenGL has no room for the volume; use --resampler cpu."};
  return {};
}

}  // namespace

Status VolumeTextures::load(const Plan& plan, StoredVoxels& voxels, const CancelToken& cancel) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &largest);
  const glm::ivec3 n = voxels.volume()->size();
  if (std::max({n.x, n.y, n.z}) > largest)
    return Error{"The volume has " + inWords(n) + ", and OpenGL here takes at most " +
                 std::to_string(largest) + " along an edge; use --resampler cpu."};
  size_ = n;
  if (Status s = loadDensity(plan.bits, voxels, cancel); !s) return s;
  return plan.gradients ? loadGradients(plan, voxels, cancel) : Status();
}

std::string VolumeTextures::defines(const Plan& plan) {
  const bool preshaded = plan.method == Method::preshaded;
  return std::string(preshaded || plan.bits == 32 ? "#define SHADER_FILTER\n" : "") +
         (!preshaded && plan.gradients ? "#define GRADIENTS\n" : "");
}

void VolumeTextures::use(unsigned program, const Plan& plan) const {
  const bool preshaded = plan.method == Method::preshaded;
  bindTexture(densityUnit, GL_TEXTURE_3D, preshaded ? 0 : density_.name);
  bindTexture(gradientUnit, GL_TEXTURE_3D, preshaded ? shaded_.name : plan.gradients ? gradients_.name : 0);
  glUseProgram(program);
  const auto uniform = [&](const char* name) { return glGetUniformLocation(program, name); };
  glUniform1i(uniform("density"), densityUnit);
  glUniform1i(uniform("gradient"), gradientUnit);
  glUniform3i(uniform("size"), size_.x, size_.y, size_.z);
  glUniform1f(uniform("smallest"), float(smallest_));
  glUniform1f(uniform("rounding"), rounding());
}

// Returns a bound on the rounding of 16-bit densities: less than four times 2^-24 of the largest. It covers
// the conversion of a texel to 0..1 and back, and its interpolation.
float VolumeTextures::rounding() const { return float(std::max(span_, 1)) * 0x1p-21f; }

Status VolumeTextures::loadShaded(glm::ivec3 n, const float* rgba, const CancelToken& cancel) {
  size_ = n;
  glDeleteTextures(1, &shaded_.name);
  shaded_ = {makeTexture(gradients32, n), 32, std::size_t(n.x) * n.y * n.z * gradients32.voxelBytes};
  if (!shaded_.name)
    return Error{"OpenGL has no room for " + inWords(n) + " in colour; use --resampler cpu."};
  return upload(gradients32, n, n.x, cancel,
                [&](std::size_t first, std::size_t) { return rgba + 4 * first; });
}

Status VolumeTextures::loadDensity(int bits, StoredVoxels& voxels, const CancelToken& cancel) {
  if (density_.bits == bits) return {};
  glDeleteTextures(1, &density_.name);
  const Format& format = bits == 16 ? density16 : density32;
  const glm::ivec3 n = voxels.volume()->size();
  density_ = {makeTexture(format, n), 0, 0};
  if (!density_.name) return Error{"OpenGL has no room for " + inWords(n) + "; use --resampler cpu."};
  Status done;
  if (bits == 16) {
    const Density16& stored = voxels.densities16();
    smallest_ = int(std::lround(stored.scale.low));
    span_ = int(std::lround(stored.scale.high)) - smallest_;
    // Unsigned samples are read as signed densities that are 32768 less.
    const int flip = int(stored.flip & 0xffff);
    std::vector<std::uint16_t> counted;
    done = upload(format, n, n.x, cancel, [&](std::size_t first, std::size_t count) {
      counted.resize(count);
      std::transform(stored.data + first, stored.data + first + count, counted.begin(),
                     [&](std::int16_t d) { return std::uint16_t(std::int16_t(d ^ flip) - smallest_); });
      return counted.data();
    });
  } else {
    const float* stored = voxels.densities32().data;
    done = upload(format, n, n.x, cancel, [&](std::size_t first, std::size_t) { return stored + first; });
  }
  if (!done) return done;
  density_.bits = bits;
  density_.bytes = std::size_t(n.x) * n.y * n.z * format.voxelBytes;
  return {};
}

Status VolumeTextures::loadGradients(const Plan& plan, StoredVoxels& voxels, const CancelToken& cancel) {
  const int bits = plan.bits;
  const GradientOperator by = plan.gradientOperator;
  if (gradients_.bits == bits && gradientsBy_ == by) return {};
  glDeleteTextures(1, &gradients_.name);
  const Format& format = bits == 16 ? gradients16 : gradients32;
  const glm::ivec3 n = voxels.volume()->size();
  gradients_ = {makeTexture(format, n), 0, 0};
  if (!gradients_.name)
    return Error{"OpenGL has no room for gradients of " + inWords(n) + "; use --resampler cpu."};
  Status done;
  if (bits == 16) {
    const Gradients16& g = voxels.gradientsIn16(by);
    done = upload(format, n, g.rowVoxels, cancel,
                  [&](std::size_t first, std::size_t) { return g.row(first / std::size_t(n.x)); });
  } else {
    const float* stored = voxels.gradientsIn32(by).xyz0.data();
    done = upload(format, n, n.x, cancel, [&](std::size_t first, std::size_t) { return stored + 4 * first; });
  }
  if (!done) return done;
  gradients_.bits = bits;
  gradientsBy_ = by;
  gradients_.bytes = std::size_t(n.x) * n.y * n.z * format.voxelBytes;
  return {};
}

}  // namespace volumen
