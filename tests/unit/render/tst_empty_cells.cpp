// Guards design.md 5, empty cells: plain steps with samples only in visible cells give the same bytes as with
// all samples. Covers all shaders, every CPU target and any number of threads.
#include "tests/fixtures/cpu_targets.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

class TestEmptyCells : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theSameBytes_data();
  void theSameBytes();
  void fewerSamples_data();
  void fewerSamples();
  void anotherGradientOperatorAsksTheSameCells();
};

namespace {

struct Case {
  Scene scene;
  RenderOptions options;
};
using Change = void (*)(Case&);

// Returns bone in a head as seen from below. Cells are fully, partly or not visible.
Case bone() {
  Case c;
  c.scene.transferFunction.points = {{200, {1, 0.9, 0.8}, 0}, {700, {1, 1, 0.9}, 0.4}};
  c.options.size = {61, 47};
  c.options.step = 0.7;
  return c;
}

// Draws the plan, but `skipCells` decides instead of the rules whether cells are asked.
Rendered drawn(const Case& c, RenderCaches& caches, bool skipCells) {
  Plan plan = *makePlan(c.scene, caches.facts(), c.options);
  if (!plan.skipBlocks || plan.cellByCell) qFatal("the case asks no cells");
  plan.skipCells = skipCells;
  return *render(plan, caches);
}

}  // namespace
Q_DECLARE_METATYPE(Change)

void TestEmptyCells::theSameBytes_data() {
  QTest::addColumn<Change>("change");
  const auto row = [](const char* name, Change change) { QTest::newRow(name) << change; };
  row("one light, direct", [](Case&) {});
  row("unlit", [](Case& c) { c.scene.shading.lit = false; });
  row("8 bits", [](Case& c) { c.options.precision = 8; });
  row("8 bits, unlit", [](Case& c) {
    c.options.precision = 8;
    c.scene.shading.lit = false;
  });
  row("two lights, one of them red, map", [](Case& c) {
    c.scene.lights.resize(2);
    c.scene.lights[1].colour = {1, 0, 0};
    c.options.shader = Shader::map;
  });
  row("gradient opacity", [](Case& c) { c.scene.transferFunction.gradientOpacity = {{0, 0.1}, {50, 1}}; });
  row("local viewer in perspective", [](Case& c) {
    c.scene.shading.localViewer = true;
    c.scene.camera = Camera{};
    c.scene.camera->projection = Projection::perspective;
    c.scene.camera->direction = {1, 2, -0.5};
    c.scene.camera->distance = 400;
  });
  row("opaque: rays end within a batch", [](Case& c) {
    c.scene.transferFunction.points = {{200, {1, 1, 1}, 0}, {210, {1, 1, 1}, 1}};
  });
  row("faint: every ray goes to its end", [](Case& c) {
    c.scene.transferFunction.points[1].opacity = 0.002;
    c.options.stopAt = 0;
  });
  row("bands of a curve", [](Case& c) {
    c.scene.transferFunction.points = {{-200, {1, 0, 0}, 0},
                                       {-100, {1, 0, 0}, 0.2},
                                       {0, {1, 0, 0}, 0},
                                       {600, {1, 1, 0.5}, 0},
                                       {800, {1, 1, 0.5}, 0.9}};
  });
  row("clipped askew", [](Case& c) {
    c.scene.clip.boxLow.x = 0.31;
    c.scene.clip.planes.push_back({{0.3, -0.5, 0.8}, 0});
  });
  row("rays close together, askew", [](Case& c) {
    c.scene.camera = Camera{};
    c.scene.camera->direction = {-0.6, 0.7, 0.4};
    c.scene.camera->height = 230;
    c.options.size = {150, 122};
    c.options.step = 0.23;
  });
  row("rays close together, in perspective from near by", [](Case& c) {
    c.scene.camera = Camera{};
    c.scene.camera->projection = Projection::perspective;
    c.scene.camera->direction = {0.2, 1, 0.7};
    c.scene.camera->distance = 160;
    c.options.size = {150, 122};
  });
  row("rays far apart", [](Case& c) { c.options.size = {9, 7}; });
  row("steps of five voxels", [](Case& c) { c.options.step = 5; });
}

void TestEmptyCells::theSameBytes() {
  QFETCH(Change, change);
  Case c = bone();
  change(c);
  RenderCaches caches(*makePhantom("ct-head:40"));
  const Picture whole = drawn(c, caches, false).picture;
  onEveryCpuTarget([&] {
    for (int threads : {1, 3}) {
      c.options.threads = threads;
      QVERIFY2(drawn(c, caches, true).picture == whole, kernelTarget());
    }
  });
}

void TestEmptyCells::fewerSamples_data() {
  QTest::addColumn<int>("bits");
  for (int bits : {8, 16}) QTest::addRow("%d bits", bits) << bits;
}

void TestEmptyCells::fewerSamples() {
  QFETCH(int, bits);
  Case c = bone();
  c.options.precision = bits;
  RenderCaches caches(*makePhantom("ct-head:40"));
  const RenderStats all = drawn(c, caches, false).stats, some = drawn(c, caches, true).stats;
  QCOMPARE(some.composited, all.composited);
  QVERIFY2(2 * some.resampled < all.resampled,
           qPrintable(QStringLiteral("%1 of %2").arg(some.resampled).arg(all.resampled)));
}

// Density bytes are interleaved with those of the gradients, which are rebuilt.
void TestEmptyCells::anotherGradientOperatorAsksTheSameCells() {
  Case c = bone();
  c.options.precision = 8;
  const VolumePtr head = *makePhantom("ct-head:40");
  RenderCaches caches(head);
  const Picture first = drawn(c, caches, true).picture;
  c.options.gradient = GradientOperator::central;
  RenderCaches fresh(head);
  const Picture second = drawn(c, caches, true).picture;
  QVERIFY(second == drawn(c, fresh, true).picture);
  QVERIFY(second != first);
}

VOLUMEN_TEST(TestEmptyCells);
#include "tst_empty_cells.moc"
