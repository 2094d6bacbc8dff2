// Guards design.md 2 on pictures large enough for a pilot: plain steps that one takes keep the level's
// promise and the stated error. Boxes of real studies, as in tst_random_scenes, are compared with `exact`;
// so are scenes with surfaces of segments.
// Pixels that differ by more than a level's 99th percentile are compared with the reference, except for
// ill-conditioned ones. VOLUMEN_RANDOM_CASES=N draws N seeds from VOLUMEN_RANDOM_SEED on.
#include <algorithm>
#include <cstdio>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/promises/random_cases.h"
#include "tests/unit/promises/random_parts.h"
#include "tests/unit/promises/random_segments.h"
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

RandomCase caseOf(Family family, std::uint64_t seed, bool hasSegments) {
  RandomCase c = randomCase(family, seed);
  if (!hasSegments || !c.volume) return c;
  Chance chance(seed);
  c.scene.mode = Mode::composite;
  c.scene.segments = randomSegments(chance, c.volume->geometry());
  return c;
}

}  // namespace

Q_DECLARE_METATYPE(Family)

class TestRandomPilots : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void thePictureKeepsThePromise_data() { addCases(); }
  void thePictureKeepsThePromise();
  void aDraftIsStandardSeenFromAfar_data() { addCases(); }
  void aDraftIsStandardSeenFromAfar();
  void cleanupTestCase();

 private:
  static void addCases();

  /// Pixels of pictures that show anything, and how many of them are off by more than their picture says.
  struct Coverage {
    std::int64_t pixels = 0, above = 0;
    double share() const { return pixels ? double(above) / double(pixels) : 0; }
  };

  /// Returns the coverage of a picture's estimate. `truth` may be off by 0.25/255, also at ill-conditioned
  /// pixels. Pixels of empty background that are right are not counted.
  static Coverage coverageOf(const Rendered& done, const Picture& truth) {
    Coverage c;
    float least = 255;
    for (const float error : done.error)
      if (error > 0) least = std::min(least, error);
    for (std::size_t n = 0; n < done.error.size(); ++n) {
      double off = 0;
      for (std::size_t k = 4 * n; k < 4 * n + 4; ++k)
        off = std::max(off, 255 * std::abs(double(done.picture.rgba[k]) - double(truth.rgba[k])));
      if (done.error[n] <= least && off < 0.01) continue;
      ++c.pixels;
      c.above += off > done.error[n] + 0.25;
    }
    return c;
  }

  int sent_ = 0, kept_ = 0, steppedDrafts_ = 0;
  Coverage coverage_;
  double worstAbove_ = 0;
};

void TestRandomPilots::addCases() {
  QTest::addColumn<Family>("family");
  QTest::addColumn<quint64>("seed");
  QTest::addColumn<bool>("hasSegments");
  const QString only = qEnvironmentVariable("VOLUMEN_RANDOM_FAMILY");
  for (const Family family : families) {
    if (!only.isEmpty() && only != QLatin1String(nameOf(family))) continue;
    const Seeds seeds = seedsOf(family == Family::pieces ? 60 : 12, 300);
    for (int n = seeds.first; n < seeds.behindLast(); ++n)
      for (const bool hasSegments : {false, true})
        QTest::addRow("%s%s, seed %d", nameOf(family), hasSegments ? " with segments" : "", n)
            << family << quint64(n) << hasSegments;
  }
}

void TestRandomPilots::thePictureKeepsThePromise() {
  QFETCH(Family, family);
  QFETCH(quint64, seed);
  QFETCH(bool, hasSegments);
  const RandomCase c = caseOf(family, seed, hasSegments);
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
    const Coverage covered = coverageOf(done, *exact);
    coverage_.pixels += covered.pixels;
    coverage_.above += covered.above;
    worstAbove_ = std::max(worstAbove_, covered.share());
    const PictureError e = errorOf(done.picture, *exact, promise.most99, done.plan, *c.volume);
    const PilotFinding& told = *done.plan.pilot;
    const QString words =
        QStringLiteral("%1, plain steps of %2 voxel, %3; told: %4 dB, %5/255 by %6 rays, %7 % redone: %8")
            .arg(QLatin1String(promise.name))
            .arg(told.stepVoxels)
            .arg(inWords(e))
            .arg(told.psnrDb)
            .arg(told.percentile99)
            .arg(told.rays)
            .arg(100 * told.redoneShare)
            .arg(QString::fromStdString(c.what));
    if (figuresWanted()) std::fprintf(stderr, "%s: %s\n", QTest::currentDataTag(), qPrintable(words));
    QVERIFY2(promise.keptBy(e) && e.psnrDb >= told.psnrDb, qPrintable(words));
  }
}

void TestRandomPilots::aDraftIsStandardSeenFromAfar() {
  QFETCH(Family, family);
  QFETCH(quint64, seed);
  QFETCH(bool, hasSegments);
  const RandomCase c = caseOf(family, seed, hasSegments);
  NEED_VOLUME(c.volume);
  RenderCaches caches(c.volume);
  const auto drawnAt = [&](Quality quality) {
    RenderOptions options = atLevel(quality);
    options.size = glm::ivec2(8 * draftPromise.blockEdge);
    return render(*makePlan(c.scene, caches.facts(), options), caches);
  };
  const Rendered draft = *drawnAt(Quality::draft);
  const DraftError e = draftErrorOf(draft.picture, drawnAt(Quality::standard)->picture);
  const QString steps = draft.plan.cellByCell
                            ? QStringLiteral("cell by cell")
                            : QStringLiteral("plain steps of %1 voxel").arg(draft.plan.stepVoxels);
  const QString words = QStringLiteral("%1, %2: %3").arg(steps, inWords(e), QString::fromStdString(c.what));
  if (figuresWanted()) std::fprintf(stderr, "%s, draft: %s\n", QTest::currentDataTag(), qPrintable(words));
  QVERIFY2(e.keepsPromise(), qPrintable(words));
  steppedDrafts_ += draft.plan.pilot && draft.plan.pilot->kept;
}

void TestRandomPilots::cleanupTestCase() {
  std::fprintf(stderr,
               "drafts by plain steps %d; pilots sent %d, plain steps taken %d; estimates cover %.3f %% of "
               "%lld pixels, at least %.2f %%\n",
               steppedDrafts_, sent_, kept_, 100 * (1 - coverage_.share()),
               static_cast<long long>(coverage_.pixels), 100 * (1 - worstAbove_));
  QVERIFY(coverage_.share() <= 0.001);
}

VOLUMEN_TEST(TestRandomPilots);
#include "tst_random_pilots.moc"
