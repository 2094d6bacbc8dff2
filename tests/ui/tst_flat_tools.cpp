// Guards that visible buttons, one at a time, choose what a left drag does in slices, beside measuring.
#include <QToolBar>

#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct Seen {
  std::optional<Window> window;
  glm::dvec2 panMm{0};
  double zoom = 1;
  glm::dvec3 at{0};

  explicit Seen(MeasureWindow& w) {
    const ViewState& state = w.view()->state();
    const FlatLook look = flatLookOf(state);
    window = w.session().workspace().series.at(state.series).window;
    panMm = look.panMm;
    zoom = look.zoom;
    at = crosshairOf(w.session().workspace(), axialViewId, *w.view()->shown()).at;
  }
};

}  // namespace

class TestFlatTools : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aDragDoesWhatTheButtonSays_data();
  void aDragDoesWhatTheButtonSays();
  void oneOfThemIsChosen();
  void keysChooseThem_data();
  void keysChooseThem();
};

void TestFlatTools::aDragDoesWhatTheButtonSays_data() {
  QTest::addColumn<QByteArray>("changed");
  for (const char* tool : {"window", "scroll", "pan", "zoom", "crosshair", "magnifier"})
    QTest::newRow(tool) << QByteArray(tool);
}

void TestFlatTools::aDragDoesWhatTheButtonSays() {
  QFETCH(QByteArray, changed);
  MeasureWindow w;
  QAction* action = w.child<QAction>((changed + "Tool").constData());
  QWidget* button = w.child<QToolBar>("tools")->widgetForAction(action);
  QTest::mouseClick(button, Qt::LeftButton);
  QVERIFY(action->isChecked());
  QTest::mouseClick(button, Qt::LeftButton);
  QVERIFY(action->isChecked());
  const Seen before(w);
  drag(w.view(), {90, 90}, {100, 130});
  const Seen after(w);
  QCOMPARE(before.window != after.window, changed == "window");
  QCOMPARE(before.panMm != after.panMm, changed == "pan" || changed == "zoom");
  QCOMPARE(before.zoom != after.zoom, changed == "zoom");
  QCOMPARE(before.at != after.at, changed == "scroll" || changed == "crosshair");
}

void TestFlatTools::oneOfThemIsChosen() {
  MeasureWindow w;
  const auto chosen = [&] {
    QStringList names;
    for (const QAction* action : w.child<QToolBar>("tools")->actions())
      if (action->isChecked()) names << action->objectName();
    names.removeAll(QStringLiteral("rotateTool"));  // belongs to 3D
    return names.join(QLatin1Char(' '));
  };
  QCOMPARE(chosen(), QStringLiteral("windowTool"));
  w.child<QAction>("scrollTool")->trigger();
  QCOMPARE(chosen(), QStringLiteral("scrollTool"));
  QTest::keyClick(w.view(), Qt::Key_D);  // takes the length tool
  QCOMPARE(chosen(), QString());
  QTest::keyClick(w.view(), Qt::Key_W);
  QCOMPARE(chosen(), QStringLiteral("windowTool"));
}

void TestFlatTools::keysChooseThem_data() {
  QTest::addColumn<int>("key");
  QTest::addColumn<QByteArray>("tool");
  QTest::newRow("M") << int(Qt::Key_M) << QByteArray("pan");
  QTest::newRow("Z") << int(Qt::Key_Z) << QByteArray("zoom");
  QTest::newRow("B") << int(Qt::Key_B) << QByteArray("scroll");
  QTest::newRow("Y") << int(Qt::Key_Y) << QByteArray("crosshair");
  QTest::newRow("W") << int(Qt::Key_W) << QByteArray("window");
}

// The keys work in a slice and do nothing in 3D.
void TestFlatTools::keysChooseThem() {
  QFETCH(int, key);
  QFETCH(QByteArray, tool);
  MeasureWindow w;
  w.choose(ShapeKind::cobb);
  w.view()->setFocus();
  QTest::keyClick(w.view(), Qt::Key(key));
  QCOMPARE(QByteArray(w.window.views()->tool().name), tool);
  const QAction* action = w.child<QAction>((tool + "Tool").constData());
  QVERIFY(action->isChecked());
  QVERIFY(action->toolTip().contains(QStringLiteral("(%1)").arg(QChar(char16_t(key)))));
  w.window.views()->setTool(toolNamed("length"));
  w.session().setFocus(sceneViewId);
  const Camera before = w.window.view()->camera();
  if (tool != "window") QTest::keyClick(w.window.view(), Qt::Key(key));
  QCOMPARE(QByteArray(w.window.views()->tool().name), QByteArray("length"));
  QVERIFY(w.window.view()->camera() == before);
}

VOLUMEN_TEST(TestFlatTools);
#include "tst_flat_tools.moc"
