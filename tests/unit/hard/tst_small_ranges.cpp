// Guards design.md 2 (`exact`) for integers with few values. Gradients and their floor are then only a few of
// the smallest steps of 16 bits.
#include <cstdio>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/hard/hard_cases.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

Scene noiseScene(const Volume& volume, int range) {
  const double top = range;
  Scene scene = sceneOf(
      volume,
      {{0, {0.2, 0.5, 1}, 0}, {float(0.4 * top), {1, 0.6, 0.3}, 0.1}, {float(top), {1, 1, 0.9}, 0.5}});
  scene.shading.specular = 0.4;
  return scene;
}

void opacityOfGradient(Scene& scene, int range) {
  scene.transferFunction.gradientOpacity = {{0, 0.1}, {range / 32.0, 0.2}, {range / 4.0, 1}};
}

void colouredLights(Scene& scene, int) {
  scene.lights = {{{1, 2, 0.5}, Space::patient, {1, 0.6, 0.4}, 0.9, true},
                  {{-1, 0.5, 2}, Space::camera, {0.3, 0.6, 1}, 0.7, true}};
}

struct Way {
  const char* name;
  void (*change)(Scene&, int range);
};
constexpr Way ways[] = {{"headlight", [](Scene&, int) {}},
                        {"coloured lights", colouredLights},
                        {"opacity of the gradient", opacityOfGradient}};

}  // namespace

class TestSmallRanges : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void exactIsExact_data();
  void exactIsExact();
};

void TestSmallRanges::exactIsExact_data() {
  QTest::addColumn<int>("range");
  QTest::addColumn<int>("way");
  for (int range : {1, 2, 3, 5, 8, 16, 33, 64})
    for (int way = 0; way < int(std::size(ways)); ++way)
      QTest::addRow("0 to %d, %s", range, ways[way].name) << range << way;
}

void TestSmallRanges::exactIsExact() {
  QFETCH(int, range);
  QFETCH(int, way);
  RenderCaches caches(randomVolume<std::int16_t>({13, 12, 11}, 0, range + 0.999));
  Scene scene = noiseScene(*caches.volume(), range);
  ways[way].change(scene, range);
  Truth truth(caches, scene, {12, 12});
  const RenderOptions exact = atLevel(Quality::exact);
  const Promise& promise = promises[2];
  const PictureError e = truth.errorOf(truth.drawn(exact), promise);
  if (figuresWanted()) std::fprintf(stderr, "%s: %s\n", QTest::currentDataTag(), qPrintable(inWords(e)));
  QVERIFY2(promise.keptBy(e), qPrintable(inWords(e)));
}

VOLUMEN_TEST(TestSmallRanges);
#include "tst_small_ranges.moc"
