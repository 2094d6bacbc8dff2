// Guards design.md 2 and 5: plain steps accepted by a pilot keep the level's promise on the whole picture.
// The pilot's result depends only on the picture.
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/suite.h"
#include "viewer/reference/reference.h"
#include "viewer/segment/occupancy.h"

namespace {

using namespace volumen;
using namespace volumen::tests;

constexpr glm::ivec2 size(400, 384);
constexpr int edge = 64;

// Contents of a ball whose values fall from centre to surface.
enum class Within { nothing, rods, stripes, noise };

// Returns a ball with `count` pieces of 6 voxels at random positions.
VolumePtr ball(Within within, int count) {
  std::mt19937 random(11);
  std::vector<glm::ivec3> pieces;
  for (int n = 0; n < count; ++n)
    pieces.push_back({12 + int(random() % 36), 12 + int(random() % 36), 12 + int(random() % 36)});
  const auto valueAt = [&](glm::dvec3 p) {
    for (const glm::ivec3& piece : pieces) {
      const glm::ivec3 at = glm::ivec3(p) - piece;
      if (std::min({at.x, at.y, at.z}) < 0 || std::max({at.x, at.y, at.z}) >= 6) continue;
      if (within == Within::noise) return double(random() % 1001);
      if (within == Within::rods ? at.y + at.z == 0 : at.z % 2 == 0) return 1000.0;
    }
    return std::max(0.0, 400 * (1 - glm::distance(p, glm::dvec3((edge - 1) / 2.0)) / 28));
  };
  return volumeOf<std::int16_t>({edge, edge, edge}, glm::dmat3(1), valueAt);
}

// Returns plates with float values.
VolumePtr plates(int apart) {
  return volumeOf({edge, edge, edge}, glm::dmat3(1),
                  [=](glm::dvec3 p) { return int(p.z) % apart == 1 ? 1000.0 : 0.0; });
}

VolumePtr noise() {
  std::mt19937 random(5);
  return volumeOf({edge, edge, edge}, glm::dmat3(1), [&](glm::dvec3) { return double(random() % 1001); });
}

// Opacity rises over all values. Few blocks are empty, so that plain steps are worth trying.
Scene sceneOf(double opacity) {
  Scene scene;
  scene.transferFunction.points = {{40, {1, 0.8, 0.6}, 0}, {1000, {1, 1, 1}, opacity}};
  scene.transferFunction.unitDistance = 1;
  Camera camera;
  camera.direction = {0.3, 0.5, 0.8};
  camera.up = {0.1, 1, 0.2};
  camera.height = 80;
  scene.camera = camera;
  return scene;
}

void steep(Scene& scene) {
  scene.transferFunction.points[0].value = 450;
  scene.transferFunction.points[1].value = 500;
}

void shiny(Scene& scene) {
  scene.shading.specular = 1;
  scene.shading.shininess = 50;
  scene.shading.gradientFloor = 1;
}

// The middle of the ball is a half-transparent segment.
void aroundABall(Scene& scene) {
  const VoxelGeometry geometry = ball(Within::nothing, 0)->geometry();
  BitMask mask(geometry);
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < edge; ++i)
        if (glm::distance(glm::dvec3(i, j, k), glm::dvec3(edge / 2.0)) < edge / 4.0) mask.set({i, j, k});
  scene.segments = {
      {std::make_shared<const OccupancyField>(occupancyOf(mask, surfaceSigma)), {0.9, 0.4, 0.2}, 0.5}};
}

RenderOptions optionsOf(Quality quality) {
  RenderOptions options = atLevel(quality);
  options.size = size;
  return options;
}

// Returns the error against the reference at one pixel of every 12 x 12, without ill-conditioned pixels.
PictureError trueError(const Picture& picture, const Scene& complete, const Volume& volume) {
  std::vector<glm::ivec2> pixels;
  for (int y = 3; y < size.y; y += 12)
    for (int x = 5; x < size.x; x += 12) pixels.emplace_back(x, y);
  const auto truth = referencePixels(complete, volume, size, pixels, 0);
  Picture seen{{int(pixels.size()), 1}, false, {}}, right = seen;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    const float* p = picture.row(pixels[n].y) + 4 * pixels[n].x;
    seen.rgba.insert(seen.rgba.end(), p, p + 4);
    right.rgba.insert(right.rgba.end(), &truth->rgba[n][0], &truth->rgba[n][0] + 4);
  }
  return compare(seen, right, truth->well);
}

using Change = void (*)(Scene&);

}  // namespace

Q_DECLARE_METATYPE(Change)

class TestPilot : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void thePictureKeepsThePromise_data();
  void thePictureKeepsThePromise();
  void aDraftTakesStepsThatKeepItsMeans_data();
  void aDraftTakesStepsThatKeepItsMeans();
  void itMeetsNoCellsInTheSamePlaces();
  void itSaysTheWorstThatThePictureMayHave();
  void itDependsOnThePictureAlone_data();
  void itDependsOnThePictureAlone();
  void whatIsNotKeptChangesNothing();
  void itCanBeCancelled();
};

void TestPilot::thePictureKeepsThePromise_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::addColumn<Change>("change");
  // by standard and high for faint, then dense curves; 0: none, -: not tried
  QTest::addColumn<QString>("taken");
  const auto row = [](const char* name, const VolumePtr& volume, const char* taken, Change change) {
    QTest::newRow(name) << volume << change << QString::fromLatin1(taken);
  };
  const VolumePtr soft = ball(Within::nothing, 0);
  row("a soft ball", soft, "0.849 0.5802 0.849 0.382", [](Scene&) {});
  row("unlit", soft, "0.849 0.5802 0.849 -", [](Scene& s) { s.shading.lit = false; });
  row("with a strong highlight", soft, "0.849 0.382 0.849 0.382", shiny);
  row("in perspective", soft, "0.849 0.5802 0.849 0.382", [](Scene& s) {
    s.camera->projection = Projection::perspective;
    s.camera->distance = 150;
  });
  row("over nothing", soft, "0.849 0.5802 0.849 0.382", [](Scene& s) { s.background.transparent = true; });
  row("clipped", soft, "0.849 0.5802 0.849 0.382", [](Scene& s) { s.clip.boxHigh = {0.7, 0.6, 1}; });
  row("with gradient opacity", soft, "0.849 0.5802 0.849 0.382", [](Scene& s) {
    s.transferFunction.gradientOpacity = {{0, 0.2}, {20, 1}};
  });
  row("around a segment", soft, "0.849 0.5802 0.849 0.382", aroundABall);
  row("around a segment, many rods in it", ball(Within::rods, 40), "0.849 0.382 0.7236 0.2764", aroundABall);
  row("a few rods in it", ball(Within::rods, 3), "0.849 0.5802 0.849 0.382", [](Scene&) {});
  row("many rods in it", ball(Within::rods, 40), "0.849 0.382 0.5802 0.2764", [](Scene&) {});
  row("a few stripes in it", ball(Within::stripes, 3), "0.849 0.5802 0.849 0.382", [](Scene&) {});
  row("many stripes in it", ball(Within::stripes, 40), "0.849 0.382 0.5802 0.2165", [](Scene&) {});
  row("a little noise in it", ball(Within::noise, 3), "0.849 0.5802 0.849 0.382", [](Scene&) {});
  row("much noise in it", ball(Within::noise, 40), "0.849 0.382 0.5802 0.2764", [](Scene&) {});
  row("noise", noise(), "0.7236 0.2764 0.382 0.2165", [](Scene&) {});
  row("noise, a steep curve", noise(), "0.382 0.1895 0.2764 0.1513", steep);
  row("plates eight voxels apart, a steep curve", plates(8), "0.2338 0.1513 0.1513 0", steep);
  row("the same, across them", plates(8), "0.7236 0.1315 0.4393 0", [](Scene& s) {
    steep(s);
    s.camera->direction = {0, 0, 1};
  });
  row("stripes of one voxel", plates(2), "0.849 0.2764 0.7236 0.2165", [](Scene&) {});
  row("stripes of one voxel, along them", plates(2), "0.849 0.7835 0.849 0.4393", [](Scene& s) {
    s.camera->direction = {1, 0, 0};
  });
  row("stripes of one voxel, across them", plates(2), "0.849 0.3052 0.2957 0", [](Scene& s) {
    s.camera->direction = {0, 0, 1};
  });
}

void TestPilot::thePictureKeepsThePromise() {
  QFETCH(VolumePtr, volume);
  QFETCH(Change, change);
  QFETCH(QString, taken);
  RenderCaches caches(volume);
  QStringList steps, broken;
  for (double opacity : {0.05, 0.2})
    for (const Promise& promise : {promises[0], promises[1]}) {
      Scene scene = sceneOf(opacity);
      change(scene);
      const Plan plan = *makePlan(scene, caches.facts(), optionsOf(promise.quality));
      if (!plan.pilotSteps) {
        steps << QStringLiteral("-");
        continue;
      }
      const Rendered done = *render(plan, caches);
      QVERIFY(!done.plan.pilotSteps && done.plan.pilot);
      steps << QString::number(done.plan.pilot->kept ? done.plan.pilot->stepVoxels : 0);
      if (!done.plan.pilot->kept) continue;
      const PictureError e = trueError(done.picture, done.plan.scene, *volume);
      if (!promise.keptBy(e)) broken << QString::fromLatin1(promise.name) + QStringLiteral(": ") + inWords(e);
    }
  QVERIFY2(broken.isEmpty(), qPrintable(broken.join(QStringLiteral("; "))));
  QCOMPARE(steps.join(QLatin1Char(' ')), taken);
}

void TestPilot::aDraftTakesStepsThatKeepItsMeans_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::addColumn<Change>("change");
  QTest::addColumn<int>("edge");
  QTest::addColumn<double>("taken");  // 0: cell by cell
  const auto row = [](const char* name, const VolumePtr& volume, int edge, double taken, Change change) {
    QTest::newRow(name) << volume << change << edge << taken;
  };
  const VolumePtr soft = ball(Within::nothing, 0);
  row("a soft ball", soft, 128, 0.7236, [](Scene&) {});
  row("as a thumbnail", soft, 24, 0.7236, [](Scene&) {});
  row("one pixel", soft, 1, 0.7236, [](Scene&) {});
  row("noise", noise(), 128, 0.382, [](Scene&) {});
  row("noise, a steep curve", noise(), 128, 0, steep);
  row("stripes of one voxel, a steep curve", plates(2), 128, 0, steep);
}

void TestPilot::aDraftTakesStepsThatKeepItsMeans() {
  QFETCH(VolumePtr, volume);
  QFETCH(Change, change);
  QFETCH(int, edge);
  RenderCaches caches(volume);
  Scene scene = sceneOf(0.9);
  change(scene);
  const auto drawnAt = [&](Quality quality) {
    RenderOptions options = optionsOf(quality);
    options.size = {edge, edge};
    return *render(*makePlan(scene, caches.facts(), options), caches);
  };
  const Rendered draft = drawnAt(Quality::draft);
  QVERIFY(draft.plan.pilot);
  QTEST(draft.plan.cellByCell ? 0.0 : draft.plan.stepVoxels, "taken");
  if (edge < draftPromise.blockEdge) return;
  const DraftError e = draftErrorOf(draft.picture, drawnAt(Quality::standard).picture);
  QVERIFY2(e.keepsPromise(), qPrintable(inWords(e)));
}

// A step of 1, 1/2 or 1/3 voxel would meet each stripe in the same phases.
void TestPilot::itMeetsNoCellsInTheSamePlaces() {
  RenderCaches caches(ball(Within::stripes, 3));
  for (const glm::dvec3 direction :
       {glm::dvec3(0, 0, 1), {0, 1, 0}, {0.3, 0.5, 0.8}, {0, 0.8, 0.59}, {1, 1, 1}})
    for (double opacity : {0.02, 0.05, 0.2}) {
      Scene scene = sceneOf(opacity);
      scene.camera->direction = direction;
      const Plan plan = *makePlan(scene, caches.facts(), optionsOf(Quality::standard));
      RenderStats stats;
      const Plan done = *completedPlan(plan, caches, stats);
      QVERIFY(done.pilot);
      for (int axis = 0; axis < 3; ++axis)
        for (double few : {1.0, 1 / 2.0, 1 / 3.0})
          QVERIFY2(
              std::abs(done.pilot->stepVoxels * std::abs(glm::normalize(direction)[axis]) / few - 1) > 0.02,
              qPrintable(QString::number(done.pilot->stepVoxels)));
    }
}

// The stated error is never better than the picture's. A part of the tiles tells of the promise; all of them
// tell of an error that is not much worse than the picture's.
void TestPilot::itSaysTheWorstThatThePictureMayHave() {
  RenderCaches caches(ball(Within::rods, 40));
  for (double opacity : {0.02, 0.06, 0.2}) {
    const Scene scene = sceneOf(opacity);
    const Plan plan = *makePlan(scene, caches.facts(), optionsOf(Quality::standard));
    RenderStats stats;
    const Plan done = *completedPlan(plan, caches, stats);
    QVERIFY(done.pilot && stats.pilotMs > 0);
    RenderOptions plain = optionsOf(Quality::standard);
    plain.step = done.pilot->stepVoxels;
    const Picture picture = render(*makePlan(scene, caches.facts(), plain), caches)->picture;
    const Picture exact =
        render(*makePlan(scene, caches.facts(), optionsOf(Quality::exact)), caches)->picture;
    std::vector<std::uint8_t> shown;
    for (std::size_t n = 0; n < exact.rgba.size(); n += 4)
      shown.push_back(std::max({exact.rgba[n], exact.rgba[n + 1], exact.rgba[n + 2]}) > 0.5f / 255);
    const PictureError e = compare(picture, exact, shown);
    const LevelPromise& promised = promiseOf(Quality::standard);
    const PilotFinding& told = *done.pilot;
    const bool tellsThePromise =
        told.percentile99 == promised.most99 && std::abs(told.psnrDb - promised.leastPsnrDb) < 1e-9;
    const bool isNear = told.psnrDb > e.psnrDb - 17 && told.percentile99 < 2.5 * (2.5 * e.percentile99 + 0.5);
    QVERIFY2(told.psnrDb <= e.psnrDb && told.percentile99 >= e.percentile99 && (tellsThePromise || isNear),
             qPrintable(QStringLiteral("%1 dB, %2/255 of %3")
                            .arg(done.pilot->psnrDb)
                            .arg(done.pilot->percentile99)
                            .arg(inWords(e))));
  }
}

void TestPilot::itDependsOnThePictureAlone_data() {
  QTest::addColumn<int>("threads");
  QTest::addColumn<bool>("full");
  QTest::addColumn<bool>("hasSegment");
  QTest::newRow("one thread") << 1 << false << false;
  QTest::newRow("two threads") << 2 << false << false;
  QTest::newRow("seven threads") << 7 << false << false;
  QTest::newRow("nothing left out") << 2 << true << false;
  QTest::newRow("around a segment, one thread") << 1 << false << true;
  QTest::newRow("around a segment, nothing left out") << 2 << true << true;
}

void TestPilot::itDependsOnThePictureAlone() {
  QFETCH(int, threads);
  QFETCH(bool, full);
  QFETCH(bool, hasSegment);
  RenderCaches caches(ball(Within::rods, 40));
  for (double opacity : {0.02, 0.06, 0.2})
    for (Quality quality : {Quality::standard, Quality::high}) {
      RenderOptions options = optionsOf(quality);
      Scene scene = sceneOf(opacity);
      if (hasSegment) aroundABall(scene);
      const auto done = [&] { return *render(*makePlan(scene, caches.facts(), options), caches); };
      const Rendered asked = done();
      options.threads = threads;
      options.full = full;
      const Rendered other = done();
      QVERIFY(other.plan.pilot == asked.plan.pilot);
      QVERIFY(other.picture == asked.picture);
    }
}

void TestPilot::whatIsNotKeptChangesNothing() {
  RenderCaches caches(plates(8));
  Scene scene = sceneOf(0.2);
  steep(scene);
  Plan plan = *makePlan(scene, caches.facts(), optionsOf(Quality::standard));
  plan.pilotSteps->shortest = plan.pilotSteps->first;  // no shorter steps may be tried
  const Rendered done = *render(plan, caches);
  QVERIFY(done.plan.pilot && !done.plan.pilot->kept);
  plan.pilotSteps.reset();
  QVERIFY(render(plan, caches)->picture == done.picture);
}

void TestPilot::itCanBeCancelled() {
  RenderCaches caches(ball(Within::nothing, 0));
  const Plan plan = *makePlan(sceneOf(0.1), caches.facts(), optionsOf(Quality::standard));
  CancelToken cancel;
  cancel.cancel();
  RenderStats stats;
  const auto done = completedPlan(plan, caches, stats, cancel);
  QVERIFY(!done);
  QCOMPARE(done.message(), std::string("cancelled"));
}

VOLUMEN_TEST(TestPilot);
#include "tst_pilot.moc"
