// Guards design.md 5: the kernel that a plan names. Also guards what --explain derives from it: the cells
// that are asked, and how gradients are fetched.
#include "tests/unit/plan/asked.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestKernelKey : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void stepsThatRedoRaysAreNested();
  void aPlanNamesItsKernel_data();
  void aPlanNamesItsKernel();
  void explainSaysWhatTheKernelDoes_data();
  void explainSaysWhatTheKernelDoes() { compareEffect(); }
};

Q_DECLARE_METATYPE(Store)
Q_DECLARE_METATYPE(Sampling)

void TestKernelKey::aPlanNamesItsKernel_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<Store>("store");
  QTest::addColumn<Sampling>("sampling");
  QTest::addColumn<bool>("lit");
  QTest::addColumn<bool>("gradientOpacity");
  const auto row = [](const char* name, Store store, Sampling sampling, bool lit, bool gradientOpacity,
                      Change change) {
    QTest::newRow(name) << change << store << sampling << lit << gradientOpacity;
  };
  row("a level", Store::int16, Sampling::passages, true, false, [](Asked&) {});
  row("a level, unlit, with gradient opacity", Store::int16, Sampling::passages, false, true, [](Asked& a) {
    a.scene.shading.lit = false;
    a.scene.transferFunction.gradientOpacity = {{0, 0}, {50, 1}};
  });
  row("floats", Store::float32, Sampling::passages, true, false, [](Asked& a) { a.facts.integers = false; });
  row("steps, all of them", Store::int16, Sampling::dense, true, false, [](Asked& a) {
    a.options.step = 1;
    a.scene.transferFunction.points = {{-600, {1, 1, 1}, 0}, {1000, {1, 1, 1}, 1}};
  });
  row("steps of which few show", Store::int16, Sampling::visibleCells, true, false, [](Asked& a) {
    a.options.step = 1;
    a.scene.transferFunction.points = {{600, {1, 1, 1}, 0}, {1000, {1, 1, 1}, 1}};
  });
  row("unlit bytes", Store::byte1, Sampling::dense, false, false, [](Asked& a) {
    a.options.step = 1;
    a.options.precision = 8;
    a.scene.transferFunction.points = {{-600, {1, 1, 1}, 0}, {1000, {1, 1, 1}, 1}};
    a.scene.shading.lit = false;
  });
  row("lit bytes", Store::byte4, Sampling::dense, true, false, [](Asked& a) {
    a.options.step = 1;
    a.options.precision = 8;
    a.scene.transferFunction.points = {{-600, {1, 1, 1}, 0}, {1000, {1, 1, 1}, 1}};
  });
  row("planes that OpenGL fills", Store::plane, Sampling::dense, true, false,
      [](Asked& a) { a.options.resampler = Resampler::gl; });
  row("an extreme", Store::int16, Sampling::passages, false, false,
      [](Asked& a) { a.scene.mode = Mode::mip; });
}

void TestKernelKey::aPlanNamesItsKernel() {
  QFETCH(Change, change);
  QFETCH(Store, store);
  QFETCH(Sampling, sampling);
  QFETCH(bool, lit);
  QFETCH(bool, gradientOpacity);
  Asked asked;
  change(asked);
  const auto plan = makePlan(asked.scene, asked.facts, asked.options);
  QVERIFY2(plan, plan ? "" : plan.message().c_str());
  const KernelKey key = kernelKey(*plan);
  QCOMPARE(int(key.store), int(store));
  QCOMPARE(int(key.sampling), int(sampling));
  QCOMPARE(key.lit, lit);
  QCOMPARE(key.gradientOpacity, gradientOpacity);
}

void TestKernelKey::stepsThatRedoRaysAreNested() {
  const Asked asked;
  for (const double redoneAbove : {0.0, 0.1}) {
    const PilotFinding kept{.stepVoxels = 0.5, .kept = true, .redoneAbove = redoneAbove};
    const Plan plan = *makePlan(asked.scene, asked.facts, asked.options, kept);
    QCOMPARE(kernelKey(plan).sampling == Sampling::nested, redoneAbove > 0);
  }
}

void TestKernelKey::explainSaysWhatTheKernelDoes_data() {
  addRuleColumns();
  const auto row = addRuleRow;
  row("a level fetches gradients once a cell", "gradient fetch", "on once cell", [](Asked&) {});
  row("plain steps of 16 bits fetch all at once", "gradient fetch", "on every density load",
      [](Asked& a) { a.options.step = 1; });
  row("plain steps of bytes fetch all at once", "gradient fetch", "on every density load", [](Asked& a) {
    a.options.step = 1;
    a.options.precision = 8;
    a.options.opacityThreshold = 0.9;
  });
  row("few visible samples of 32 bits", "gradient fetch", "on opacity few", [](Asked& a) {
    a.options.step = 1;
    a.options.precision = 32;
    a.facts.blockRanges = std::make_shared<const BlockRanges>(
        blockRangesOf(4, {4, 1, 1}, {-1000, -1000, -1000, 0}, {-900, -900, -900, 1000}));
  });
  row("few visible samples of 32 bits in full", "gradient fetch", "on every density most", [](Asked& a) {
    a.options.step = 1;
    a.options.precision = 32;
    a.options.opacityThreshold = 0.9;
    a.options.full = true;
  });
  row("many visible samples of 32 bits", "gradient fetch", "on every density most", [](Asked& a) {
    a.options.step = 1;
    a.options.precision = 32;
  });
  row("slices of 16 bits fetch all", "gradient fetch", "on every density load",
      [](Asked& a) { a.options.method = Method::blend; });
  row("slices of 32 bits fetch all, few as are visible", "gradient fetch", "on every density most",
      [](Asked& a) {
        a.options.method = Method::blend;
        a.options.precision = 32;
        a.options.opacityThreshold = 0.9;
      });
  row("slices by OpenGL fetch all", "gradient fetch", "on every sample", [](Asked& a) {
    a.options.method = Method::blend;
    a.options.resampler = Resampler::gl;
  });
  row("unlit: nothing to fetch", "gradient fetch", "off no gradients",
      [](Asked& a) { a.scene.shading.lit = false; });
  row("a level asks each cell", "empty cells", "off rays cell", [](Asked&) {});
  row("blocks of which little shows", "empty cells", "on 33 % values cells", [](Asked& a) {
    a.options.step = 1;
    a.scene.transferFunction.points = {{600, {1, 1, 1}, 0}, {1000, {1, 1, 1}, 1}};
  });
  row("likewise of bytes", "empty cells", "on 33 % values cells", [](Asked& a) {
    a.options.step = 1;
    a.options.precision = 8;
    a.scene.transferFunction.points = {{600, {1, 1, 1}, 0}, {1000, {1, 1, 1}, 1}};
  });
  row("blocks of which most shows", "empty cells", "off 100 % values", [](Asked& a) {
    a.options.step = 1;
    a.scene.transferFunction.points = {{-600, {1, 1, 1}, 0}, {1000, {1, 1, 1}, 1}};
  });
  row("no block is empty", "empty cells", "off no empty blocks", [](Asked& a) {
    a.options.step = 1;
    a.scene.transferFunction.points[0].opacity = 0.1;
  });
  row("every block is empty", "empty cells", "off nothing shows", [](Asked& a) {
    a.options.step = 1;
    a.options.opacityThreshold = 0.9;
  });
  row("cells in full", "empty cells", "off full", [](Asked& a) {
    a.options.step = 1;
    a.options.full = true;
  });
  row("slices ask no cells", "empty cells", "off no kernel",
      [](Asked& a) { a.options.method = Method::blend; });
  row("a mean has no empty cells", "empty cells", "off projection",
      [](Asked& a) { a.scene.mode = Mode::average; });
}

VOLUMEN_TEST(TestKernelKey);
#include "tst_kernel_key.moc"
