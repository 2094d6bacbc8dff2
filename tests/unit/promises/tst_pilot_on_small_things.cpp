// Guards design.md 2 and 5: a pilot does not overlook small things in a large picture.
#include <cstdio>
#include <random>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/suite.h"

namespace {

using namespace volumen;
using namespace volumen::tests;

constexpr int edge = 64;

// Things at random positions in homogeneous matter. They are seen along the stripes' changes, in fine pixels.
// The rest of the picture has no error.
enum class Small { column, slantedColumn, plates, details, columnInNoise };

// Pictures with light take longer.
glm::ivec2 largeSize(Quality quality) { return glm::ivec2(quality == Quality::high ? 512 : 1024); }

VolumePtr rarely(Small what, unsigned seed) {
  std::mt19937 random(seed);
  const auto place = [&] { return 6 + int(random() % 46); };
  const int wide = 1 + int(random() % 6);
  std::vector<glm::ivec3> corners;
  for (int n = 0; n < (what == Small::details ? 6 : 1); ++n) corners.push_back({place(), place(), place()});
  return volumeOf<std::uint8_t>({edge, edge, edge}, glm::dmat3(1), [=](glm::dvec3 p) mutable {
    for (const glm::ivec3& corner : corners) {
      const glm::ivec3 at = glm::ivec3(p) - corner;
      const bool inside = at.x >= 0 && at.x < wide && at.z >= 0 && at.z < wide;
      if (what == Small::details ? inside && at.y >= 0 && at.y < wide : inside)
        if (what != Small::plates || (at.y >= 0 && at.y < 12)) return int(p.y) % 2 == 0 ? 190.0 : 20.0;
    }
    return what == Small::columnInNoise ? 60.0 + random() % 60 : 100.0;
  });
}

// The curve is faint and even outside the things. Inside, only values near 190 are visible.
Scene sceneOfLittle(Small what, Quality quality) {
  // `high` uses a pilot only if less can be missed and integrating cell by cell takes longer, as with light.
  const double opacity = quality == Quality::high ? 0.07 : 0.2;
  Scene scene;
  scene.transferFunction.points = {{20, {0.2, 0.3, 0.6}, 0},
                                   {100, {0.3, 0.5, 0.8}, 0.006},
                                   {130, {0.9, 0.9, 0.9}, 0},
                                   {190, {1, 1, 1}, opacity},
                                   {250, {1, 1, 1}, 0}};
  scene.shading.lit = quality == Quality::high;
  Camera camera;
  camera.direction = what == Small::slantedColumn ? glm::dvec3(0.02, 1, 0.03) : glm::dvec3(0, 1, 0);
  camera.up = {0, 0, 1};
  camera.height = 64;
  scene.camera = camera;
  return scene;
}

}  // namespace

Q_DECLARE_METATYPE(Small)

class TestPilotOnSmallThings : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void areNotOverlooked_data();
  void areNotOverlooked();
};

void TestPilotOnSmallThings::areNotOverlooked_data() {
  QTest::addColumn<Small>("what");
  QTest::addColumn<int>("seed");
  const auto rows = [](const char* name, Small what) {
    for (int seed = 1; seed <= 4; ++seed) QTest::addRow("%s, %d", name, seed) << what << seed;
  };
  rows("a column of stripes", Small::column);
  rows("a slanted column of stripes", Small::slantedColumn);
  rows("a few plates of one voxel", Small::plates);
  rows("bright details", Small::details);
  rows("a column of stripes in noise", Small::columnInNoise);
}

void TestPilotOnSmallThings::areNotOverlooked() {
  QFETCH(Small, what);
  QFETCH(int, seed);
  RenderCaches caches(rarely(what, unsigned(seed)));
  const auto drawn = [&](Quality quality, Quality scenes) {
    RenderOptions options = atLevel(quality);
    options.size = largeSize(scenes);
    return *render(*makePlan(sceneOfLittle(what, scenes), caches.facts(), options), caches);
  };
  QStringList broken;
  for (const Promise& promise : {promises[0], promises[1]}) {
    const Rendered done = drawn(promise.quality, promise.quality);
    if (figuresWanted() && done.plan.pilot)
      std::fprintf(stderr, "%s | %s: %g voxel, %d, %.1f dB, %.2f/255\n", QTest::currentDataTag(),
                   promise.name, done.plan.pilot->stepVoxels, int(done.plan.pilot->kept),
                   done.plan.pilot->psnrDb, done.plan.pilot->percentile99);
    if (!done.plan.pilot || !done.plan.pilot->kept) continue;
    const PictureError e = compare(done.picture, drawn(Quality::exact, promise.quality).picture);
    if (!promise.keptBy(e) || e.psnrDb < done.plan.pilot->psnrDb)
      broken << QString::fromLatin1(promise.name) + QStringLiteral(": ") + inWords(e);
  }
  QVERIFY2(broken.isEmpty(), qPrintable(broken.join(QStringLiteral("; "))));
}

VOLUMEN_TEST(TestPilotOnSmallThings);
#include "tst_pilot_on_small_things.moc"
