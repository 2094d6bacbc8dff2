// Guards picture.md 5 (light) for the reference renderer, by numbers calculated by hand and closed forms.
#include <functional>

#include "tests/unit/render/reference_fixture.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestReferenceShading : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void planeOfKnownNormal_data();
  void planeOfKnownNormal();
  void localViewerLooksAlongTheRay();
  void lightsAddUp();
  void floorIsCrossedExactly_data();
  void floorIsCrossedExactly();
  void normalThatTurnsOverIsDampedByTheFloor();
  void narrowHighlightIsNotMissed_data();
  void narrowHighlightIsNotMissed();
};

namespace {

constexpr glm::dvec3 white(1);
const glm::dmat3 grids[] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            {{0.5, 0, 0}, {0, 2, 0}, {0, 0, 1.25}},
                            {{-1, 0.2, 0}, {0.3, 1, 0}, {0.5, 0.1, 2}}};

Light lightFrom(glm::dvec3 towards, double intensity = 1, glm::dvec3 colour = white) {
  return {towards, Space::camera, colour, intensity, true};
}

struct ShadingCase {
  const char* name;
  glm::dvec3 normal;  // camera space: x right, y up, z towards the viewer
  std::vector<Light> lights;
  int sides;
  double shininess, gradientOverFloor;
  double d, s;  // D'' and S'' with ambient 0.2, diffuse 0.7, specular 0.2
};

const std::vector<ShadingCase>& shadingCases() {
  const double c60 = 0.5, s60 = std::sqrt(0.75), grazing = std::sqrt(1 - 0.05 * 0.05), half = std::sqrt(0.5);
  const Light headlight = lightFrom({0, 0, 3});
  Light off = lightFrom({1, 0, 0});
  off.on = false;
  static const std::vector<ShadingCase> cases = {
      {"headlight, face on", {0, 0, 1}, {headlight}, 2, 20, 9, 0.9, 0.2},
      {"headlight, 60 degrees", {s60, 0, c60}, {headlight}, 2, 2, 9, 0.2 + 0.7 * 0.5, 0.2 * 0.25},
      {"light at 60 degrees, normal half way",
       {c60, 0, s60},
       {lightFrom({s60, 0, c60})},
       2,
       20,
       9,
       0.2 + 0.7 * s60,
       0.2},
      {"light at 60 degrees, face on", {0, 0, 1}, {lightFrom({0, s60, c60})}, 2, 4, 9, 0.55, 0.2 * 0.5625},
      {"light from the side in patient space",
       {half, 0, half},
       {{{2, 0, 0}, Space::patient, white, 1, true}},
       2,
       20,
       9,
       0.2 + 0.7 * half,
       0.2},
      {"turned away, two sides", {0, 0, -1}, {headlight}, 2, 20, 9, 0.9, 0.2},
      {"turned away, one side", {0, 0, -1}, {headlight}, 1, 20, 9, 0.2, 0},
      {"facing, one side", {0, 0, 1}, {headlight}, 1, 20, 9, 0.9, 0.2},
      {"edge on, two sides are half and half",
       {1, 0, 0},
       {lightFrom({1, 0, 1})},
       2,
       2,
       9,
       0.2 + 0.35 * half,
       0.1 * (1 - half) / 2},
      // w = 3/4; n.h squared = (1 + 0.1 sqrt(1 - 0.05^2)) / 2 for a light from the right.
      {"grazing",
       {grazing, 0, 0.05},
       {lightFrom({1, 0, 0})},
       2,
       2,
       9,
       0.2 + 0.75 * 0.7 * grazing,
       0.15 * (1 + 0.1 * grazing) / 2},
      // n.l = 0.05 halves the highlight; n.h squared = 1.05^2 / 2.1.
      {"highlight at a low light", {0, 0, 1}, {lightFrom({grazing, 0, 0.05})}, 2, 2, 9, 0.235, 0.1 * 0.525},
      {"light straight against the viewer",
       {half, 0, -half},
       {lightFrom({0, 0, -1})},
       1,
       1,
       9,
       0.2 + 0.7 * half,
       0},
      {"half the gradient floor", {0, 0, 1}, {headlight}, 2, 20, 0.5, 0.5 * 0.9 + 0.5 * 0.55, 0.1},
      {"half the floor, turned away, one side",
       {0, 0, -1},
       {headlight},
       1,
       20,
       0.5,
       0.5 * 0.2 + 0.5 * 0.55,
       0},
      {"no floor", {0, 0, 1}, {headlight}, 2, 20, 0, 0.55, 0},
      {"no lights", {0, 0, 1}, {}, 2, 20, 9, 0.2, 0},
      {"lights that are off", {0, 0, 1}, {off}, 2, 20, 9, 0.2, 0},
      {"two lights",
       {0, 0, 1},
       {headlight, lightFrom({0, s60, c60}, 0.5)},
       2,
       4,
       9,
       0.2 + 0.7 + 0.175,
       0.2 + 0.1 * 0.5625},
  };
  return cases;
}

}  // namespace

void TestReferenceShading::planeOfKnownNormal_data() {
  QTest::addColumn<int>("row");
  QTest::addColumn<int>("grid");
  const char* names[] = {"cubic", "anisotropic", "sheared, left-handed"};
  for (int grid = 0; grid < 3; ++grid)
    for (std::size_t n = 0; n < shadingCases().size(); ++n)
      QTest::addRow("%s, %s grid", shadingCases()[n].name, names[grid]) << int(n) << grid;
}

void TestReferenceShading::planeOfKnownNormal() {
  QFETCH(int, row);
  QFETCH(int, grid);
  const ShadingCase& c = shadingCases()[row];
  const VoxelGeometry geometry = gridAround({8, 7, 9}, grids[grid]);
  // The view is along +y: right is +x, up is +z, and -y points to the viewer.
  const glm::dvec3 normal(c.normal.x, -c.normal.z, c.normal.y);
  const double perMm = 10;
  const auto plane = volumeOf(geometry, [&](int i, int j, int k) {
    return -perMm * glm::dot(normal, geometry.patientFromVoxel(glm::dvec3(i, j, k)));
  });
  Scene scene = plainScene(0.2, {0, 1, 0});
  scene.clip = insideOf(geometry.size);
  scene.lights = c.lights;
  scene.shading = {true, c.sides, false, c.gradientOverFloor > 0 ? perMm / c.gradientOverFloor : 0,
                   0.2,  0.7,     0.2,   c.shininess};
  const glm::dvec4 pixel = onePixel(scene, *plane);
  QVERIFY(pixel.a > 0.3);
  const glm::dvec3 colour = scene.transferFunction.points[0].colour;
  // Float32 samples of the plane turn its normal by about 1e-6.
  for (int n = 0; n < 3; ++n)
    COMPARE_WITHIN(pixel[n], std::min(1.0, pixel.a * (colour[n] * c.d + c.s)), 1e-5);
}

void TestReferenceShading::localViewerLooksAlongTheRay() {
  const VoxelGeometry geometry = gridAround({60, 8, 4});
  const auto plane = volumeOf(geometry, [](int, int j, int) { return 10 * j; });
  Scene scene = plainScene(0.2, {0, 1, 0});
  scene.clip = insideOf(geometry.size);
  scene.shading = {true, 2, false, 1.0, 0.1, 0.6, 0.2, 20};
  scene.camera->projection = Projection::perspective;
  scene.camera->fov = 90;
  scene.camera->distance = 10;
  for (bool local : {false, true}) {
    scene.shading.localViewer = local;
    const Picture picture = drawn(scene, *plane, {3, 1});
    // The outer pixels' rays have slope 2, as the picture and each pixel are 20 mm high.
    const double cosine = 1 / std::sqrt(5.0), halfway2 = local ? (1 + cosine) / 2 : 1;
    const double alpha = picture.rgba[3];
    COMPARE_WITHIN(alpha, 1 - std::pow(0.8, 5 / cosine), 1e-6);
    COMPARE_WITHIN(picture.rgba[0], alpha * (0.7 + 0.2 * std::pow(halfway2, 10)), 1e-6);
  }
}

void TestReferenceShading::lightsAddUp() {
  const auto ball = volumeOf(gridAround(glm::ivec3(12)), [](int i, int j, int k) {
    return 100 *
           std::exp(-glm::dot(glm::dvec3(i - 6, j - 5, k - 5.5), glm::dvec3(i - 6, j - 5, k - 5.5)) / 12);
  });
  Scene scene = plainScene(0, {0.3, 1, -0.2});
  scene.transferFunction.points = {{20, {1, 0.4, 0.3}, 0}, {60, {0.9, 0.8, 0.6}, 0.3}};
  scene.camera->height = 12;
  scene.shading = {true, 2, false, 5.0, 0.1, 0.4, 0.2, 10};
  const auto lit = [&](std::vector<Light> lights) {
    scene.lights = std::move(lights);
    return drawn(scene, *ball, {12, 12});
  };
  const Light a = lightFrom({-0.4, 0.5, 1}, 0.8, {1, 0.8, 0.6}),
              b = lightFrom({1, 0.1, 0.3}, 0.6, {0.3, 0.5, 1});
  const Picture both = lit({a, b}), onlyA = lit({a}), onlyB = lit({b}), ambient = lit({});
  double largest = 0;
  for (std::size_t n = 0; n < both.rgba.size(); ++n) {
    QVERIFY(both.rgba[n] < 1);
    const double sum = double(onlyA.rgba[n]) + onlyB.rgba[n] - ambient.rgba[n];
    largest = std::max(largest, std::abs(both.rgba[n] - sum));
  }
  QVERIFY2(largest <= referenceBound, qPrintable(QString::number(largest * 255)));
}

namespace {
// Returns the integral over pieces (length, D at start, D at end), front to back.
double overPieces(double mu, std::initializer_list<glm::dvec3> pieces) {
  double sum = 0, before = 0;
  for (const glm::dvec3& p : pieces) {
    sum += std::exp(-mu * before) * attenuatedLine(p.y, (p.z - p.y) / p.x, mu, p.x);
    before += p.x;
  }
  return sum;
}
}  // namespace

void TestReferenceShading::floorIsCrossedExactly_data() {
  QTest::addColumn<double>("floorPerMm");
  for (double floorPerMm : {1.005, 1.03, 1.3, 1.97}) QTest::addRow("floor %g", floorPerMm) << floorPerMm;
}

void TestReferenceShading::floorIsCrossedExactly() {
  QFETCH(double, floorPerMm);
  // Behind a plane at x = 0.9 the gradient rises through the floor. D is 0.55 without gradient and 0.9 above
  // the floor.
  for (double opacity : {0.05, 0.99}) {
    Parabola p = parabola(opacity, 2, floorPerMm);
    p.scene.clip.planes = {{{-1, 0, 0}, -0.9}};
    const double start = 0.55 + 0.35 * 0.9 / floorPerMm;
    const double expected = overPieces(p.mu, {{floorPerMm - 0.9, start, 0.9}, {4 - floorPerMm, 0.9, 0.9}});
    COMPARE_WITHIN(onePixel(p.scene, *p.volume).r, expected, referenceBound / 10);
  }
}

void TestReferenceShading::normalThatTurnsOverIsDampedByTheFloor() {
  for (double floorPerMm : {1.3, 1e-4, 1e-12}) {
    const Parabola p = parabola(0.2, 1, floorPerMm);
    // With one side, D is 0.2 where values fall along the ray and 0.9 where they rise.
    const double f = floorPerMm;
    const double expected = overPieces(p.mu, {{4 - f, 0.2, 0.2}, {2 * f, 0.2, 0.9}, {4 - f, 0.9, 0.9}});
    COMPARE_WITHIN(onePixel(p.scene, *p.volume).r, expected, referenceBound);
  }
}

void TestReferenceShading::narrowHighlightIsNotMissed_data() {
  QTest::addColumn<double>("shininess");
  QTest::addColumn<double>("slope");
  QTest::addColumn<double>("vertex");
  for (double shininess : {1.0, 20.0, 10000.0})
    for (double slope : {0.9, 0.3, 0.003})
      for (double vertex : {0.37, 0.61, -0.02})
        QTest::addRow("shininess %g, turns within %g voxels at %g", shininess, slope, vertex)
            << shininess << slope << vertex;
}

void TestReferenceShading::narrowHighlightIsNotMissed() {
  QFETCH(double, shininess);
  QFETCH(double, slope);
  QFETCH(double, vertex);
  // g = (x, slope, 0). Within about `slope` voxels of the vertex, the normal turns from one side to the
  // other, past the half-way vector. The expected integral is summed over fine steps.
  const VoxelGeometry geometry = gridAround({11, 5, 5});
  const auto volume = volumeOf(
      geometry, [&](int i, int j, int) { return (i - 5 - vertex) * (i - 5 - vertex) / 2.0 + slope * j; });
  Scene scene = plainScene(0.3);
  scene.clip = insideOf(geometry.size);
  scene.shading = {true, 1, false, 1e-5, 0, 0, 1, shininess};
  scene.lights = {{{-1, -1, 0}, Space::patient, white, 0.9, true}};
  const double mu = extinction(0.3);
  const glm::dvec3 l = glm::normalize(glm::dvec3(-1, -1, 0)), h = glm::normalize(l + glm::dvec3(-1, 0, 0));
  double expected = 0;
  constexpr int steps = 200000;
  for (int n = 0; n < steps; ++n) {
    const double t = (n + 0.5) * 8 / steps;  // from x = -4 on
    const glm::dvec3 normal = -glm::normalize(glm::dvec3(t - 4 - vertex, slope, 0));
    const double s = 0.9 * glm::clamp(10 * glm::dot(normal, l), 0.0, 1.0) *
                     std::pow(std::max(0.0, glm::dot(normal, h)), shininess);
    expected += s * mu * std::exp(-mu * t) * 8 / steps;
  }
  COMPARE_WITHIN(onePixel(scene, *volume).r, expected, referenceBound);
}

VOLUMEN_TEST(TestReferenceShading);
#include "tst_reference_shading.moc"
