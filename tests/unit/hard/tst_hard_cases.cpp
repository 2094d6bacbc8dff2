// Guards design.md 2 (finite, levels, determinism) and picture.md 2 to 9 in numerically hard cases: every
// method on every case. With VOLUMEN_ALL_TARGETS set, every case, also by OpenGL, is compared on every CPU
// target. With VOLUMEN_ALL_METHODS set, every method draws every case at every level.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "tests/fixtures/brute_force.h"
#include "tests/fixtures/cpu_targets.h"
#include "tests/fixtures/need_gl.h"
#include "tests/unit/hard/bounds_of_steps.h"
#include "tests/unit/hard/hard_cases.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/suite.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

bool allTargetsWanted() { return qEnvironmentVariableIsSet("VOLUMEN_ALL_TARGETS"); }

}  // namespace

class TestHardCases : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void scenesAreValid_data() {
    addRows([](const HardCase&) { return true; });
  }
  void scenesAreValid();
  void levelsKeepTheirPromises_data() {
    addRows([](const HardCase&) { return true; });
  }
  void levelsKeepTheirPromises();
  void stepsKeepToTheClosedForm_data() {
    addRows([](const HardCase& c) { return c.uniform; });
  }
  void stepsKeepToTheClosedForm();
  void referenceIsTheLimit_data() {
    addRows([](const HardCase&) { return true; });
  }
  void referenceIsTheLimit();
  void everyCpuTargetGivesTheSameBytes_data() {
    addRows([](const HardCase& c) { return c.delicate || allTargetsWanted(); });
  }
  void everyCpuTargetGivesTheSameBytes();
  void openGlIsHere();

 private:
  static void addRows(bool (*take)(const HardCase&));
  RenderCaches& cachesOf(const VolumePtr& volume);
  std::map<const Volume*, RenderCaches> caches_;
};

namespace {

bool allMethodsWanted() { return qEnvironmentVariableIsSet("VOLUMEN_ALL_METHODS"); }

/// Returns whether levels above standard are drawn. They are not without a promise, and with OpenGL only for
/// delicate cases.
bool isWorthFineSteps(const DrawWay& way, const HardCase& c) {
  return way.promised && (!way.usesOpenGl() || c.delicate || allMethodsWanted());
}

/// Returns whether levels integrate the curve between samples. Other ways take small plain steps.
bool integrates(const DrawWay& way) { return way.options.method == Method::planes && !way.usesOpenGl(); }

/// Slow ways draw every hundredth case.
bool isTried(const DrawWay& way, const HardCase& c, int index) {
  if (way.mayRefuse(c.scene, *c.volume)) return false;
  return !way.slow || index % 100 == 0 || allMethodsWanted();
}

/// Returns the largest |picture - closed form| / allowed, which is at most 1 if the bound is kept. Allowed is
/// `bound255` / 255, but at most 1 % of the expected opacity.
double overTheBound(const HardCase& c, const Picture& picture, double bound255) {
  double worst = 0;
  for (int y = 0; y < c.size.y; ++y)
    for (int x = 0; x < c.size.x; ++x) {
      const double mm = lengthOfRay(c.scene, c.volume->geometry(), c.size, x, y);
      const glm::dvec4 expected = mm > 0 ? c.closedForm(mm) : glm::dvec4(0);
      const double allowed = std::min(bound255 / 255, 0.01 * expected.a + 1e-6);
      for (int n = 0; n < 4; ++n)
        worst = std::max(worst, std::abs(picture.row(y)[4 * x + n] - expected[n]) / allowed);
    }
  return worst;
}

}  // namespace

void TestHardCases::addRows(bool (*take)(const HardCase&)) {
  QTest::addColumn<int>("index");
  for (std::size_t n = 0; n < hardCases().size(); ++n)
    if (take(hardCases()[n])) QTest::newRow(hardCases()[n].name.c_str()) << int(n);
}

RenderCaches& TestHardCases::cachesOf(const VolumePtr& volume) {
  return caches_.try_emplace(volume.get(), volume).first->second;
}

#define FETCH_CASE()  \
  QFETCH(int, index); \
  const HardCase& c = hardCases()[std::size_t(index)]

// A renderer need not handle scenes that validation refuses.
void TestHardCases::scenesAreValid() {
  FETCH_CASE();
  const Status valid = validateScene(c.scene);
  QVERIFY2(valid.ok(), valid.ok() ? "" : valid.message().c_str());
}

void TestHardCases::levelsKeepTheirPromises() {
  FETCH_CASE();
  Truth truth(cachesOf(c.volume), c.scene, c.size);
  QStringList broken;
  std::map<Quality, bool> stepsKeepThePromise;
  for (const DrawWay& way : drawWays()) {
    if (!isTried(way, c, index)) continue;
    RenderOptions options = way.options;
    options.quality = Quality::draft;
    const QString draft = whereNotFinite(truth.drawn(options));
    QVERIFY2(draft.isEmpty(), qPrintable(draft));
    for (const Promise& promise : promises) {
      if (promise.quality != Quality::standard && !isWorthFineSteps(way, c)) continue;
      options.quality = promise.quality;
      const Picture picture = truth.drawn(options);
      const QString spoilt = whereNotFinite(picture);
      QVERIFY2(spoilt.isEmpty(), qPrintable(spoilt));
      if (c.finiteOnly || !way.promised) continue;
      const PictureError e = truth.errorOf(picture, promise);
      if (figuresWanted())
        std::fprintf(stderr, "%s | %s, %s: %s\n", c.name.c_str(), way.name, promise.name,
                     qPrintable(inWords(e)));
      const Promise& bound = integrates(way) ? promise : boundOfSteps(c.name, promise);
      if (!bound.keptBy(e))
        broken << QStringLiteral("%1, %2: %3")
                      .arg(QString::fromLatin1(way.name), QString::fromLatin1(promise.name), inWords(e));
      if (&bound != &promise) {
        auto& kept = stepsKeepThePromise.try_emplace(promise.quality, true).first->second;
        kept = kept && promise.keptBy(e);
      }
    }
  }
  QVERIFY2(broken.isEmpty(), qPrintable(broken.join(QStringLiteral("; "))));
  for (const auto& [quality, kept] : stepsKeepThePromise)
    if (whyNoGl().isEmpty())
      QVERIFY2(!kept, "plain steps keep the promise of a level here: its line in bounds_of_steps.h can go");
}

// In homogeneous matter no step length causes an error. The bound of 0.5/255 is for rounding.
void TestHardCases::stepsKeepToTheClosedForm() {
  FETCH_CASE();
  Truth truth(cachesOf(c.volume), c.scene, c.size);
  std::vector<double> steps = {2, 1, 1.0 / 2, 1.0 / 4, 1.0 / 8, 1.0 / 16, 1.0 / 32, 1.0 / 64};
  if (c.size.x > 1000) steps = {1};
  for (const DrawWay& way : drawWays())
    for (double step : steps) {
      if (!isTried(way, c, index)) continue;
      RenderOptions options = way.options;
      options.step = step;
      const double over = overTheBound(c, truth.drawn(options), 0.5);
      QVERIFY2(over <= 1, qPrintable(QStringLiteral("%1, step %2: %3 times what is allowed")
                                         .arg(QString::fromLatin1(way.name))
                                         .arg(step)
                                         .arg(over)));
    }
}

// Compares with the closed form to the promised 0.05/255. Without one it compares with brute force, whose own
// error (0.07/255, tst_brute_force) may require finer steps.
void TestHardCases::referenceIsTheLimit() {
  FETCH_CASE();
  Truth truth(cachesOf(c.volume), c.scene, c.size);
  const QString spoilt = whereNotFinite(truth.reference());
  QVERIFY2(spoilt.isEmpty(), qPrintable(spoilt));
  if (c.closedForm) {
    const double over = overTheBound(c, truth.reference(), 0.05);
    QVERIFY2(over <= 1, qPrintable(QStringLiteral("%1 times what is allowed").arg(over)));
    return;
  }
  const glm::ivec2 few = glm::min(c.size, glm::ivec2(8));
  Truth small(cachesOf(c.volume), c.scene, few);
  PictureError e;
  for (int steps = 64; steps == 64 || (e.maximum > 0.12 && steps <= 4096); steps *= 8)
    e = small.errorOf(bruteForceLimit(c.scene, *c.volume, few, 1.0 / steps));
  QVERIFY2(e.maximum <= 0.12, qPrintable(inWords(e)));
}

void TestHardCases::everyCpuTargetGivesTheSameBytes() {
  FETCH_CASE();
  for (const DrawWay& way : drawWays()) {
    if ((way.usesOpenGl() && !allTargetsWanted()) || !isTried(way, c, index)) continue;
    RenderOptions options = way.options;
    options.quality = Quality::high;
    std::optional<Picture> first;
    QStringList others;
    const auto targets = onEveryCpuTarget([&] {
      RenderCaches caches(c.volume);  // fresh caches, as the Sobel pass has kernels of its own
      const Picture picture = Truth(caches, c.scene, c.size).drawn(options);
      if (!first) first = picture;
      if (picture != *first)
        others << QStringLiteral("%1 on %2")
                      .arg(QString::fromLatin1(way.name), QString::fromLatin1(kernelTarget()));
    });
    QVERIFY2(others.isEmpty(), qPrintable(others.join(QStringLiteral(", "))));
    QVERIFY2(targets.size() >= 2, "this machine has one CPU target only, so nothing was compared");
  }
}

// Skipped if no case was drawn with OpenGL.
void TestHardCases::openGlIsHere() { NEED_GL(); }

VOLUMEN_TEST(TestHardCases);
#include "tst_hard_cases.moc"
