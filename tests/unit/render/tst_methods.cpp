// Guards DESIGN 3 (every method against the reference), SCENE 9 and DESIGN 2 (determinism).
#include <cmath>
#include <map>

#include "tests/fixtures/brute_force.h"
#include "tests/unit/render/method_cases.h"
#include "tests/unit/suite.h"
#include "viewer/render/reference.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr glm::ivec2 size{36, 30};
constexpr double step = 0.5;

/// What a scene is compared with.
struct Truth {
  Picture reference;
  PictureError rule;  ///< of the midpoint rule in double precision
};

const Truth& truthOf(int scene) {
  static std::map<int, Truth> all;
  const auto [entry, isNew] = all.try_emplace(scene);
  if (isNew) {
    const Scene& s = methodScenes()[scene].scene;
    const VolumePtr volume = wavyVolume();
    entry->second.reference = *renderReference(completed(s, *volume, size), *volume, size);
    entry->second.rule = compare(bruteForce(s, *volume, size, step), entry->second.reference);
  }
  return entry->second;
}

Result<Rendered> draw(const Scene& scene, RenderOptions options) {
  static RenderCaches caches(wavyVolume());
  options.size = size;
  options.step = step;
  const auto plan = makePlan(scene, caches.facts(), options);
  if (!plan) return plan.error();
  return render(*plan, caches);
}

/// No ray through the volume has more samples: its diagonal is shorter than 39 voxels.
constexpr int mostSlices = int(39 / step) + 1;

/// What a frame buffer adds to the midpoint rule (/255): half a level a slice at most.
double roundingOf(const RenderOptions& options) {
  switch (options.blending.value_or(Blending::floats)) {
    case Blending::bits8:
      return 0.5 * mostSlices;
    case Blending::bits16:
      return 0.5 * mostSlices * 255 / 65535;
    case Blending::floats:
      break;
  }
  return 0;
}

QString inWords(const PictureError& e) {
  return QStringLiteral("RMSE %1, 99th percentile %2, maximum %3 of 1/255")
      .arg(e.rmse)
      .arg(e.percentile99)
      .arg(e.maximum);
}

}  // namespace

class TestMethods : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void keepsItsError_data() { addRows(true); }
  void keepsItsError();
  void projectsAsPlanesDo_data();
  void projectsAsPlanesDo();
  void threadsAndFullChangeNoByte_data() { addRows(false); }
  void threadsAndFullChangeNoByte();
  void aFrameBufferOf8BitsHoldsBytes();

 private:
  static void addRows(bool gl);
  QString whyNone_;  ///< no OpenGL could be had
};

void TestMethods::initTestCase() {
  const auto context = makeEglContext();
  if (!context) whyNone_ = QString::fromStdString("no OpenGL without a display here: " + context.message());
}

void TestMethods::addRows(bool gl) {
  QTest::addColumn<int>("method");
  QTest::addColumn<int>("scene");
  for (std::size_t m = 0; m < methodCases().size(); ++m)
    for (std::size_t s = 0; s < methodScenes().size(); ++s) {
      if (methodCases()[m].needsGl && !gl) continue;
      QTest::addRow("%s: %s", methodCases()[m].name.c_str(), methodScenes()[s].name.c_str())
          << int(m) << int(s);
    }
}

#define NEED_METHOD(c)                         \
  QFETCH(int, method);                         \
  const MethodCase& c = methodCases()[method]; \
  if (c.needsGl && !whyNone_.isEmpty()) QSKIP(qPrintable(whyNone_))

// DESIGN 2: errors at most those of the midpoint rule in double precision, plus what the stored precision
// explains: 5 % (the same samples, rounded), and what lies behind the transmittance at which rays end; and
// plus what the method says of itself.
void TestMethods::keepsItsError() {
  NEED_METHOD(c);
  QFETCH(int, scene);
  const auto done = draw(methodScenes()[scene].scene, c.options);
  QVERIFY2(done.ok(), done.ok() ? "" : done.message().c_str());
  const PictureError& rule = truthOf(scene).rule;
  const PictureError e = compare(done->picture, truthOf(scene).reference);
  const double own = roundingOf(c.options);
  QVERIFY2(e.rmse <= 1.05 * rule.rmse + 0.01 + own && e.percentile99 <= 1.05 * rule.percentile99 + 0.06 + own,
           qPrintable(inWords(e) + QStringLiteral("; the rule: ") + inWords(rule)));
}

void TestMethods::projectsAsPlanesDo_data() {
  QTest::addColumn<int>("method");
  QTest::addColumn<int>("mode");
  for (std::size_t m = 0; m < methodCases().size(); ++m)
    for (Mode mode : {Mode::mip, Mode::minip, Mode::average}) {
      const char* name = mode == Mode::mip ? "mip" : mode == Mode::minip ? "minip" : "average";
      QTest::addRow("%s: %s", methodCases()[m].name.c_str(), name) << int(m) << int(mode);
    }
}

// Extremes and means of the same samples: 0.01/255 for sums in another order, and half a level of the frame
// buffer. What a method cannot project it refuses in a sentence that names it.
void TestMethods::projectsAsPlanesDo() {
  NEED_METHOD(c);
  QFETCH(int, mode);
  Scene scene = methodScenes().front().scene;
  scene.mode = Mode(mode);
  scene.window = Window{500, 900};
  const auto done = draw(scene, c.options);
  if (!done.ok()) {
    QVERIFY2(done.message().find("--mode") != std::string::npos, done.message().c_str());
    QVERIFY(c.options.blending.has_value() && Mode(mode) == Mode::average);
    return;
  }
  const PictureError e = compare(done->picture, draw(scene, {})->picture);
  const bool bytes = c.options.blending == Blending::bits8;
  QVERIFY2(e.maximum <= (bytes ? 0.51 : 0.01), qPrintable(inWords(e)));
}

void TestMethods::threadsAndFullChangeNoByte() {
  NEED_METHOD(c);
  QFETCH(int, scene);
  RenderOptions options = c.options;
  options.threads = 1;
  const Scene& s = methodScenes()[scene].scene;
  const Picture one = draw(s, options)->picture;
  for (int threads : {2, 7, 16}) {
    options.threads = threads;
    QVERIFY2(draw(s, options)->picture == one, qPrintable(QStringLiteral("%1 threads").arg(threads)));
  }
  options.full = true;
  QVERIFY2(draw(s, options)->picture == one, "full");
}

void TestMethods::aFrameBufferOf8BitsHoldsBytes() {
  RenderOptions options;
  options.method = Method::blend;
  options.blending = Blending::bits8;
  const Scene& scene = methodScenes().front().scene;
  const Picture coarse = draw(scene, options)->picture;
  for (float x : coarse.rgba) QCOMPARE(255 * x, std::round(255 * x));
  options.blending = Blending::floats;
  QVERIFY(compare(draw(scene, options)->picture, coarse).rmse > 0.2);
}

VOLUMEN_TEST(TestMethods);
#include "tst_methods.moc"
