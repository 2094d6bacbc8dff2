// Guards picture.md 7 and 8 (camera), design.md 10 (views, turning).
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tests/unit/suite.h"
#include "viewer/scene/scene.h"

using namespace volumen;

class TestCamera : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void viewsLookFromTheNamedSide_data();
  void viewsLookFromTheNamedSide();
  void thereAreSixViews();
  void axesAreARightHandedFrame();
  void wholeBoxFitsAndNothingSmallerDoes_data();
  void wholeBoxFitsAndNothingSmallerDoes();
  void givenTargetIsKept();
  void turningIsAnticlockwiseFromTheTipOfUp_data();
  void turningIsAnticlockwiseFromTheTipOfUp();
  void elevationIsTheAngleAboveThePlaneOfTheTurn_data();
  void elevationIsTheAngleAboveThePlaneOfTheTurn();
};

void TestCamera::viewsLookFromTheNamedSide_data() {
  // Coordinates are LPS: left is +x, posterior +y, superior +z. The camera is on the named side and looks
  // back.
  QTest::addColumn<QString>("name");
  QTest::addColumn<int>("axis");
  QTest::addColumn<double>("direction");
  QTest::addColumn<double>("right");  // patient x of the picture's right (y for left and right views)
  QTest::newRow("anterior") << "anterior" << 1 << 1. << 1.;
  QTest::newRow("posterior") << "posterior" << 1 << -1. << -1.;
  QTest::newRow("left") << "left" << 0 << -1. << 1.;
  QTest::newRow("right") << "right" << 0 << 1. << -1.;
  QTest::newRow("superior") << "superior" << 2 << -1. << -1.;
  QTest::newRow("inferior") << "inferior" << 2 << 1. << 1.;
}

void TestCamera::viewsLookFromTheNamedSide() {
  QFETCH(QString, name);
  QFETCH(int, axis);
  QFETCH(double, direction);
  QFETCH(double, right);
  const auto camera = standardView(name.toStdString());
  QVERIFY(camera.has_value());
  glm::dvec3 expected(0);
  expected[axis] = direction;
  QVERIFY(camera->direction == expected);
  QVERIFY(camera->up == (axis == 2 ? glm::dvec3(0, -1, 0) : glm::dvec3(0, 0, 1)));
  QCOMPARE(cameraAxes(*camera).right[axis == 0 ? 1 : 0], right);
}

void TestCamera::thereAreSixViews() {
  QCOMPARE(standardViewNames().size(), std::size_t(6));
  for (const std::string& name : standardViewNames()) QVERIFY(standardView(name).has_value());
  QVERIFY(!standardView("front").has_value());
  QVERIFY(!standardView("Anterior").has_value());
}

void TestCamera::axesAreARightHandedFrame() {
  Camera camera;
  camera.direction = {3, -2, 5};
  camera.up = {10, 20, -7};
  const CameraAxes a = cameraAxes(camera);
  for (const glm::dvec3& v : {a.right, a.up, a.direction}) QVERIFY(std::abs(glm::length(v) - 1) < 1e-12);
  QVERIFY(std::abs(glm::dot(a.right, a.up)) + std::abs(glm::dot(a.right, a.direction)) < 1e-12);
  QVERIFY(glm::length(glm::cross(a.right, a.up) + a.direction) < 1e-12);  // z of camera space is -direction
  QVERIFY(glm::dot(a.up, camera.up) > 0);
}

namespace {

VoxelGeometry obliqueGrid() {
  return {.size = {40, 60, 25},
          .patientFromVoxelStep = glm::dmat3{{0.6, 0.3, 0}, {-0.2, 0.7, 0.1}, {0.1, 0.2, -2.5}},
          .origin = {-12, 200, 37}};
}

// Returns the largest |a| / (width / 2) or |b| / (height / 2) of a corner of the box in the picture
// (picture.md 7). It is 1 if the box just fits, and infinite if a corner is not in front of the eye.
double fill(const Camera& camera, const VoxelGeometry& geometry, double aspect) {
  const CameraAxes axes = cameraAxes(camera);
  const bool perspective = camera.projection == Projection::perspective;
  double largest = 0;
  for (const glm::dvec3& corner : geometry.boxCorners()) {
    const glm::dvec3 q = corner - *camera.target;
    double halfHeight = camera.height / 2;
    if (perspective) {
      const double depth = camera.distance + glm::dot(q, axes.direction);
      if (depth <= 0) return INFINITY;
      halfHeight = depth * std::tan(glm::radians(camera.fov) / 2);
    }
    largest = std::max({largest, std::abs(glm::dot(q, axes.up)) / halfHeight,
                        std::abs(glm::dot(q, axes.right)) / (halfHeight * aspect)});
  }
  return largest;
}

}  // namespace

void TestCamera::wholeBoxFitsAndNothingSmallerDoes_data() {
  QTest::addColumn<bool>("perspective");
  QTest::addColumn<double>("aspect");
  QTest::addColumn<double>("fov");
  for (bool perspective : {false, true})
    for (double aspect : {0.3, 1., 4.})
      for (double fov : {0.1, 30., 170.}) {
        if (!perspective && fov != 30.) continue;
        QTest::addRow("%s, aspect %g, fov %g", perspective ? "perspective" : "parallel", aspect, fov)
            << perspective << aspect << fov;
      }
}

void TestCamera::wholeBoxFitsAndNothingSmallerDoes() {
  QFETCH(bool, perspective);
  QFETCH(double, aspect);
  QFETCH(double, fov);
  Camera camera;
  camera.direction = {1, 2, -0.5};
  camera.up = {0.1, 0, 3};
  camera.fov = fov;
  camera.projection = perspective ? Projection::perspective : Projection::parallel;
  const VoxelGeometry geometry = obliqueGrid();
  Camera fitted = fitCamera(camera, geometry, aspect);
  QVERIFY(glm::length(*fitted.target - geometry.centre()) < 1e-9);
  QVERIFY(std::abs(fill(fitted, geometry, aspect) - 1) < 1e-9);
  fitted.height *= 0.999;
  fitted.distance *= 0.999;
  QVERIFY(fill(fitted, geometry, aspect) > 1 + 1e-6);
  QVERIFY(fitted.direction == camera.direction && fitted.up == camera.up && fitted.fov == camera.fov);
}

void TestCamera::givenTargetIsKept() {
  Camera camera;
  camera.target = glm::dvec3(5, 190, 10);
  const Camera fitted = fitCamera(camera, obliqueGrid(), 1);
  QVERIFY(fitted.target == camera.target);
  QVERIFY(std::abs(fill(fitted, obliqueGrid(), 1) - 1) < 1e-9);
}

void TestCamera::turningIsAnticlockwiseFromTheTipOfUp_data() {
  QTest::addColumn<double>("degrees");
  QTest::addColumn<double>("x");
  QTest::addColumn<double>("y");
  // Seen from +z with x to the right and y upwards, a quarter turn moves (0, 1) to (-1, 0).
  QTest::newRow("none") << 0. << 0. << 1.;
  QTest::newRow("quarter") << 90. << -1. << 0.;
  QTest::newRow("half") << 180. << 0. << -1.;
  QTest::newRow("45") << 45. << -std::sqrt(0.5) << std::sqrt(0.5);
  QTest::newRow("back") << -90. << 1. << 0.;
}

void TestCamera::turningIsAnticlockwiseFromTheTipOfUp() {
  QFETCH(double, degrees);
  QFETCH(double, x);
  QFETCH(double, y);
  Camera camera;
  camera.target = glm::dvec3(1, 2, 3);
  camera.up = {0, 0, 4};
  const Camera after = turned(camera, degrees);
  QVERIFY(glm::length(after.direction - glm::dvec3(x, y, 0)) < 1e-12);
  QVERIFY(after.target == camera.target && after.up == camera.up);
}

void TestCamera::elevationIsTheAngleAboveThePlaneOfTheTurn_data() {
  QTest::addColumn<double>("degrees");
  for (const double degrees : {-80., 0., 15., 60.}) QTest::addRow("%g", degrees) << degrees;
}

// The new elevation does not depend on the camera's former one. The eye stays on its side.
void TestCamera::elevationIsTheAngleAboveThePlaneOfTheTurn() {
  QFETCH(double, degrees);
  Camera camera;
  camera.up = {0.3, 0.1, 2};
  camera.direction = {-0.951251243, -0.167731259, -0.258819045};
  const Camera raised = elevated(camera, degrees);
  const glm::dvec3 toEye = -glm::normalize(raised.direction);
  QVERIFY(std::abs(glm::dot(toEye, glm::normalize(camera.up)) - std::sin(glm::radians(degrees))) < 1e-12);
  QVERIFY(glm::length(cameraAxes(raised).right - cameraAxes(camera).right) < 1e-12);
}

VOLUMEN_TEST(TestCamera);
#include "tst_camera.moc"
