// Guards design.md 3 (preshaded): classify and shade voxels, interpolate colours, composite by picture.md 9's
// rule.
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/brute_force.h"
#include "tests/fixtures/brute_matter.h"
#include "tests/fixtures/picture_words.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/render/method_cases.h"
#include "tests/unit/suite.h"
#include "viewer/kernels/ray_generator.h"
#include "viewer/reference/reference.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr glm::ivec2 size{36, 30};
constexpr double step = 0.5;

/// Colour times opacity, and opacity per unit distance.
using Rgba = glm::dvec4;

/// The method by its plain definition in double precision. Rays come from the viewer's own set-up, which
/// other tests guard.
class Definition {
 public:
  Definition(const Scene& scene, VolumePtr volume)
      : scene_(completed(scene, *volume, size)), volume_(volume) {
    const BruteMatter matter(scene_, *volume_);
    const glm::ivec3 n = volume_->size();
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) voxels_.push_back(voxelOf(matter, {i, j, k}));
  }

  Picture picture() const {
    Picture out{size, scene_.background.transparent, std::vector<float>(std::size_t(4) * size.x * size.y)};
    const RayGenerator setup(scene_, volume_->geometry(), size, step, true);
    RayRow rays;
    for (int y = 0; y < size.y; ++y) {
      setup.makeRays(0, y, size.x, rays);
      for (int x = 0; x < size.x; ++x) {
        const glm::dvec4 c = colourOf(rays, x);
        const glm::dvec3 behind = scene_.background.colour;
        for (int n = 0; n < 3; ++n)
          out.row(y)[4 * x + n] = float(std::clamp(c[n] + (1 - c.a) * behind[n], 0.0, 1.0));
        out.row(y)[4 * x + 3] = 1;
      }
    }
    return out;
  }

 private:
  Rgba voxelOf(const BruteMatter& matter, glm::ivec3 voxel) const {
    const Cell cell = matter.cellAt(glm::dvec3(voxel), true);
    const glm::dvec3 inside = glm::dvec3(voxel - cell.low);
    const glm::dvec3 gradient = matter.perMm(trilinear(cell.gradients, inside));
    Matter m = matter.classify(volume_->value(voxel.x, voxel.y, voxel.z));
    m.opacity *= matter.gradientFactor(glm::length(gradient));
    if (scene_.shading.lit) m.colour = matter.shade(m.colour, gradient, towardsViewer(voxel));
    return {m.opacity * m.colour, m.opacity};
  }

  glm::dvec3 towardsViewer(glm::ivec3 voxel) const {
    const Camera& camera = *scene_.camera;
    const glm::dvec3 direction = glm::normalize(camera.direction);
    if (!scene_.shading.localViewer || camera.projection == Projection::parallel) return -direction;
    const glm::dvec3 eye = *camera.target - camera.distance * direction;
    return glm::normalize(eye - volume_->geometry().patientFromVoxel(glm::dvec3(voxel)));
  }

  Rgba interpolated(glm::dvec3 x) const {
    const glm::ivec3 n = volume_->size();
    x = glm::clamp(x, glm::dvec3(0), glm::dvec3(n - 1));
    const glm::ivec3 low = glm::min(glm::ivec3(x), n - 2);
    std::array<Rgba, 8> corners;
    for (int c = 0; c < 8; ++c) {
      const glm::ivec3 v = low + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
      corners[c] = voxels_[(std::size_t(v.z) * n.y + v.y) * n.x + v.x];
    }
    return trilinear(corners, x - glm::dvec3(low));
  }

  glm::dvec4 colourOf(const RayRow& rays, int ray) const {
    glm::dvec4 sum(0);
    for (int n = 0; n < rays.steps[ray]; ++n) {
      const bool last = n + 1 == rays.steps[ray];
      const double middle = last ? rays.lastMiddle[ray] : n + 0.5;
      const double mm = last ? rays.lastStepMm[ray] : rays.stepMm[ray];
      const glm::dvec3 start(rays.startX[ray], rays.startY[ray], rays.startZ[ray]);
      const glm::dvec3 move(rays.moveX[ray], rays.moveY[ray], rays.moveZ[ray]);
      const Rgba s = interpolated(start + middle * move);
      if (!(s.a > 0)) continue;
      const double alpha =
          1 - std::pow(1 - std::min(s.a, 1 - std::ldexp(1, -20)), mm / scene_.transferFunction.unitDistance);
      sum += (1 - sum.a) * alpha * glm::dvec4(glm::dvec3(s) / s.a, 1);
    }
    return sum;
  }

  Scene scene_;
  VolumePtr volume_;
  std::vector<Rgba> voxels_;
};

Picture drawn(const Scene& scene, VolumePtr volume, Method method, int bits = 16) {
  RenderCaches caches(volume);
  RenderOptions options;
  options.size = size;
  options.step = step;
  options.method = method;
  options.precision = bits;
  return render(*makePlan(scene, caches.facts(), options), caches)->picture;
}

}  // namespace

class TestPreshaded : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void isItsDefinition_data();
  void isItsDefinition();
  void aStraightCurveUnlitIsTheRule();
  void theOrderOfOperationsCosts();
};

void TestPreshaded::isItsDefinition_data() {
  QTest::addColumn<int>("index");
  QTest::addColumn<int>("bits");
  for (int n = 0; n < int(methodScenes().size()); ++n)
    for (int bits : {16, 32}) QTest::addRow("%s, %d bits", methodScenes()[n].name.c_str(), bits) << n << bits;
  QTest::addRow("local viewer, gradient opacity, 16 bits") << -1 << 16;
}

// The bound of 0.02/255 covers float sums and the transmittance of 1/16384 at which rays end (255/16384 =
// 0.016).
void TestPreshaded::isItsDefinition() {
  QFETCH(int, index);
  QFETCH(int, bits);
  Scene scene = methodScenes()[index < 0 ? methodScenes().size() - 1 : std::size_t(index)].scene;
  if (index < 0) {
    scene.shading.localViewer = true;
    scene.transferFunction.gradientOpacity = {{15, 0}, {60, 0.4}, {160, 1}};
  }
  const Picture truth = Definition(scene, wavyVolume()).picture();
  const PictureError e = compare(drawn(scene, wavyVolume(), Method::preshaded, bits), truth);
  QVERIFY2(e.maximum <= 0.02, qPrintable(inWords(e)));
}

// Colour is constant and unlit, and opacity is linear over all values. Interpolating opacities thus equals
// interpolating values.
void TestPreshaded::aStraightCurveUnlitIsTheRule() {
  const VolumePtr ramp =
      volumeOf({20, 16, 12}, glm::dmat3(1), [](glm::dvec3 x) { return 5 * x.x + x.y * x.z; });
  Scene scene = methodScenes().front().scene;
  scene.shading.lit = false;
  scene.transferFunction.points = {{0, {0.9, 0.6, 0.3}, 0}, {300, {0.9, 0.6, 0.3}, 0.6}};
  scene.camera->height = 24;
  const PictureError e = compare(drawn(scene, ramp, Method::preshaded), bruteForce(scene, *ramp, size, step));
  QVERIFY2(e.maximum <= 0.02, qPrintable(inWords(e)));
}

// If the curve is sharp, interpolated colours differ strongly from colours of interpolated values.
void TestPreshaded::theOrderOfOperationsCosts() {
  for (const MethodScene& s : methodScenes()) {
    if (s.name.find("sharp") == std::string::npos) continue;
    const Picture truth = *renderReference(completed(s.scene, *wavyVolume(), size), *wavyVolume(), size);
    const PictureError preshaded = compare(drawn(s.scene, wavyVolume(), Method::preshaded), truth);
    const PictureError planes = compare(drawn(s.scene, wavyVolume(), Method::planes), truth);
    QVERIFY2(preshaded.rmse > 2 * planes.rmse, qPrintable(inWords(preshaded) + inWords(planes)));
  }
}

VOLUMEN_TEST(TestPreshaded);
#include "tst_preshaded.moc"
