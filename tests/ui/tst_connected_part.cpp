// Guards the connected component tool in slices and in 3D: what a click adds, keeps and removes, one undo
// step each.
#include <QComboBox>

#include "results/segments/segment_record.h"
#include "tests/ui/segment_window.h"
#include "tests/ui/surface_window.h"
#include "tests/unit/suite.h"
#include "viewer/segment/parts.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns the connected component of a mask at a position.
BitMask partAt(const BitMask& mask, glm::dvec3 p) {
  const glm::ivec3 seed(glm::round(mask.geometry().voxelFromPatient(p)));
  return connected(mask, std::span(&seed, 1), Neighbours::faces);
}

constexpr double widerThanRod = 2;  // mm
bool isIn(const BitMask& mask, glm::dvec3 p) {
  return mask.at(glm::ivec3(glm::round(mask.geometry().voxelFromPatient(p))));
}
// Types a value and presses Return.
void typeInto(QDoubleSpinBox* field, double value) {
  field->selectAll();
  QTest::keyClicks(field, QLocale().toString(value));
  QTest::keyClick(field, Qt::Key_Return);
}

}  // namespace

class TestConnectedPart : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aClickTakesTheConnectedPart();
  void aClickInAnyPlaneTakesIt_data();
  void aClickInAnyPlaneTakesIt();
  void withKeysOrThePanelThePartIsKeptOrRemoved_data();
  void withKeysOrThePanelThePartIsKeptOrRemoved();
  void aClickInThreeDTakesWhatIsSeen();
  void aLeakGuardStopsAtThinBridges();
  void escPutsTheToolAway();
};

void TestConnectedPart::aClickTakesTheConnectedPart() {
  SegmentWindow w;
  w.child<QDoubleSpinBox>("segmentLow")->setValue(800);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(1200);
  w.child<QAction>("partTool")->trigger();
  QPoint at = w.showPlace(inSmallBall);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(w.count(), std::size_t(1));
  QCOMPARE(w.voxels(1), voxelsWhere(isSmall));
  QVERIFY(w.segment(0).range == (ValueRange{800, 1200}));
  const Workspace one = w.workspace();
  // A second component is added. The tool stays active.
  at = w.showPlace(inShell);
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.idle());
  QCOMPARE(w.count(), std::size_t(1));
  QCOMPARE(w.voxels(1), voxelsWhere([](glm::dvec3 p) { return isShell(p) || isSmall(p); }));
  w.undo(), w.undo();
  QVERIFY(w.workspace() == one);
  w.undo();
  QVERIFY(w.workspace() == before);
}

void TestConnectedPart::aClickInAnyPlaneTakesIt_data() {
  QTest::addColumn<int>("view");
  QTest::addColumn<bool>("isOblique");
  QTest::newRow("coronal") << int(coronalViewId) << false;
  QTest::newRow("sagittal") << int(sagittalViewId) << false;
  QTest::newRow("oblique") << int(axialViewId) << true;
  QTest::newRow("oblique sagittal") << int(sagittalViewId) << true;
}

void TestConnectedPart::aClickInAnyPlaneTakesIt() {
  QFETCH(int, view);
  QFETCH(bool, isOblique);
  SegmentWindow w;
  w.child<QDoubleSpinBox>("segmentLow")->setValue(800);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(1200);
  w.child<QAction>("partTool")->trigger();
  w.showPlace(inSmallBall, ViewId(view));
  if (isOblique) w.turnPlanes();
  const glm::dvec2 pixel = w.view(ViewId(view))->plane()->pixelFromPatient(inSmallBall);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  QTest::mouseClick(w.view(ViewId(view)), Qt::LeftButton, {}, {int(pixel.x), int(pixel.y)});
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(w.voxels(1), voxelsWhere(isSmall));
  const Workspace after = w.workspace();
  w.undo();
  QVERIFY(w.isAs(before));
  w.redo();
  QVERIFY(w.workspace() == after);
}

void TestConnectedPart::withKeysOrThePanelThePartIsKeptOrRemoved_data() {
  QTest::addColumn<int>("keys");
  QTest::addColumn<int>("use");
  QTest::addColumn<bool>("kept");
  QTest::newRow("Ctrl keeps it") << int(Qt::ControlModifier) << 0 << true;
  QTest::newRow("the panel removes it") << 0 << 2 << false;
}

void TestConnectedPart::withKeysOrThePanelThePartIsKeptOrRemoved() {
  QFETCH(int, keys);
  QFETCH(int, use);
  QFETCH(bool, kept);
  SegmentWindow w;
  QVERIFY(w.make(800, 1200));
  const BitMask own = w.mask(1), part = partAt(own, inSmallBall);
  w.child<QComboBox>("segmentPartUse")->setCurrentIndex(use);
  w.child<QAction>("partTool")->trigger();
  const QPoint at = w.showPlace(inSmallBall);
  const int steps = w.steps();
  QTest::mouseClick(w.view(), Qt::LeftButton, Qt::KeyboardModifiers(keys), at);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(!part.empty() && part != own);
  QVERIFY(w.mask(1) == (kept ? part : subtracted(own, part)));
}

// The ball is all there is above 500.
void TestConnectedPart::aClickInThreeDTakesWhatIsSeen() {
  SurfaceWindow w;
  const auto idle = [&] { return QTest::qWaitFor([&] { return w.window.jobs().rows().empty(); }, longest); };
  w.child<QDoubleSpinBox>("segmentLow")->setValue(500);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(3000);
  w.child<QAction>("partTool")->trigger();
  const int steps = w.session().undoStack().index();
  w.click(w.pixelOf({0, -12, 0}));
  QVERIFY(idle());
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  const SegmentMap& map = w.session().workspace().segmentMaps.front();
  std::int64_t expected = 0;
  const Volume& volume = *w.session().series()->volume;
  for (std::int64_t n = 0; n < volume.geometry().voxelCount(); ++n)
    expected += volume.valueAt(std::size_t(n)) >= 500;
  QCOMPARE(maskOf(*map.labels, 1).count(), expected);
  w.click({3, 3});
  QVERIFY(idle());
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  QVERIFY(w.told().contains(QStringLiteral("Nothing is seen there")));
}

void TestConnectedPart::aLeakGuardStopsAtThinBridges() {
  SegmentWindow w(joinedBalls());
  w.child<QDoubleSpinBox>("segmentLow")->setValue(500);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(1500);
  auto* field = w.child<QDoubleSpinBox>("segmentLeakGuard");
  QCOMPARE(field->text(), QStringLiteral("Off"));
  typeInto(field, widerThanRod);
  QTest::keyClick(w.child<QComboBox>("segmentPartNeighbours"), Qt::Key_Down);
  w.child<QAction>("partTool")->trigger();
  const QPoint at = w.showPlace(inLeftBall);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  const BitMask made = w.mask(1);
  QVERIFY(isIn(made, inLeftBall) && !isIn(made, inRightBall));
  for (const char* stated : {"leakGuardMm", "\"edges\""})
    QVERIFY2(stepsJson(w.map()->steps).find(stated) != std::string::npos, stated);
  w.undo();
  QVERIFY(w.isAs(before));
  QCOMPARE(field->value(), widerThanRod);
}

void TestConnectedPart::escPutsTheToolAway() {
  SegmentWindow w;
  const Tool& before = w.window.views()->tool();
  w.child<QAction>("partTool")->trigger();
  QCOMPARE(&w.window.views()->tool(), &toolNamed("part"));
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QCOMPARE(&w.window.views()->tool(), &before);
}

VOLUMEN_TEST(TestConnectedPart);
#include "tst_connected_part.moc"
