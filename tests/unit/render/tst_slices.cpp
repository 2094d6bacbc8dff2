// Guards design.md 3 and 5: slices without hidden parts draw the same picture as whole slices.
#include <glm/geometric.hpp>
#include <random>

#include "tests/fixtures/picture_words.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/methods/caches.h"
#include "viewer/render/render.h"

namespace {

using namespace volumen;
using namespace volumen::tests;

constexpr int edge = 40;

// Returns matter of all values behind a wall with a hole.
VolumePtr wall() {
  std::mt19937 random(3);
  return volumeOf<std::int16_t>({edge, edge, edge}, {{1, 0, 0}, {0.1, 1, 0}, {0, 0.2, 1}}, [&](glm::dvec3 p) {
    const double value = double(random() % 1000);
    if (p.z < 6) return 0.0;
    return p.z < 12 && glm::distance(glm::dvec2(p), glm::dvec2(20, 18)) > 5.5 ? 1000.0 : value;
  });
}

struct Asked {
  Scene scene;
  RenderOptions options;
};

Asked askedOf() {
  Asked a;
  a.scene.transferFunction.points = {{300, {1, 0.5, 0.2}, 0}, {900, {1, 1, 1}, 0.9}};
  Camera camera;
  camera.direction = {0.1, 0.05, 1};
  camera.up = {0.1, 1, 0.2};
  camera.height = 50;
  a.scene.camera = camera;
  a.options.method = Method::blend;
  a.options.size = {61, 50};
  return a;
}

using Change = void (*)(Asked&);

}  // namespace

Q_DECLARE_METATYPE(Change)

class TestSlices : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsHiddenIsLeftOut_data();
  void whatIsHiddenIsLeftOut();
};

void TestSlices::whatIsHiddenIsLeftOut_data() {
  QTest::addColumn<Change>("change");
  const auto row = [](const char* name, Change change) { QTest::newRow(name) << change; };
  row("lit", [](Asked&) {});
  row("unlit", [](Asked& a) { a.scene.shading.lit = false; });
  row("in perspective", [](Asked& a) {
    a.scene.camera->projection = Projection::perspective;
    a.scene.camera->distance = 60;
  });
  row("gradient opacity", [](Asked& a) { a.scene.transferFunction.gradientOpacity = {{0, 0.7}, {200, 1}}; });
  row("steps of one voxel", [](Asked& a) { a.options.step = 1; });
  row("steps of many voxels", [](Asked& a) { a.options.step = 3; });
  row("8 bits a voxel", [](Asked& a) { a.options.precision = 8; });
  row("32 bits a voxel", [](Asked& a) { a.options.precision = 32; });
  row("a curve with a step", [](Asked& a) {
    a.scene.transferFunction.points[0].value = 500;
    a.scene.transferFunction.points[1].value = 501;
  });
  row("clipped", [](Asked& a) { a.scene.clip.planes = {{{1, 1, 1}, 10}}; });
  row("bright light", [](Asked& a) {
    a.scene.lights[0].intensity = 30;
    a.scene.transferFunction.points[1].opacity = 0.98;
  });
}

void TestSlices::whatIsHiddenIsLeftOut() {
  QFETCH(Change, change);
  Asked a = askedOf();
  change(a);
  RenderCaches caches(wall());
  Plan plan = *makePlan(a.scene, caches.facts(), a.options);
  QVERIFY(plan.stopTransmittance > 0);
  const Rendered lean = *render(plan, caches);
  a.options.threads = 3;
  a.options.full = true;
  QVERIFY(render(*makePlan(a.scene, caches.facts(), a.options), caches)->picture == lean.picture);
  plan.stopTransmittance = 0;
  const Rendered all = *render(plan, caches);
  const PictureError e = compare(lean.picture, all.picture);
  QVERIFY2(e.maximum <= 0.25, qPrintable(inWords(e)));
  QVERIFY2(double(lean.stats.composited) < 0.5 * double(all.stats.composited),
           qPrintable(QStringLiteral("%1 of %2").arg(lean.stats.composited).arg(all.stats.composited)));
}

VOLUMEN_TEST(TestSlices);
#include "tst_slices.moc"
