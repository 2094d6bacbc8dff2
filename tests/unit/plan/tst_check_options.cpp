// Guards design.md 5: impossible options are refused by name.
#include <limits>

#include "tests/unit/plan/asked.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestCheckOptions : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void optionsThatCannotBeAreRefused_data();
  void optionsThatCannotBeAreRefused();
};

void TestCheckOptions::optionsThatCannotBeAreRefused_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QString>("named");
  const auto row = [](const char* name, const char* named, Change change) {
    QTest::newRow(name) << change << QString::fromLatin1(named);
  };
  row("a map for a local viewer", "--shader map", [](Asked& a) {
    a.options.shader = Shader::map;
    a.scene.shading.localViewer = true;
  });
  row("a table for a local viewer", "--shader table", [](Asked& a) {
    a.options.shader = Shader::table;
    a.scene.shading.localViewer = true;
  });
  row("a map's size without a map", "--map-size", [](Asked& a) {
    a.options.shader = Shader::phong;
    a.options.mapSize = 64;
  });
  row("a map's lookup without a map", "--map-lookup", [](Asked& a) {
    a.options.shader = Shader::table;
    a.options.mapLookup = MapLookup::nearest;
  });
  row("a frame buffer without blend", "--blending", [](Asked& a) { a.options.blending = Blending::bits16; });
  row("a GPU without OpenGL", "--resampler cpu", [](Asked& a) {
    a.options.method = Method::gpu;
    a.options.resampler = Resampler::cpu;
  });
  row("colours projected", "--method preshaded", [](Asked& a) {
    a.options.method = Method::preshaded;
    a.scene.mode = Mode::mip;
  });
  row("a blend by OpenGL that stops", "--stop-at", [](Asked& a) {
    a.options.method = Method::blend;
    a.options.resampler = Resampler::gl;
    a.options.stopAt = 0.1;
  });
  row("a blend in 16 bits that stops", "--stop-at", [](Asked& a) {
    a.options.method = Method::blend;
    a.options.blending = Blending::bits16;
    a.options.stopAt = 0.1;
  });
  row("a mean in 8 bits", "--blending 8", [](Asked& a) {
    a.options.method = Method::blend;
    a.options.blending = Blending::bits8;
    a.scene.mode = Mode::average;
  });
  row("no pixels", "--size", [](Asked& a) { a.options.size = {0, 5}; });
  row("no step", "--step", [](Asked& a) { a.options.step = 0; });
  row("a NaN step", "--step", [](Asked& a) { a.options.step = std::numeric_limits<double>::quiet_NaN(); });
  row("12 bits", "--precision", [](Asked& a) { a.options.precision = 12; });
  row("bytes by OpenGL", "--precision 8", [](Asked& a) {
    a.options.precision = 8;
    a.options.resampler = Resampler::gl;
  });
  row("bytes on the GPU", "--precision 8", [](Asked& a) {
    a.options.precision = 8;
    a.options.method = Method::gpu;
  });
  row("bytes, preshaded", "--precision 8", [](Asked& a) {
    a.options.precision = 8;
    a.options.method = Method::preshaded;
  });
  row("the reference in bytes", "--precision 8", [](Asked& a) {
    a.options.precision = 8;
    a.options.method = Method::reference;
  });
  row("no tolerance", "--tolerance must", [](Asked& a) { a.options.tolerance = 0; });
  row("a NaN tolerance", "--tolerance must",
      [](Asked& a) { a.options.tolerance = std::numeric_limits<double>::quiet_NaN(); });
  row("a tolerance of plain steps", "--tolerance goes", [](Asked& a) {
    a.options.tolerance = 0.1;
    a.options.step = 1;
  });
  row("a tolerance of slices", "--tolerance goes", [](Asked& a) {
    a.options.tolerance = 0.1;
    a.options.method = Method::blend;
  });
  row("a tolerance of a projection", "--tolerance goes", [](Asked& a) {
    a.options.tolerance = 0.1;
    a.scene.mode = Mode::mip;
  });
  row("a tolerance by OpenGL", "--tolerance goes", [](Asked& a) {
    a.options.tolerance = 0.1;
    a.options.resampler = Resampler::gl;
  });
  row("a tolerance of 5-bit light", "--tolerance goes", [](Asked& a) {
    a.options.tolerance = 0.1;
    a.options.shader = Shader::table;
  });
  row("never transparent enough", "--stop-at", [](Asked& a) { a.options.stopAt = 1; });
  row("nothing opaque enough", "--opacity-threshold", [](Asked& a) { a.options.opacityThreshold = 1; });
  row("a NaN threshold", "--opacity-threshold",
      [](Asked& a) { a.options.opacityThreshold = std::numeric_limits<double>::quiet_NaN(); });
  row("a table of one entry", "--curve-table", [](Asked& a) { a.options.curveTable = 1; });
  row("a reference by another gradient", "--stop-at, --opacity-threshold", [](Asked& a) {
    a.options.method = Method::reference;
    a.options.gradient = GradientOperator::central;
  });
  row("a map of one node", "--map-size", [](Asked& a) { a.options.mapSize = 1; });
}

void TestCheckOptions::optionsThatCannotBeAreRefused() {
  QFETCH(Change, change);
  QFETCH(QString, named);
  Asked asked;
  change(asked);
  const auto plan = makePlan(asked.scene, asked.facts, asked.options);
  QVERIFY(!plan.ok());
  QVERIFY(QString::fromStdString(plan.message()).startsWith(named));
}

VOLUMEN_TEST(TestCheckOptions);
#include "tst_check_options.moc"
