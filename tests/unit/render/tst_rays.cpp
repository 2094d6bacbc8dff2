// Guards picture.md 6, 7, 9 for the rays of the kernels: each begins, steps and ends like the reference's.
// The bytes are the same on every CPU target.
#include <cstring>

#include "tests/fixtures/cpu_targets.h"
#include "tests/unit/render/reference_fixture.h"
#include "tests/unit/suite.h"
#include "viewer/kernels/ray_generator.h"
#include "viewer/reference/ray.h"

using namespace volumen;
using namespace volumen::tests;

class TestRays : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyRayIsTheReferences_data();
  void everyRayIsTheReferences();
  void theSameBytesOnEveryCpuTarget();
};

namespace {

constexpr glm::ivec2 size(23, 17);  // tiles extend beyond the right and lower edges
constexpr double stepVoxels = 0.7;

struct Case {
  VoxelGeometry geometry = gridAround({40, 30, 20}, {{0.8, 0, 0}, {0, 0.8, 0}, {0.3, 0, 2}});
  Scene scene = plainScene(0.1);
};
using Change = void (*)(Case&);

void look(Case& c, glm::dvec3 direction, glm::dvec3 target = glm::dvec3(0)) {
  c.scene.camera = plainScene(0.1, direction).camera;
  c.scene.camera->target = target;
  c.scene.camera->height = 30;
}

void lookFrom(Case& c, double distance, double fov) {
  look(c, {0.3, 1, -0.2});
  c.scene.camera->projection = Projection::perspective;
  c.scene.camera->distance = distance;
  c.scene.camera->fov = fov;
}

// Makes rays in a row that held more rays before.
RayRow raysOf(const Case& c) {
  RayRow rays;
  const Case other;
  RayGenerator(other.scene, other.geometry, {64, 64}, 0.2, true).makeBlock(0, 0, rays);
  RayGenerator(c.scene, c.geometry, size, stepVoxels, true).makeBlock(0, 0, rays);
  return rays;
}

glm::dvec3 of(const std::vector<float>& x, const std::vector<float>& y, const std::vector<float>& z,
              std::size_t n) {
  return {x[n], y[n], z[n]};
}

// Positions are floats of up to 40 voxels, and steps add up to as much.
constexpr double positionBound = 2e-5;

}  // namespace

void TestRays::everyRayIsTheReferences_data() {
  QTest::addColumn<Change>("change");
  const auto row = [](const char* name, Change change) { QTest::newRow(name) << change; };
  row("parallel, aslant", [](Case& c) { look(c, {0.3, 1, -0.2}); });
  row("parallel, along an axis", [](Case& c) { look(c, {0, 1, 0}); });
  row("parallel, rays in the faces", [](Case& c) {
    c.geometry = gridAround({23, 40, 17});
    look(c, {0, 1, 0}, {0.5, 0, 0.5});
    c.scene.camera->height = 17;
  });
  row("beside the volume", [](Case& c) { look(c, {0.3, 1, -0.2}, {30, 0, 0}); });
  row("perspective", [](Case& c) { lookFrom(c, 120, 20); });
  row("perspective, local viewer", [](Case& c) {
    lookFrom(c, 120, 20);
    c.scene.shading.localViewer = true;
  });
  row("eye inside", [](Case& c) { lookFrom(c, 3, 60); });
  row("an eye 10 km away", [](Case& c) { lookFrom(c, 1e7, 2e-4); });
  row("clip box", [](Case& c) {
    look(c, {0.3, 1, -0.2});
    c.scene.clip = {{0.2, 0.1, 0.3}, {0.9, 0.6, 0.8}, {}};
  });
  row("clip planes", [](Case& c) {
    lookFrom(c, 120, 20);
    c.scene.clip.planes = {{{1, 2, 3}, 4}, {{-1, 0, 0.5}, 6}};
  });
  row("along a clip plane", [](Case& c) {
    look(c, {0, 1, 0});
    c.scene.clip.planes = {{{0.5, 0, 0.5}, 1}};
  });
  row("one slice", [](Case& c) {
    c.geometry = gridAround({40, 30, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 3}});
    look(c, {0, 0.1, 1});
  });
}

void TestRays::everyRayIsTheReferences() {
  QFETCH(Change, change);
  Case c;
  change(c);
  const RayRow rays = raysOf(c);
  const reference::RayMaker maker(*c.scene.camera, c.geometry, size);
  const double spacing = c.geometry.spacing().y;
  std::vector<std::uint8_t> seen(std::size_t(size.x) * size.y);
  double first = std::numeric_limits<double>::max();
  std::vector<double> aheads(rays.pixel.size());
  for (std::size_t n = 0; n < rays.pixel.size(); ++n) {
    const int pixel = rays.pixel[n];
    if (rays.steps[n] == 0) QCOMPARE(rays.lastMiddle[n], -1.0f);
    if (pixel < 0) {
      QCOMPARE(rays.steps[n], 0);
      continue;
    }
    ++seen[pixel];
    const reference::Ray ray = maker.through(pixel % size.x, pixel / size.x);
    const reference::Interval inside = reference::visibleInterval(ray, c.geometry, c.scene.clip);
    const glm::dvec3 viewer = of(rays.viewerX, rays.viewerY, rays.viewerZ, n);
    const bool local = c.scene.shading.localViewer;
    QVERIFY(glm::length(viewer + (local ? ray.direction : maker.axes().direction)) < 1e-6);
    if (inside.empty()) {
      QCOMPARE(rays.steps[n], 0);
      continue;
    }
    QVERIFY(rays.steps[n] > 0);
    const glm::dvec3 move = of(rays.moveX, rays.moveY, rays.moveZ, n),
                     start = of(rays.startX, rays.startY, rays.startZ, n);
    const double before = rays.steps[n] - 1, last = rays.lastStepMm[n] / rays.stepMm[n];
    QVERIFY(std::abs(glm::length(move) - stepVoxels) < 1e-6);
    QVERIFY(last > 0 && last < 1 + 2e-6);
    QVERIFY(std::abs(rays.lastMiddle[n] - (before + last / 2)) < 1e-5);
    QVERIFY(std::abs(before * rays.stepMm[n] + rays.lastStepMm[n] - (inside.t1 - inside.t0)) <
            positionBound * spacing);
    const auto at = [&](double t) { return c.geometry.voxelFromPatient(ray.origin + t * ray.direction); };
    QVERIFY(glm::length(start - at(inside.t0)) < positionBound);
    QVERIFY(glm::length(start + (before + last) * move - at(inside.t1)) < positionBound);
    aheads[n] = inside.t0 / rays.stepMm[n];
    first = std::min(first, aheads[n]);
  }
  for (std::uint8_t times : seen) QCOMPARE(int(times), 1);
  // `ahead` counts whole steps. Each ray is thus within half a step of a common depth.
  for (std::size_t n = 0; n < rays.pixel.size(); ++n)
    if (rays.steps[n] > 0) QVERIFY(std::abs(first + rays.ahead[n] - aheads[n]) < 0.5 + 1e-3);
}

void TestRays::theSameBytesOnEveryCpuTarget() {
  Case c;
  lookFrom(c, 120, 20);
  c.scene.clip.planes = {{{1, 2, 3}, 4}};
  const RayRow expected = raysOf(c);
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  onEveryCpuTarget([&] {
    const RayRow rays = raysOf(c);
    QVERIFY(same(rays.steps, expected.steps));
    for (const auto values :
         {&RayRow::startX, &RayRow::startY, &RayRow::startZ, &RayRow::moveX, &RayRow::moveY, &RayRow::moveZ,
          &RayRow::ahead, &RayRow::lastMiddle, &RayRow::stepMm, &RayRow::lastStepMm})
      QVERIFY(same(rays.*values, expected.*values));
  });
}

VOLUMEN_TEST(TestRays);
#include "tst_rays.moc"
