// Guards the tool of connected parts, in slices and in 3D: what a click adds, keeps and removes, one undo
// step each.
#include <QComboBox>

#include "tests/ui/segment_window.h"
#include "tests/ui/surface_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "viewer/segment/parts.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// The part of a mask at which a place is.
BitMask partAt(const BitMask& mask, glm::dvec3 p) {
  const glm::ivec3 seed(glm::round(mask.geometry().voxelFromPatient(p)));
  return connected(mask, std::span(&seed, 1), Neighbours::faces);
}

constexpr glm::dvec3 inAir(18, -18, 12);

}  // namespace

class TestConnectedPart : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aClickTakesTheConnectedPart();
  void withKeysOrThePanelThePartIsKeptOrRemoved_data();
  void withKeysOrThePanelThePartIsKeptOrRemoved();
  void aClickBesideSaysWhyThereIsNone();
  void aClickInThreeDTakesWhatIsSeen();
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
  // A second one is added to it; the tool is still in hand.
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

void TestConnectedPart::withKeysOrThePanelThePartIsKeptOrRemoved_data() {
  QTest::addColumn<int>("keys");
  QTest::addColumn<int>("use");
  QTest::addColumn<bool>("kept");
  QTest::newRow("Ctrl keeps it") << int(Qt::ControlModifier) << 0 << true;
  QTest::newRow("Alt removes it") << int(Qt::AltModifier) << 0 << false;
  QTest::newRow("the panel keeps it") << 0 << 1 << true;
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

void TestConnectedPart::aClickBesideSaysWhyThereIsNone() {
  SegmentWindow w;
  QVERIFY(w.make(800, 1200));
  w.child<QAction>("partTool")->trigger();
  const QPoint at = w.showPlace(inAir);
  const Workspace before = w.workspace();
  auto* banner = w.child<Banner>("banner");
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.idle());
  QVERIFY(banner->sentence().contains(QStringLiteral("not in the range")));
  QTest::mouseClick(w.view(), Qt::LeftButton, Qt::ControlModifier, at);
  QVERIFY(w.idle());
  QVERIFY(banner->sentence().contains(QStringLiteral("not in the current segment")));
  QVERIFY(w.workspace() == before);
}

// The ball is all that there is above 500.
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
