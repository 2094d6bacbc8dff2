// Guards the reflectance map (paper 2.2): its nodes against picture.md 5 in double precision, and the same
// bytes on every CPU target. Also guards that an edit rebuilds it exactly if it depends on what changed
// (design.md 1, 5).
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/cpu_targets.h"
#include "tests/unit/suite.h"
#include "viewer/kernels/make_reflectance_map.h"
#include "viewer/methods/caches.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

/// Returns a scene with lights on all sides, fixed to the patient, and a non-integer shininess.
Scene litScene(int lights) {
  Scene scene;
  scene.camera = Camera{};
  scene.shading.shininess = 20.5;
  scene.lights.clear();
  for (int n = 0; n < lights; ++n)
    scene.lights.push_back({.direction = {std::cos(1.7 * n), std::sin(1.7 * n), 0.5 * (n % 3) - 0.4},
                            .space = Space::patient,
                            .colour = {1, 0.5, n % 2},
                            .intensity = 1.0 / lights});
  return scene;
}

using Change = void (*)(Scene&);

}  // namespace

Q_DECLARE_METATYPE(Change)

class TestReflectanceMap : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void nodesAreShadesOfTheirDirections_data();
  void nodesAreShadesOfTheirDirections();
  void everyCpuTargetMakesTheSame();
  void anEditMakesItAnewOnlyWhereItMust_data();
  void anEditMakesItAnewOnlyWhereItMust();
};

void TestReflectanceMap::nodesAreShadesOfTheirDirections_data() {
  QTest::addColumn<int>("n");
  QTest::addColumn<int>("lights");
  QTest::addColumn<int>("sides");
  QTest::addColumn<bool>("nearest");
  QTest::addColumn<bool>("coloured");
  QTest::newRow("two nodes an edge: the corners of the cube") << 2 << 1 << 2 << false << true;
  QTest::newRow("fewer nodes than a vector holds") << 7 << 3 << 2 << false << true;
  QTest::newRow("one side") << 33 << 3 << 1 << false << true;
  QTest::newRow("middles of patches") << 32 << 16 << 2 << true << true;
  QTest::newRow("no light") << 16 << 0 << 2 << false << true;
  QTest::newRow("grey light: one D and S a node") << 33 << 3 << 2 << false << false;
  QTest::newRow("grey light, middles of patches") << 19 << 3 << 1 << true << false;
}

// Single precision has a dozen roundings of 6e-8 in a cosine. The highlight multiplies them by its power of
// 20.5 and the slopes at the edges of its light (10) and of the two sides (5). The sum is below 2e-5 of at
// most 1.
void TestReflectanceMap::nodesAreShadesOfTheirDirections() {
  QFETCH(int, n);
  QFETCH(int, lights);
  QFETCH(int, sides);
  QFETCH(bool, nearest);
  QFETCH(bool, coloured);
  Scene scene = litScene(lights);
  scene.shading.sides = sides;
  if (!coloured)
    for (Light& light : scene.lights) light.colour = glm::dvec3(light.colour.g);
  const Lighting lighting = makeLighting(scene, true, coloured);
  const ReflectanceMap map =
      makeReflectanceMap(lighting, n, nearest ? MapLookup::nearest : MapLookup::bilinear);
  double off = 0;
  for (int node = 0; node < 6 * n * n; ++node) {
    const int face = node / (n * n), axis = face / 2;
    const auto place = [&](int at) { return nearest ? (2.0 * at + 1) / n - 1 : 2.0 * at / (n - 1) - 1; };
    glm::dvec3 direction(0);
    direction[axis] = 1;
    direction[(axis + 1) % 3] = place(node % n);
    direction[(axis + 2) % 3] = place(node / n % n);
    const Shade shade = shadeOf(lighting, glm::normalize(face % 2 ? -direction : direction));
    const float* made = &map.nodes[std::size_t(node) * ReflectanceMap::floatsANode(coloured)];
    for (int c = 0; c < (coloured ? 3 : 1); ++c)
      off = std::max({off, std::abs(made[2 * c] - shade.d[c]), std::abs(made[2 * c + 1] - shade.s[c])});
  }
  QVERIFY2(off < 2e-5, qPrintable(QString::number(off)));
}

void TestReflectanceMap::everyCpuTargetMakesTheSame() {
  const Lighting lighting = makeLighting(litScene(5), true, true);
  const ReflectanceMap first = makeReflectanceMap(lighting, 21, MapLookup::bilinear);
  const auto seen = onEveryCpuTarget([&] {
    QVERIFY2(makeReflectanceMap(lighting, 21, MapLookup::bilinear).nodes == first.nodes, kernelTarget());
  });
  QVERIFY2(seen.size() >= 2, "this machine has one CPU target only, so nothing was compared");
}

void TestReflectanceMap::anEditMakesItAnewOnlyWhereItMust_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<bool>("anew");
  const auto row = [](const char* name, bool anew, Change change) { QTest::newRow(name) << change << anew; };
  row("the curve", false, [](Scene& s) { s.transferFunction.points[0].opacity = 0.1; });
  row("the clip box", false, [](Scene& s) { s.clip.boxHigh.x = 0.5; });
  row("the camera moves nearer", false, [](Scene& s) { s.camera->height = 40; });
  row("a light that is off", false, [](Scene& s) { s.lights.push_back({.on = false}); });
  row("the camera turns: highlights move", true, [](Scene& s) { s.camera->direction = {1, 1, 0}; });
  row("the camera turns, one side without highlights", false, [](Scene& s) {
    s.camera->direction = {1, 1, 0};
    s.shading.sides = 1;
    s.shading.specular = 0;
  });
  row("the camera turns, and lights with it", true, [](Scene& s) {
    s.camera->direction = {1, 1, 0};
    s.shading.sides = 1;
    s.shading.specular = 0;
    s.lights[0].space = Space::camera;
  });
  row("a light's direction", true, [](Scene& s) { s.lights[1].direction.z = 2; });
  row("a light's intensity", true, [](Scene& s) { s.lights[1].intensity = 2; });
  row("a light less", true, [](Scene& s) { s.lights.pop_back(); });
  row("the material", true, [](Scene& s) { s.shading.ambient = 0.3; });
}

// The scene before the edit has the edit's sides and specular, so that only the named part differs.
void TestReflectanceMap::anEditMakesItAnewOnlyWhereItMust() {
  QFETCH(Change, change);
  QFETCH(bool, anew);
  Scene after = litScene(3);
  change(after);
  Scene before = litScene(3);
  before.shading.sides = after.shading.sides;
  before.shading.specular = after.shading.specular;
  RenderCaches caches(*makePhantom("soft-sphere"));
  RenderOptions options;
  options.size = {8, 8};
  options.mapSize = 16;
  const auto mapOf = [&](const Scene& scene) {
    const auto drawn = render(*makePlan(scene, caches.facts(), options), caches);
    return drawn ? caches.impl().map->map.nodes.data() : nullptr;
  };
  const float* first = mapOf(before);
  QVERIFY(first);
  // A new map is built while the old one exists, so that its memory differs.
  QCOMPARE(mapOf(after) != first, anew);
}

VOLUMEN_TEST(TestReflectanceMap);
#include "tst_reflectance_map.moc"
