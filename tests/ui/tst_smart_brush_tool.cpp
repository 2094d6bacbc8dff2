// Guards the smart brush. A stroke paints only voxels that are connected to the pointer and similar to those
// under the brush at the press. It is one undo step.
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSmartBrushTool : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void onlyWhatIsAlikeIsPainted_data();
  void onlyWhatIsAlikeIsPainted();
};

void TestSmartBrushTool::onlyWhatIsAlikeIsPainted_data() {
  QTest::addColumn<bool>("isBall");
  QTest::addColumn<bool>("isOblique");
  QTest::newRow("a disc") << false << false;
  QTest::newRow("a ball, oblique") << true << true;
}

// A stroke goes from the core of the hollow ball into its shell. The shell lies under the brush, but is not
// similar.
void TestSmartBrushTool::onlyWhatIsAlikeIsPainted() {
  QFETCH(bool, isBall);
  QFETCH(bool, isOblique);
  SegmentWindow w;
  w.session().prefer([&](Preferences& p) {
    p.brush.ball = isBall;
    p.brush.diameterMm = 5;
  });
  w.showPlace(glm::dvec3(-4.5));
  if (isOblique) w.turnPlanes();
  const SlicePlane plane = *w.view()->plane();
  const glm::dvec2 pixel = plane.pixelFromPatient(glm::dvec3(-4.5));
  const QPoint from{int(pixel.x), int(pixel.y)}, to(from.x() + int(8 / plane.mmPerPixel), from.y());
  w.child<QAction>("smartBrushTool")->trigger();
  const Workspace before = w.workspace();
  const int steps = w.steps();
  drag(w.view(), from, to);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  const BitMask made = w.mask(w.current().number);
  QVERIFY(made.count() > (isBall ? 60 : 15));
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i)
        if (made.at({i, j, k})) QVERIFY(isCore(glm::dvec3(i, j, k) - 19.5));
  const Workspace after = w.workspace();
  w.undo();
  QVERIFY(w.workspace() == before);
  w.redo();
  QVERIFY(w.workspace() == after);
}

VOLUMEN_TEST(TestSmartBrushTool);
#include "tst_smart_brush_tool.moc"
