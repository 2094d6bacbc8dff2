// Guards design.md 3 (shading by reflectance map and by the paper's 5-bit table) with the paper's figure 3: a
// sphere, lit by each.
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/brute_force.h"
#include "tests/fixtures/brute_matter.h"
#include "tests/fixtures/cpu_targets.h"
#include "tests/fixtures/picture_words.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr glm::ivec2 size{96, 96};
constexpr double radius = 20, level = 500;
const glm::dvec3 centreVoxel{31.8, 31.3, 31.6};

const VolumePtr& sphere() {
  static const VolumePtr volume = *makePhantom("soft-sphere");
  return volume;
}

/// The surface is opaque from `level` on, with one colour, one side and one light at the viewer. The picture
/// depends smoothly on the normal alone and is nowhere brighter than 1.
Scene sphereScene() {
  Scene scene;
  scene.transferFunction = {1, {{level, {0.9, 0.7, 0.5}, 0}, {level, {0.9, 0.7, 0.5}, 1}}, {}};
  scene.shading.sides = 1;
  scene.camera = Camera{};
  scene.camera->direction = {1, 2, -0.5};
  scene.camera->height = 50;
  return scene;
}

Plan planned(const Scene& scene, const RenderOptions& asked, RenderCaches& caches) {
  RenderOptions options = asked;
  options.size = size;
  options.step = 0.25;
  options.precision = 32;
  return *makePlan(scene, caches.facts(), options);
}

Picture drawn(const RenderOptions& asked) {
  static RenderCaches caches(sphere());
  return render(planned(sphereScene(), asked, caches), caches)->picture;
}

Picture drawn(Shader shader) {
  RenderOptions options;
  options.shader = shader;
  return drawn(options);
}

Picture drawnByMap(int n, MapLookup lookup) {
  RenderOptions options;
  options.mapSize = n;
  options.mapLookup = lookup;
  return drawn(options);
}

const Picture& phong() {
  static const Picture picture = drawn(Shader::phong);
  return picture;
}

/// Returns the smallest gradient (per mm) among samples that count. A sample's opacity is 1 - 2^-5, so that
/// samples deeper than half a voxel count less than 2^-10.
double smallestGradient() {
  const Scene scene = completed(sphereScene(), *sphere(), size);
  const BruteMatter matter(scene, *sphere());
  double smallest = 1e30;
  for (int n = 0; n < 3000; ++n) {
    const double z = (2 * n + 1) / 3000.0 - 1, turn = 2.399963 * n,
                 r = radius + 0.05 - 0.55 * (n % 12) / 11.0;
    const glm::dvec3 direction(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn),
                               z);
    const glm::dvec3 x = centreVoxel + r * direction;
    const Cell cell = matter.cellAt(x, true);
    smallest =
        std::min(smallest, glm::length(matter.perMm(trilinear(cell.gradients, x - glm::dvec3(cell.low)))));
  }
  return smallest;
}

/// Returns the largest change of a pixel (in /255) for normals off by `angle`. n.l changes by at most the
/// angle, and cos^p by its steepest slope times the angle. `bytes` adds half a step of 8 bits. Deeper samples
/// add 1/1024 of all light.
double boundOf(double angle, bool bytes) {
  const Scene scene = sphereScene();
  const double p = scene.shading.shininess, steepest = std::sqrt(p) * std::pow((p - 1) / p, (p - 1) / 2);
  return 255 * angle * (0.9 * scene.shading.diffuse + scene.shading.specular * steepest) + (bytes ? 0.5 : 0) +
         255.0 / 1024;
}

/// Returns the largest difference, in /255, between neighbours of a row in the middle of the picture. There
/// the sphere faces the viewer.
double largestJump(const Picture& picture) {
  float jump = 0;
  for (int y = size.y / 3; y < 2 * size.y / 3; ++y)
    for (int n = 4 * (size.x / 3); n < 4 * (2 * size.x / 3); ++n)
      jump = std::max(jump, std::abs(picture.row(y)[n + 4] - picture.row(y)[n]));
  return 255 * jump;
}

QString inWords(const PictureError& e, double bound) {
  return tests::inWords(e) + QStringLiteral(", bound %1").arg(bound);
}

using Change = void (*)(Scene&, RenderOptions&);

}  // namespace

Q_DECLARE_METATYPE(Change)

class TestShaders : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theTableIsOffByItsRoundedGradients();
  void theTableShowsBands();
  void theNearestMapIsOffByItsPatches_data();
  void theNearestMapIsOffByItsPatches();
  void theBilinearMapIsCloser();
  void whiteLightComputedOnceIsTheSame_data();
  void whiteLightComputedOnceIsTheSame();
};

// Gradient components are rounded to limit / 15. The limit is half the range of values (1000) a voxel of 1
// mm. The error is limit / 30 each and sqrt(3) times that in all.
void TestShaders::theTableIsOffByItsRoundedGradients() {
  const double off = std::sqrt(3.0) * 500 / 30, smallest = smallestGradient();
  QVERIFY2(smallest > 250, qPrintable(QString::number(smallest)));
  const double bound = boundOf(std::asin(off / smallest), true);
  const PictureError e = compare(drawn(Shader::table), phong());
  QVERIFY2(e.maximum <= bound, qPrintable(inWords(e, bound)));
}

// Figure 3: the paper rejects the table for these bands.
void TestShaders::theTableShowsBands() {
  const Picture table = drawn(Shader::table);
  const PictureError e = compare(table, phong());
  const PictureError map = compare(drawnByMap(64, MapLookup::bilinear), phong());
  QVERIFY2(e.maximum > 4 && e.rmse > 10 * map.rmse, qPrintable(inWords(e, map.rmse)));
  QVERIFY2(largestJump(table) > 2 * largestJump(phong()),
           qPrintable(QStringLiteral("%1 and %2").arg(largestJump(table)).arg(largestJump(phong()))));
}

void TestShaders::theNearestMapIsOffByItsPatches_data() {
  QTest::addColumn<int>("n");
  for (int n : {4, 16, 64, 256}) QTest::addRow("%d x %d", n, n) << n;
}

// A patch's corner is sqrt(2) / n from its middle, at distance 1 from the cube's middle.
void TestShaders::theNearestMapIsOffByItsPatches() {
  QFETCH(int, n);
  const double bound = boundOf(std::atan(std::sqrt(2.0) / n), false);
  const PictureError e = compare(drawnByMap(n, MapLookup::nearest), phong());
  QVERIFY2(e.maximum <= bound, qPrintable(inWords(e, bound)));
  QVERIFY2(e.maximum > bound / 20, qPrintable(inWords(e, bound)));
}

// Between nodes at distance d, the interpolation error is d^2/8 times the second derivative along each of two
// axes. That is at most 1 for D and at most p for cos^p (both on the sphere; the cube stretches by at most
// 1).
void TestShaders::theBilinearMapIsCloser() {
  const Scene scene = sphereScene();
  for (int n : {16, 64}) {
    const double d = 2.0 / (n - 1);
    const double bound =
        255 * d * d / 4 *
            (0.9 * scene.shading.diffuse * 2 + scene.shading.specular * 2 * scene.shading.shininess) +
        255.0 / 1024;
    const PictureError e = compare(drawnByMap(n, MapLookup::bilinear), phong());
    QVERIFY2(e.maximum <= bound, qPrintable(inWords(e, bound)));
    QVERIFY(e.rmse < compare(drawnByMap(n, MapLookup::nearest), phong()).rmse / 4);
  }
}

void TestShaders::whiteLightComputedOnceIsTheSame_data() {
  QTest::addColumn<Change>("change");
  const auto row = [](const char* name, Change change) { QTest::newRow(name) << change; };
  row("directly", [](Scene&, RenderOptions& o) { o.shader = Shader::phong; });
  row("directly, no specular", [](Scene& s, RenderOptions& o) {
    o.shader = Shader::phong;
    s.shading.specular = 0;
  });
  row("a viewer a ray", [](Scene& s, RenderOptions&) { s.shading.localViewer = true; });
  row("bilinear map", [](Scene&, RenderOptions& o) { o.mapSize = 33; });
  row("bilinear map of two nodes an edge", [](Scene&, RenderOptions& o) { o.mapSize = 2; });
  row("nearest map", [](Scene&, RenderOptions& o) {
    o.mapSize = 16;
    o.mapLookup = MapLookup::nearest;
  });
  row("blend", [](Scene&, RenderOptions& o) {
    o.method = Method::blend;
    o.mapSize = 33;
  });
  row("preshaded", [](Scene&, RenderOptions& o) { o.method = Method::preshaded; });
}

// design.md 5: white lights -> fewer components. With every sound rule off all components are computed.
void TestShaders::whiteLightComputedOnceIsTheSame() {
  QFETCH(Change, change);
  Scene scene = sphereScene();
  scene.shading.sides = 2;
  scene.lights = {{.direction = {0.3, 0.4, 1}, .intensity = 0.7},
                  {.direction = {-2, 1, -0.5}, .colour = {0.4, 0.4, 0.4}}};
  RenderOptions options;
  change(scene, options);
  static RenderCaches caches(sphere());
  const Plan once = planned(scene, options, caches);
  options.full = true;
  const Plan full = planned(scene, options, caches);
  QVERIFY(!once.colouredLight && full.colouredLight);
  onEveryCpuTarget(
      [&] { QVERIFY2(render(once, caches)->picture == render(full, caches)->picture, kernelTarget()); });
}

VOLUMEN_TEST(TestShaders);
#include "tst_shaders.moc"
