// Guards clicks into 3D views. The first click chooses the view, a double-click maximises it, and neither
// moves the crosshair. Also guards which picture a view reports as final. Real events.
#include <QApplication>
#include <QComboBox>

#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/curve_editor.h"

using namespace volumen;
using namespace volumen::tests;

class TestSceneClicks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theFirstClickChoosesTheView();
  void aDoubleClickMovesNothing();
  void whatIsDrawnAnewIsNotFinal();
  void keysOnACurveWithoutItsSeries();
};

void TestSceneClicks::theFirstClickChoosesTheView() {
  MeasureWindow w;
  QWidget* scene = w.window.view();
  const QPoint at = scene->rect().center();
  const auto crosshairs = [&] { return w.session().workspace().crosshairs; };
  const auto before = crosshairs();
  QTest::mouseClick(scene, Qt::LeftButton, {}, at);
  QCOMPARE(w.session().workspace().focus, sceneViewId);
  QVERIFY(crosshairs() == before);
  QTest::qWait(QApplication::doubleClickInterval() + 50);
  QTest::mouseClick(scene, Qt::LeftButton, {}, at);
  QVERIFY2(!(crosshairs() == before), "a click into the view in focus");
}

void TestSceneClicks::aDoubleClickMovesNothing() {
  MeasureWindow w;
  w.session().setFocus(sceneViewId);
  const auto before = w.session().workspace().crosshairs;
  const int steps = w.session().undoStack().index();
  QWidget* scene = w.window.view();
  const QPoint at = scene->rect().center();
  QTest::mouseClick(scene, Qt::LeftButton, {}, at);
  QVERIFY(!(w.session().workspace().crosshairs == before));
  QTest::mouseDClick(scene, Qt::LeftButton, {}, at);
  QVERIFY(w.child<QAction>("maximise")->isChecked());
  QVERIFY(w.session().workspace().crosshairs == before);
  QCOMPARE(w.session().undoStack().index(), steps);
}

void TestSceneClicks::whatIsDrawnAnewIsNotFinal() {
  MeasureWindow w;
  const auto caption = [&] { return w.window.view()->caption(); };
  QTRY_VERIFY_WITH_TIMEOUT(caption().startsWith(QStringLiteral("final: ")), longest);
  w.session().edit(QStringLiteral("test"),
                   [](Scene& s) { s.camera = Camera{.target = glm::dvec3(0), .height = 77}; });
  QVERIFY2(caption().startsWith(QStringLiteral("before: ")), qPrintable(caption()));
  QTRY_VERIFY_WITH_TIMEOUT(caption().startsWith(QStringLiteral("final: ")), longest);
}

// Closes a projection and undoes that. Until the series is read again, the curve has no volume.
void TestSceneClicks::keysOnACurveWithoutItsSeries() {
  Journey w({QStringLiteral("phantom:sphere:32")});
  QVERIFY(w.settle());
  auto* mode = w.child<QComboBox>("mode");
  mode->setFocus();
  QTest::keyClick(mode, Qt::Key_Down);
  QVERIFY(w.window.session().scene().mode != Mode::composite);
  w.window.session().closeAll({});
  w.child<QAction>("undo")->trigger();
  QVERIFY(!w.window.session().series());
  auto* curve = w.child<CurveEditor>("curveEditor");
  curve->setFocus();
  for (const Qt::Key key : {Qt::Key_Tab, Qt::Key_Right, Qt::Key_Left, Qt::Key_Up})
    QTest::keyClick(curve, key);
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series(), longest);
}

VOLUMEN_TEST(TestSceneClicks);
#include "tst_scene_clicks.moc"
