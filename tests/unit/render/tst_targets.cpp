// Guards design.md 2 (determinism): the same bytes on every CPU target that the kernels are compiled for and
// this machine has.
#include <optional>

#include "tests/fixtures/cpu_targets.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/render/render.h"
#include "viewer/segment/occupancy.h"
#include "viewer/segment/range.h"

using namespace volumen;
using namespace volumen::tests;

class TestTargets : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyCpuTargetGivesTheSameBytes_data();
  void everyCpuTargetGivesTheSameBytes();
};

namespace {
struct Case {
  Scene scene;
  RenderOptions options;
  std::optional<PilotFinding> pilot{};
};
using Change = void (*)(Case&);

VolumePtr smallHead() { return *makePhantom("ct-head:40"); }

// Adds soft tissue and the bone that it encloses.
void addSegments(Scene& scene, double softOpacity, double boneOpacity) {
  const VolumePtr head = smallHead();
  const auto fieldOf = [&](ValueRange range) {
    return std::make_shared<const OccupancyField>(occupancyOf(voxelsInRange(*head, range), surfaceSigma));
  };
  scene.segments = {{fieldOf({-100, 200}), {0.9, 0.4, 0.3}, softOpacity},
                    {fieldOf({300, 3000}), {0.9, 0.9, 0.7}, boneOpacity}};
}
}  // namespace
Q_DECLARE_METATYPE(Change)

void TestTargets::everyCpuTargetGivesTheSameBytes_data() {
  QTest::addColumn<Change>("change");
  const auto row = [](const char* name, Change change) { QTest::newRow(name) << change; };
  row("one light, direct", [](Case&) {});
  row("32 bits", [](Case& c) { c.options.precision = 32; });
  row("8 bits", [](Case& c) { c.options.precision = 8; });
  row("8 bits, unlit", [](Case& c) {
    c.options.precision = 8;
    c.scene.shading.lit = false;
  });
  row("8 bits, a level", [](Case& c) {
    c.options.precision = 8;
    c.options.step.reset();
  });
  row("8 bits, map, gradient opacity", [](Case& c) {
    c.options.precision = 8;
    c.options.shader = Shader::map;
    c.scene.transferFunction.gradientOpacity = {{0, 0.1}, {50, 1}};
  });
  row("8 bits, table, Zucker and Hummel", [](Case& c) {
    c.options.precision = 8;
    c.options.shader = Shader::table;
    c.options.gradient = GradientOperator::zuckerHummel;
  });
  row("8 bits, mip", [](Case& c) {
    c.options.precision = 8;
    c.scene.mode = Mode::mip;
  });
  row("8 bits, blend", [](Case& c) {
    c.options.precision = 8;
    c.options.method = Method::blend;
  });
  row("unlit", [](Case& c) { c.scene.shading.lit = false; });
  row("three lights, map", [](Case& c) {
    c.scene.lights = {Light{}, Light{.direction = {1, 0, 0}, .colour = {1, 0, 0}},
                      Light{.direction = {0, -1, 1}}};
    c.options.shader = Shader::map;
  });
  row("map, nearest", [](Case& c) { c.options.mapLookup = MapLookup::nearest; });
  row("table", [](Case& c) { c.options.shader = Shader::table; });
  row("blend", [](Case& c) { c.options.method = Method::blend; });
  row("blend, 32 bits into 8 bits, table", [](Case& c) {
    c.options.method = Method::blend;
    c.options.blending = Blending::bits8;
    c.options.precision = 32;
    c.options.shader = Shader::table;
  });
  row("blend, local viewer, gradient opacity", [](Case& c) {
    c.options.method = Method::blend;
    c.scene.shading.localViewer = true;
    c.scene.transferFunction.gradientOpacity = {{0, 0.1}, {50, 1}};
  });
  row("preshaded", [](Case& c) { c.options.method = Method::preshaded; });
  row("preshaded, 32 bits, map", [](Case& c) {
    c.options.method = Method::preshaded;
    c.options.precision = 32;
    c.options.shader = Shader::map;
  });
  row("local viewer in perspective", [](Case& c) {
    c.scene.shading.localViewer = true;
    c.scene.camera = Camera{.target = glm::dvec3(0),
                            .direction = {1, 2, -0.5},
                            .projection = Projection::perspective,
                            .distance = 150};
  });
  row("gradient opacity", [](Case& c) { c.scene.transferFunction.gradientOpacity = {{0, 0.1}, {50, 1}}; });
  row("a curve of many points", [](Case& c) {
    c.scene.transferFunction.points.clear();
    for (int n = 0; n < 40; ++n)
      c.scene.transferFunction.points.push_back(
          {float(-900 + 60 * n), {n % 2 * 1.0, n % 3 / 2.0, 1}, n % 4 / 30.0});
  });
  row("mip", [](Case& c) { c.scene.mode = Mode::mip; });
  row("average", [](Case& c) { c.scene.mode = Mode::average; });
  row("mip, a level", [](Case& c) {
    c.scene.mode = Mode::mip;
    c.options.step.reset();
  });
  row("minip, a level, 32 bits", [](Case& c) {
    c.scene.mode = Mode::minip;
    c.options.step.reset();
    c.options.precision = 32;
  });
  row("average, a level", [](Case& c) {
    c.scene.mode = Mode::average;
    c.options.step.reset();
  });
  row("nested steps, some redone", [](Case& c) {
    c.options.step.reset();
    c.pilot = PilotFinding{.stepVoxels = 0.6, .kept = true, .redoneAbove = 0.05, .errorScale = 1};
  });
  row("nothing left out", [](Case& c) { c.options.full = true; });
  row("an opaque segment", [](Case& c) { addSegments(c.scene, 0, 1); });
  row("segments, a level", [](Case& c) {
    addSegments(c.scene, 0.3, 1);
    c.options.step.reset();
  });
  row("translucent segments, a level, unlit, in perspective", [](Case& c) {
    addSegments(c.scene, 0.3, 0.6);
    c.options.step.reset();
    c.scene.shading.lit = false;
    c.scene.camera = Camera{.target = glm::dvec3(0),
                            .direction = {1, 2, -0.5},
                            .projection = Projection::perspective,
                            .distance = 150};
  });
}

void TestTargets::everyCpuTargetGivesTheSameBytes() {
  QFETCH(Change, change);
  Case c;
  c.options.size = {61, 47};
  c.options.step = 0.7;
  change(c);
  const VolumePtr head = smallHead();
  std::optional<Picture> first;
  QStringList others;
  const auto seen = onEveryCpuTarget([&] {
    RenderCaches caches(head);  // fresh caches, as the Sobel pass has kernels of its own
    const Picture picture = render(*makePlan(c.scene, caches.facts(), c.options, c.pilot), caches)->picture;
    if (!first) first = picture;
    if (picture != *first) others << QString::fromLatin1(kernelTarget());
  });
  QVERIFY2(others.isEmpty(), qPrintable(others.join(QStringLiteral(", "))));
  QVERIFY2(seen.size() >= 2, "this machine has one CPU target only, so nothing was compared");
}

VOLUMEN_TEST(TestTargets);
#include "tst_targets.moc"
