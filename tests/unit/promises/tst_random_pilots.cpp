// Guards design.md 2 on pictures large enough for a pilot: plain steps that one takes keep the level's
// promise and the stated error. Boxes of real studies, as in tst_random_scenes, are compared with `exact`.
// Pixels that differ by more than a level's 99th percentile are compared with the reference, except for
// ill-conditioned ones. VOLUMEN_RANDOM_CASES=N draws N seeds from VOLUMEN_RANDOM_SEED on.
#include <algorithm>
#include <cstdio>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/promises/random_cases.h"
#include "tests/unit/suite.h"
#include "viewer/reference/reference.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

/// Returns the error of `picture`. `truth` is the picture by `exact`. Where both differ by more than `most`,
/// it is set to the reference.
PictureError errorOf(const Picture& picture, Picture& truth, double most, const Plan& plan,
                     const Volume& volume) {
  std::vector<glm::ivec2> pixels;
  for (int y = 0; y < truth.size.y; ++y)
    for (int x = 0; x < truth.size.x; ++x) {
      const float *a = picture.row(y) + 4 * x, *b = truth.row(y) + 4 * x;
      double off = 0;
      for (int c = 0; c < 4; ++c) off = std::max(off, 255 * std::abs(double(a[c]) - double(b[c])));
      if (!(off <= most)) pixels.emplace_back(x, y);
    }
  const ReferencePixels right = *referencePixels(plan.scene, volume, truth.size, pixels);
  std::vector<std::uint8_t> use(truth.rgba.size() / 4, 1);
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    use[std::size_t(pixels[n].y) * truth.size.x + pixels[n].x] = right.well[n];
    std::copy_n(&right.rgba[n][0], 4, truth.row(pixels[n].y) + 4 * pixels[n].x);
  }
  return compare(picture, truth, use);
}

}  // namespace

class TestRandomPilots : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void thePictureKeepsThePromise_data();
  void thePictureKeepsThePromise();
  void cleanupTestCase();

 private:
  int sent_ = 0, kept_ = 0;
};

void TestRandomPilots::thePictureKeepsThePromise_data() {
  QTest::addColumn<quint64>("seed");
  const Seeds seeds = seedsOf(100, 300);
  for (int n = seeds.first; n < seeds.behindLast(); ++n) QTest::addRow("seed %d", n) << quint64(n);
}

void TestRandomPilots::thePictureKeepsThePromise() {
  QFETCH(quint64, seed);
  const RandomCase c = randomCase(Family::pieces, seed);
  NEED_VOLUME(c.volume);
  if (c.scene.mode != Mode::composite) return;
  const glm::ivec2 size = 16 * c.size;
  RenderCaches caches(c.volume);
  const auto planAt = [&](Quality quality) {
    RenderOptions options = atLevel(quality);
    options.size = size;
    return *makePlan(c.scene, caches.facts(), options);
  };
  std::optional<Picture> exact;
  for (const Promise& promise : {promises[0], promises[1]}) {
    const Plan plan = planAt(promise.quality);
    if (!plan.pilotSteps) continue;
    ++sent_;
    const Rendered done = *render(plan, caches);
    if (!done.plan.pilot->kept) continue;
    ++kept_;
    if (!exact) exact = render(planAt(Quality::exact), caches)->picture;
    const PictureError e = errorOf(done.picture, *exact, promise.most99, done.plan, *c.volume);
    const PilotFinding& told = *done.plan.pilot;
    const QString words = QStringLiteral("%1, plain steps of %2 voxel, %3; told: %4 dB, %5/255")
                              .arg(QLatin1String(promise.name))
                              .arg(told.stepVoxels)
                              .arg(inWords(e))
                              .arg(told.psnrDb)
                              .arg(told.percentile99);
    if (figuresWanted()) std::fprintf(stderr, "%s: %s\n", QTest::currentDataTag(), qPrintable(words));
    QVERIFY2(promise.keptBy(e) && e.psnrDb >= told.psnrDb, qPrintable(words));
  }
}

void TestRandomPilots::cleanupTestCase() {
  std::fprintf(stderr, "pilots sent %d, plain steps taken %d\n", sent_, kept_);
}

VOLUMEN_TEST(TestRandomPilots);
#include "tst_random_pilots.moc"
