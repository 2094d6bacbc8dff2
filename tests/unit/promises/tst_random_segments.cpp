// Guards picture.md 10 and design.md 2 (levels, determinism, --full, stated errors) on random scenes with 1
// to 4 segments. VOLUMEN_RANDOM_CASES=N draws N of them from VOLUMEN_RANDOM_SEED on.
#include <algorithm>
#include <cstring>

#include "tests/fixtures/seeds.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/promises/random_parts.h"
#include "tests/unit/promises/random_segments.h"
#include "tests/unit/suite.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

RandomCase segmentCase(std::uint64_t seed) {
  RandomCase c = randomCase(Family::attack, seed);
  Chance chance(seed);
  c.scene.mode = Mode::composite;
  // One time in four only segments are visible.
  if (chance.oneIn(4)) c.scene.transferFunction.points = {{0, glm::dvec3(1), 0}};
  c.scene.segments = randomSegments(chance, c.volume->geometry());
  return c;
}

/// Returns variants of the options that must all give the same bytes.
std::vector<std::pair<QString, RenderOptions>> waysToTheSame(const RenderOptions& options) {
  std::vector<std::pair<QString, RenderOptions>> ways{{QStringLiteral("one thread"), options},
                                                      {QStringLiteral("three threads"), options},
                                                      {QStringLiteral("--full"), options}};
  ways[0].second.threads = 1;
  ways[1].second.threads = 3;
  ways[2].second.full = true;
  return ways;
}

bool areSame(const Picture& a, const Picture& b) {
  return a.size == b.size && std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(float)) == 0;
}

}  // namespace

class TestRandomSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyLevelKeepsItsPromise_data();
  void everyLevelKeepsItsPromise();
  void errorsAreAsTold();
  void whatDoesNotShowChangesNoByte_data();
  void whatDoesNotShowChangesNoByte();

 private:
  std::int64_t told_ = 0, beyond_ = 0;  // pixels
};

void TestRandomSegments::everyLevelKeepsItsPromise_data() {
  QTest::addColumn<quint64>("seed");
  const Seeds seeds = seedsOf(24, 400);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed)
    QTest::addRow("seed %d", seed) << quint64(seed);
}

void TestRandomSegments::everyLevelKeepsItsPromise() {
  QFETCH(quint64, seed);
  const RandomCase c = segmentCase(seed);
  QVERIFY(validateScene(c.scene).ok());
  RenderCaches caches(c.volume);
  Truth truth(caches, c.scene, c.size);
  QStringList broken;
  for (const Promise& promise : promises) {
    const RenderOptions options = atLevel(promise.quality);
    const Rendered rendered = truth.rendered(options);
    const PictureError e = truth.errorOf(rendered.picture, promise);
    const QString level = QLatin1String(promise.name) + QStringLiteral(": ");
    if (!promise.keptBy(e)) broken << level + inWords(e);
    if (const QString spoilt = whereNotFinite(rendered.picture); !spoilt.isEmpty()) broken << level + spoilt;
    for (const auto& [name, way] : waysToTheSame(options))
      if (!areSame(truth.drawn(way), rendered.picture))
        broken << level + name + QStringLiteral(": other bytes");
    if (rendered.error.empty()) continue;
    constexpr double roundingOf255 = 1e-3;  // rounding of float pixels, including the background
    const std::vector<double> off = truth.errorOfPixels(rendered.picture);
    told_ += std::int64_t(off.size());
    for (std::size_t n = 0; n < off.size(); ++n)
      beyond_ += off[n] > double(rendered.error[n]) + roundingOf255;
  }
  QVERIFY2(broken.isEmpty(), qPrintable(broken.join(QStringLiteral("; "))));
}

// Covers all pixels drawn above: a picture's stated error bounds its true error.
void TestRandomSegments::errorsAreAsTold() {
  QVERIFY2(double(beyond_) <= 0.001 * double(told_),
           qPrintable(QStringLiteral("%1 of %2").arg(beyond_).arg(told_)));
}

void TestRandomSegments::whatDoesNotShowChangesNoByte_data() {
  QTest::addColumn<quint64>("seed");
  const Seeds seeds = seedsOf(8, 100);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed)
    QTest::addRow("seed %d", seed) << quint64(seed);
}

// Segments that have opacity 0, have no voxels or lie beyond a clip plane must not change any byte.
void TestRandomSegments::whatDoesNotShowChangesNoByte() {
  QFETCH(quint64, seed);
  RandomCase c = segmentCase(seed);
  c.scene = randomCase(Family::attack, seed).scene;
  RenderCaches caches(c.volume);
  for (const Promise& promise : promises) {
    const RenderOptions options = atLevel(promise.quality);
    const Picture without = Truth(caches, c.scene, c.size).drawn(options);
    Chance chance(seed);
    Scene scene = c.scene;
    scene.segments = randomSegments(chance, c.volume->geometry());
    for (SegmentSurface& s : scene.segments) s.opacity = 0;
    scene.segments.push_back({std::make_shared<const OccupancyField>(), glm::dvec3(1), 1});
    QVERIFY(areSame(Truth(caches, scene, c.size).drawn(options), without));
    for (SegmentSurface& s : scene.segments) s.opacity = 1;
    scene.segments.pop_back();
    Scene cut = c.scene;
    cut.clip.planes = {{{0, 0, 1}, -1e6 * radiusOf(c.volume->geometry()) - 1e6}};
    const Picture nothing = Truth(caches, cut, c.size).drawn(options);
    cut.segments = scene.segments;
    QVERIFY(areSame(Truth(caches, cut, c.size).drawn(options), nothing));
  }
}

VOLUMEN_TEST(TestRandomSegments);
#include "tst_random_segments.moc"
