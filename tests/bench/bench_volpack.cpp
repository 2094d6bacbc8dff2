// Times VolPack, Lacroute's shear-warp, on the same scenes with one thread: classified beforehand, and from
// the raw volume with its octree (curve edits then cost nothing). VolPack has 8-bit densities, one material
// per scene and parallel projection only.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/bench/peer.h"

extern "C" {
#include <volpack.h>
}

namespace {

using namespace volumen;

struct Voxel {
  unsigned short normal;
  unsigned char density, gradient;
};
enum Field { normalField, densityField, gradientField };

constexpr int edge = 512;

void check(vpResult result, vpContext* context) {
  if (result == VP_OK) return;
  std::fprintf(stderr, "VolPack: %s\n", vpGetErrorString(vpGetError(context)));
  std::exit(1);
}

class ShearWarp : public bench::Peer {
 public:
  ShearWarp(const Volume& volume, const Scene& scene, bool classified)
      : volume_(volume), scene_(scene), classified_(classified), context_(vpCreateContext()) {
    setVolume();
    setCurve();
    setLight();
    vpSetImage(context_, image_.data(), edge, edge, 3 * edge, VP_RGB);
    if (classified_)
      check(vpClassifyVolume(context_), context_);
    else
      makeOctree();
  }
  ~ShearWarp() override { vpDestroyContext(context_); }

  std::string name() const override {
    return classified_ ? "VolPack, classified, 1 thread" : "VolPack, raw with octree, 1 thread";
  }

  double stopsAt() const override { return 1.0 / 256; }

  void draw(const Camera& camera) override {
    setCamera(camera);
    check(vpShadeTable(context_), context_);
    check(classified_ ? vpRenderClassifiedVolume(context_) : vpRenderRawVolume(context_), context_);
  }

  // VolPack's first row is at the bottom.
  std::vector<std::uint8_t> rgb() const override {
    std::vector<std::uint8_t> out;
    for (int y = edge - 1; y >= 0; --y)
      out.insert(out.end(), image_.begin() + std::ptrdiff_t(y) * 3 * edge,
                 image_.begin() + std::ptrdiff_t(y + 1) * 3 * edge);
    return out;
  }

 private:
  void setVolume() {
    const glm::ivec3 n = volume_.size();
    const std::size_t count = std::size_t(volume_.geometry().voxelCount());
    std::vector<unsigned char> densities(count);
    for (std::size_t v = 0; v < count; ++v) densities[v] = (unsigned char)(eightBits(volume_.valueAt(v)));
    voxels_.resize(count);
    vpSetVolumeSize(context_, n.x, n.y, n.z);
    vpSetVoxelSize(context_, sizeof(Voxel), 3, 1, 1);
    const Voxel* v = nullptr;
    vpSetVoxelField(context_, normalField, sizeof(v->normal), offsetof(Voxel, normal), VP_NORM_MAX);
    vpSetVoxelField(context_, densityField, sizeof(v->density), offsetof(Voxel, density), VP_SCALAR_MAX);
    vpSetVoxelField(context_, gradientField, sizeof(v->gradient), offsetof(Voxel, gradient), VP_GRAD_MAX);
    check(vpSetRawVoxels(context_, voxels_.data(), int(count * sizeof(Voxel)), sizeof(Voxel),
                         int(n.x * sizeof(Voxel)), int(std::size_t(n.x) * n.y * sizeof(Voxel))),
          context_);
    check(vpVolumeNormals(context_, densities.data(), int(count), densityField, gradientField, normalField),
          context_);
  }

  // Maps HU -1024 .. 3056 to bytes in steps of 16.
  static int eightBits(double value) { return std::clamp(int(std::lround((value + 1024) / 16)), 0, 255); }

  void setCurve() {
    // VolPack's opacity is that of one sample per voxel along the slices. Here 1 voxel is about a unit
    // distance.
    opacity_.resize(256);
    const auto& points = scene_.transferFunction.points;
    for (int n = 0; n < 256; ++n) {
      const double value = 16 * n - 1024;
      double opacity = value < points.front().value ? points.front().opacity : points.back().opacity;
      for (std::size_t p = 0; p + 1 < points.size(); ++p)
        if (value >= points[p].value && value < points[p + 1].value)
          opacity = points[p].opacity + (value - points[p].value) /
                                            (double(points[p + 1].value) - points[p].value) *
                                            (points[p + 1].opacity - points[p].opacity);
      opacity_[n] = float(opacity);
    }
    check(vpSetClassifierTable(context_, 0, densityField, opacity_.data(),
                               int(opacity_.size() * sizeof(float))),
          context_);
    vpSetd(context_, VP_MIN_VOXEL_OPACITY, 0.0005);
    vpSetd(context_, VP_MAX_RAY_OPACITY, 1 - stopsAt());
  }

  void setLight() {
    const Shading& s = scene_.shading;
    shades_.resize(3 * (VP_NORM_MAX + 1));
    check(vpSetLookupShader(context_, 3, 1, normalField, shades_.data(), int(shades_.size() * sizeof(float)),
                            0, nullptr, 0),
          context_);
    vpSetMaterial(context_, VP_MATERIAL0, VP_AMBIENT, VP_BOTH_SIDES, s.ambient, s.ambient, s.ambient);
    vpSetMaterial(context_, VP_MATERIAL0, VP_DIFFUSE, VP_BOTH_SIDES, s.diffuse, s.diffuse, s.diffuse);
    vpSetMaterial(context_, VP_MATERIAL0, VP_SPECULAR, VP_BOTH_SIDES, s.specular, s.specular, s.specular);
    vpSetMaterial(context_, VP_MATERIAL0, VP_SHINYNESS, VP_BOTH_SIDES, s.shininess, 0, 0);
    vpSeti(context_, VP_CLAMP_SHADE_TABLE, 1);
    vpEnable(context_, VP_LIGHT_BOTH_SIDES, 1);
    const int lights = std::min(int(scene_.lights.size()), VP_MAX_LIGHTS);
    for (int n = 0; n < lights; ++n) {
      const Light& l = scene_.lights[n];
      const glm::dvec3 d = glm::normalize(l.direction), c = l.intensity * l.colour;
      vpSetLight(context_, VP_LIGHT0 + n, VP_DIRECTION, d.x, d.y, -d.z);
      vpSetLight(context_, VP_LIGHT0 + n, VP_COLOR, c.r, c.g, c.b);
      vpEnable(context_, VP_LIGHT0 + n, 1);
    }
  }

  void makeOctree() {
    vpMinMaxOctreeThreshold(context_, 0, 4);
    check(vpCreateMinMaxOctree(context_, 0, 4), context_);
  }

  // VolPack's object space has voxels around the origin and a longest edge of 1, and looks along +z. Its
  // lights are not scaled back, so all lengths are in units of that edge, not in mm.
  void setCamera(const Camera& camera) {
    const CameraAxes axes = cameraAxes(camera);
    const VoxelGeometry& g = volume_.geometry();
    const int longest = std::max({g.size.x, g.size.y, g.size.z});
    const double unitMm = longest * std::cbrt(g.voxelVolume());
    const glm::dmat3 cameraFromPatient = glm::transpose(glm::dmat3(axes.right, axes.up, axes.direction));
    const glm::dmat3 linear = cameraFromPatient * g.patientFromVoxelStep * (longest / unitMm);
    const glm::dvec3 offset = cameraFromPatient * (g.centre() - *camera.target) / unitMm;
    vpMatrix4 model = {};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) model[r][c] = linear[c][r];
      model[r][3] = offset[r];
    }
    model[3][3] = 1;
    vpCurrentMatrix(context_, VP_MODEL);
    vpSetMatrix(context_, model);
    for (const int matrix : {VP_VIEW, VP_PROJECT}) {
      vpCurrentMatrix(context_, matrix);
      vpIdentityMatrix(context_);
    }
    const double half = camera.height / 2 / unitMm;
    check(vpWindow(context_, VP_PARALLEL, -half, half, -half, half, -2, 2), context_);
  }

  const Volume& volume_;
  const Scene& scene_;
  bool classified_;
  vpContext* context_;
  std::vector<Voxel> voxels_;
  std::vector<float> opacity_, shades_;
  std::vector<unsigned char> image_ = std::vector<unsigned char>(3 * edge * edge);
};

std::vector<std::unique_ptr<bench::Peer>> makePeers(const Volume& volume, const Scene& scene) {
  std::vector<std::unique_ptr<bench::Peer>> peers;
  for (const bool classified : {true, false})
    peers.push_back(std::make_unique<ShearWarp>(volume, scene, classified));
  return peers;
}

}  // namespace

int main(int argc, char** argv) { return volumen::bench::comparePeers(argc, argv, makePeers); }
