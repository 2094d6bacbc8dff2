// Guards how segment tools look in use on hospital CT, by real events on a small screen. The picture shows
// the current act, and no text of the window is cut off. If $VOLUMEN_SHOTS names a folder, takes screenshots.
#include <QComboBox>
#include <QTemporaryDir>

#include "tests/ui/hand.h"
#include "tests/ui/look_rows.h"
#include "ui/widgets/curve_editor.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Positions in the chest.
constexpr glm::dvec3 pHeart(-6, 140, -542.8), pVertebra(-10, 228, -542.8), pLung(-76, 152, -542.8);

void curveEnd(LooksWindow& w) {
  w.window.resizeDocks({w.child<QDockWidget>("transferDock"), w.child<QDockWidget>("segmentDock")},
                       {330, 330}, Qt::Vertical);
  w.click("segmentFromCurve");
  auto* curve = w.child<CurveEditor>("curveEditor");
  curve->showValues(-1000, 1500);
  w.showPlace(pVertebra);
  w.child<QDoubleSpinBox>("segmentLow")->setValue(100);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(1200);
  QCoreApplication::processEvents();
  const QPoint flag = curve->rangeHandle(0).center().toPoint(), to = flag + QPoint(12, 0);
  w.press(curve, flag);
  w.move(curve, to);
  QVERIFY(w.child<QDoubleSpinBox>("segmentLow")->value() > 120);
  QVERIFY(w.isTinted(300));
  QTest::qWait(500);  // waits for 3D
  w.shot("ct-curve-end");
  w.release(curve, to);
}

void connectedPart(LooksWindow& w) {
  w.showPage("segmentFromCurve", "segmentPartUse");
  w.child<QDoubleSpinBox>("segmentLow")->setValue(-1024);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(-500);
  w.take("partTool");
  const QPoint at = w.showPlace(pLung);
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.idle());
  QVERIFY(w.count() == 1 && w.voxels(1) > 500000);
  QVERIFY(w.isTinted(5000) && w.isAtRest());
  w.shot("ct-connected-part");
}

void paintStroke(LooksWindow& w) {
  w.showPage("segmentPaint", "segmentFillBetween");
  w.child<QDoubleSpinBox>("brushMm")->setValue(25);
  w.take("paintTool");
  const QPoint at = w.showPlace(pHeart);
  w.go(w.view(), {at - QPoint(40, 0), at - QPoint(10, 20), at + QPoint(25, 10)});
  QVERIFY(w.isTinted(1000));
  w.shot("ct-paint-stroke");
  w.release(w.view(), at + QPoint(25, 10));
  QVERIFY(w.voxels(1) > 1000);
}

void outlineDrawn(LooksWindow& w) {
  w.showPage("segmentPaint", "segmentFillBetween");
  w.take("outlineTool");
  std::vector<QPoint> way = w.roundAt(pHeart, 55);
  way.resize(19);
  const QImage before = w.seen(w.view());
  w.go(w.view(), way);
  QVERIFY(LooksWindow::unlike(before, w.seen(w.view())) > 100);
  w.shot("ct-outline-drawn");
  w.release(w.view(), way.back());
  QVERIFY(w.isTinted(2000) && w.voxels(1) > 5000);
  w.shot("ct-outline-done");
}

void cutInSlice(LooksWindow& w) {
  QVERIFY(w.make(180, 2000));
  w.showPage("segmentPaint", "segmentFillBetween");
  w.take("segmentScissorsTool");
  const std::vector<QPoint> way = w.roundAt(pVertebra, 45);
  QVERIFY(w.isTinted(500) && w.isAtRest());
  const std::int64_t before = w.voxels(1);
  w.go(w.view(), way);
  w.shot("ct-cut-in-slice-drawn");
  w.release(w.view(), way.back());
  QVERIFY(w.idle());
  QVERIFY(w.voxels(1) < before - 10000);
}

void cutIn3d(LooksWindow& w) {
  Hand(w.window).menuOf(w.child<QToolButton>("segmentRecipes"), "recipeBone");
  QVERIFY(QTest::qWaitFor([&] { return w.count() == 1; }, longest) && w.isAtRest());
  w.shot("ct-recipe-bone");
  w.showPage("segmentPaint", "segmentFillBetween");
  w.take("segmentScissorsTool");
  const QPoint middle = w.scene()->rect().center();
  const std::vector<QPoint> way{middle + QPoint(10, -90), middle + QPoint(120, -80), middle + QPoint(125, 0),
                                middle + QPoint(110, 90), middle + QPoint(20, 70)};
  const std::int64_t before = w.voxels(1);
  w.session().setFocus(sceneViewId);
  w.go(w.scene(), way);
  w.shot("ct-cut-in-3d-drawn");
  w.release(w.scene(), way.back());
  QVERIFY(w.idle());
  QVERIFY(w.voxels(1) < before - 10000);
  QVERIFY(w.isAtRest());
  w.shot("ct-cut-in-3d-done");
}

void onlyInside(LooksWindow& w) {
  w.take("outlineTool");
  const std::vector<QPoint> way = w.roundAt(pHeart, 70);
  w.stroke(way);
  QVERIFY(w.voxels(1) > 5000);
  w.click("segmentsIn3d");
  QVERIFY(w.step("grow"));
  auto* where = w.child<QComboBox>("segmentTissue");
  QTest::keyClick(where, Qt::Key_Down);
  auto* margin = w.child<QDoubleSpinBox>("segmentTissueMargin");
  margin->setValue(20);
  QVERIFY(w.isAtRest());
  QVERIFY(!w.scenes().tissues().entries().empty());
  w.shot("ct-only-inside");
}

void importFile(LooksWindow& w) {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("bone.seg.nrrd"));
  paintBall(w, pVertebra, 60);
  w.take("exportSegments");
  answer(w, "segmentDialog", path);
  QVERIFY(w.idle() && QFile::exists(path));
  QMimeData files;
  files.setUrls({QUrl::fromLocalFile(path)});
  QVERIFY(drop(files, w.view()));
  // A copy of existing segments is imported into its own map, which becomes active.
  const auto isImported = [&] { return w.workspace().segmentMaps.size() == 2 && w.count() == 1; };
  QVERIFY(QTest::qWaitFor(isImported, longest));
  w.showPlace(pVertebra);
  QVERIFY(w.isTinted(500) && w.isAtRest());
  w.shot("ct-import");
}

}  // namespace

class TestSegmentLooksOnCt : public LookRows {
  Q_OBJECT
 private Q_SLOTS:
  void onCt_data();
  void onCt() { lookAtRow(); }
  void cleanupTestCase() { closeWindow(); }
};

void TestSegmentLooksOnCt::onCt_data() {
  addColumns();
  const auto add = [](const char* name, Look look) {
    QTest::newRow(name) << QStringLiteral("ct-chest-lidc0314-138") << look;
  };
  add("an end on the axis of the curve", curveEnd);
  add("connected part", connectedPart);
  add("paint", paintStroke);
  add("outline", outlineDrawn);
  add("cut in a slice", cutInSlice);
  add("recipe and cut in 3D", cutIn3d);
  add("only inside segments", onlyInside);
  add("import", importFile);
}

VOLUMEN_TEST(TestSegmentLooksOnCt);
#include "tst_segment_looks_on_ct.moc"
