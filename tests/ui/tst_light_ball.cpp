// Guards design.md 8 (lights on a sphere) and picture.md 7 (camera space: x right, y up, z to the viewer).
#include <QSignalSpy>
#include <glm/geometric.hpp>

#include "tests/ui/gestures.h"
#include "tests/unit/suite.h"
#include "ui/widgets/light_ball.h"
#include "ui/widgets/orientation_cube.h"

using namespace volumen;

Q_DECLARE_METATYPE(glm::dvec3)

class TestLightBall : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void directionAndPositionAreInverse_data();
  void directionAndPositionAreInverse();
  void dragTurnsTheLight();
  void dragOverTheRimGoesBehind();
  void doubleClickAndSpaceChangeSides();
  void arrowsTurnTheSelectedLight();
  void cubeFacesAreTheStandardViews_data();
  void cubeFacesAreTheStandardViews();
};

void TestLightBall::directionAndPositionAreInverse_data() {
  QTest::addColumn<glm::dvec3>("direction");
  QTest::newRow("to the viewer") << glm::dvec3(0, 0, 1);
  QTest::newRow("up left in front") << glm::dvec3(-0.5, 0.5, 0.7);
  QTest::newRow("behind, low") << glm::dvec3(0.2, -0.8, -0.4);
  QTest::newRow("on the rim") << glm::dvec3(1, 0, 0);
}

void TestLightBall::directionAndPositionAreInverse() {
  QFETCH(glm::dvec3, direction);
  LightBall ball;
  ball.resize(200, 160);
  const glm::dvec3 d = glm::normalize(direction);
  QVERIFY(glm::length(ball.directionAt(ball.positionOf(d), d.z < 0) - d) < 1e-6);
}

void TestLightBall::dragTurnsTheLight() {
  LightBall ball;
  ball.resize(200, 200);
  ball.setLights({BallLight{}, BallLight{.direction = glm::normalize(glm::dvec3(-1, 1, 1))}});
  ball.show();
  QSignalSpy finished(&ball, &LightBall::gestureFinished), edits(&ball, &LightBall::directionEdited);
  const glm::dvec3 to = glm::normalize(glm::dvec3(0.6, 0.3, 0.7));
  tests::drag(&ball, ball.positionOf({0, 0, 1}), ball.positionOf(to));
  QCOMPARE(ball.selected(), 0);
  QCOMPARE(edits.count(), 4);
  QCOMPARE(finished.count(), 1);
  QVERIFY(glm::length(ball.lights()[0].direction - to) < 0.03);  // two pixels of 90
}

void TestLightBall::dragOverTheRimGoesBehind() {
  LightBall ball;
  ball.resize(200, 200);
  ball.setLights({BallLight{}});
  ball.show();
  tests::drag(&ball, {100, 100}, {195, 100});
  QVERIFY(ball.lights()[0].direction.z < 0);
  QVERIFY(ball.lights()[0].direction.x > 0.5);
  QVERIFY(std::abs(glm::length(ball.lights()[0].direction) - 1) < 1e-12);
}

void TestLightBall::doubleClickAndSpaceChangeSides() {
  LightBall ball;
  ball.resize(200, 200);
  ball.setLights({BallLight{.direction = glm::normalize(glm::dvec3(0.5, 0, 1))}});
  ball.show();
  QTest::mouseDClick(&ball, Qt::LeftButton, {}, ball.positionOf(ball.lights()[0].direction).toPoint());
  QVERIFY(ball.lights()[0].direction.z < 0);
  ball.select(0);
  QTest::keyClick(&ball, Qt::Key_Space);
  QVERIFY(ball.lights()[0].direction.z > 0);
}

void TestLightBall::arrowsTurnTheSelectedLight() {
  LightBall ball;
  ball.resize(200, 200);
  ball.setLights({BallLight{}});
  ball.show();
  QTest::keyClick(&ball, Qt::Key_Tab);
  QCOMPARE(ball.selected(), 0);
  QTest::keyClick(&ball, Qt::Key_Right);
  QVERIFY(std::abs(ball.lights()[0].direction.x - std::sin(5 * 3.14159265358979 / 180)) < 1e-9);
  QTest::keyClick(&ball, Qt::Key_Up, Qt::ShiftModifier);
  QVERIFY(ball.lights()[0].direction.y > 0.015 && ball.lights()[0].direction.y < 0.02);
}

void TestLightBall::cubeFacesAreTheStandardViews_data() {
  QTest::addColumn<QString>("view");
  for (const std::string& name : standardViewNames())
    QTest::newRow(name.c_str()) << QString::fromStdString(name);
}

void TestLightBall::cubeFacesAreTheStandardViews() {
  QFETCH(QString, view);
  OrientationCube cube;
  cube.show();
  cube.setAxes(cameraAxes(*standardView(view.toStdString())));
  // The face of the cube's view is in its middle.
  QCOMPARE(cube.viewAt({cube.width() / 2.0, 42}), view);
  QSignalSpy asked(&cube, &OrientationCube::viewRequested);
  QTest::mouseClick(&cube, Qt::LeftButton, {}, QPoint(cube.width() / 2, 42));
  QCOMPARE(asked.value(0).value(0).toString(), view);
}

VOLUMEN_TEST(TestLightBall);
#include "tst_light_ball.moc"
