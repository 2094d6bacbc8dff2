// Guards how the tools of segments look while they are used on CT, MR and PET of hospitals, by real events on
// a small screen: what is being done is seen in the picture, and no text of the window is cut off. Where
// $VOLUMEN_SHOTS names a folder, each is photographed for the eye.
#include <QComboBox>
#include <QPainter>
#include <QTableWidget>
#include <QTemporaryDir>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/hand.h"
#include "tests/ui/looks_window.h"
#include "tests/ui/window_flaws.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/curve_editor.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Look = void (*)(LooksWindow& w);

// In the chest.
constexpr glm::dvec3 pHeart(-6, 140, -542.8), pVertebra(-10, 228, -542.8), pLung(-76, 152, -542.8);
// In the head; the white matter is that of the frontal lobe, the last one lies on the border of the right
// ventricle.
constexpr glm::dvec3 pStem(-6, -14, 21), pWhite(20, -75, 45), pVentricle(-14, -45, 45);
constexpr glm::dvec3 pTumour(-19, -76, -157);

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
  QTest::qWait(500);  // 3D meanwhile
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
  QVERIFY(w.isTinted(500));
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
  QVERIFY(!w.session().tissues().empty());
  w.shot("ct-only-inside");
}

// A ball, as the brush paints one by a click.
void paintBall(LooksWindow& w, glm::dvec3 p, double mm) {
  w.session().prefer([mm](Preferences& preferences) { preferences.brush = {true, mm}; });
  w.take("paintTool");
  w.stroke({w.showPlace(p)});
  QVERIFY(w.idle());
}

void hollowedBall(LooksWindow& w) {
  paintBall(w, pStem, 60);
  w.chooseStep("shell");
  w.showPage("segmentChange", "segmentApply");
  const std::int64_t before = w.voxels(1);
  QVERIFY(w.SegmentWindow::press("segmentApply"));
  QVERIFY(w.voxels(1) > 1000 && w.voxels(1) < before);
  QVERIFY(w.isTinted(300));
  QTest::qWait(300);  // the other planes
  w.shot("mr-change");
}

// The table over the foot of the window, as it can stand on the screen, with a column in sight.
void shotOfTable(LooksWindow& w, const char* name, const char* head) {
  auto* dialog = w.child<QDialog>("segmentNumbersDialog");
  dialog->resize(1000, 440);
  QCoreApplication::processEvents();
  auto* table = w.child<QTableWidget>("segmentNumbers");
  int column = 0;
  while (column < table->columnCount() &&
         !table->horizontalHeaderItem(column)->text().startsWith(QLatin1String(head)))
    ++column;
  QVERIFY(column < table->columnCount());
  table->scrollToItem(table->item(0, column));
  QCoreApplication::processEvents();
  const QString folder = qEnvironmentVariable("VOLUMEN_SHOTS");
  if (folder.isEmpty()) return;
  QImage picture = w.window.grab().toImage();
  QPainter(&picture).drawPixmap(20, picture.height() - dialog->height() - 20, dialog->grab());
  picture.save(QDir(folder).filePath(QLatin1String(name)) + QStringLiteral(".png"));
}

bool openNumbers(LooksWindow& w, int rows) {
  w.click("segmentNumbersButton");
  const auto table = [&] { return w.child<QTableWidget>("segmentNumbers"); };
  return QTest::qWaitFor([&] { return table() && table()->rowCount() == rows; }, longest) && w.idle();
}

void tableOfNumbers(LooksWindow& w) {
  paintBall(w, pStem, 60);
  w.click("segmentAdd");
  paintBall(w, pWhite, 40);
  QVERIFY(openNumbers(w, 2));
  w.child<QTableWidget>("segmentNumbers")->selectAll();
  QCoreApplication::processEvents();
  QVERIFY(w.SegmentWindow::press("segmentNumbersCompare"));
  QVERIFY(w.child<QLabel>("segmentNumbersSaid")->text().contains(QStringLiteral("Dice 0,")));
  shotOfTable(w, "mr-numbers", "Median");
  w.child<QDialog>("segmentNumbersDialog")->close();
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
  // A copy of what is there: in a map of its own, which is worked on.
  const auto isImported = [&] { return w.workspace().segmentMaps.size() == 2 && w.count() == 1; };
  QVERIFY(QTest::qWaitFor(isImported, longest));
  w.showPlace(pVertebra);
  QVERIFY(w.isTinted(500) && w.isAtRest());
  w.shot("ct-import");
}

void smartBrush(LooksWindow& w) {
  w.showPage("segmentGrowing", "growPreview");
  w.session().prefer([](Preferences& p) { p.brush = {false, 14}; });
  w.take("smartBrushTool");
  const QPoint at = w.showPlace(pWhite);
  const std::vector<QPoint> way{at, at + QPoint(4, 8), at + QPoint(8, 20), at + QPoint(2, 30)};
  w.go(w.view(), way);
  QVERIFY(w.isTinted(100));
  w.shot("mr-smart-brush");
  w.release(w.view(), way.back());
  QVERIFY(w.voxels(1) > 50);
}

void lineOfLevel(LooksWindow& w) {
  w.showPage("segmentGrowing", "growPreview");
  w.take("levelTraceTool");
  const QPoint at = w.showPlace(pVentricle);
  const QImage before = w.seen(w.view());
  hover(w.view(), at);
  QVERIFY(LooksWindow::unlike(before, w.seen(w.view())) > 30);
  w.shot("mr-level-trace");
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.idle() && w.count() == 1 && w.voxels(1) > 100);
}

void seedsPreviewed(LooksWindow& w) {
  w.showPage("segmentGrowing", "growPreview");
  w.session().prefer([](Preferences& p) { p.brush = {true, 10}; });
  const QPoint at = w.showPlace(pStem);
  w.take("paintTool");
  w.stroke({at - QPoint(w.pixels(30), 0), at + QPoint(w.pixels(30), 0)});
  w.stroke({at - QPoint(0, w.pixels(50)), at + QPoint(0, w.pixels(50))});
  w.click("segmentAdd");
  QVERIFY(w.idle());
  w.stroke(w.roundAt(pStem, 88));
  w.click("growPreview");
  QVERIFY(w.idle());
  QVERIFY(w.isTinted(20000));
  QTest::qWait(300);  // the other planes
  w.shot("mr-grow-preview");
  QVERIFY(w.SegmentWindow::press("segmentGrow"));
  QVERIFY(w.voxels(1) > 100000);
}

void slicesFilled(LooksWindow& w) {
  w.showPage("segmentPaint", "segmentFillBetween");
  w.take("outlineTool");
  w.stroke(w.roundAt(pStem, 25));
  w.stroke(w.roundAt(pStem + glm::dvec3(8, 5, 24), 40));
  const std::int64_t before = w.voxels(1);
  QVERIFY(w.SegmentWindow::press("segmentFillBetween"));
  QVERIFY(w.voxels(1) > 5 * before);
  w.showPlace(pStem + glm::dvec3(4, 0, 12));
  QVERIFY(w.isTinted(1000) && w.isAtRest());
  w.shot("mr-fill-between");
}

void headSurface(LooksWindow& w) {
  Hand(w.window).menuOf(w.child<QToolButton>("segmentRecipes"), "recipeHead surface (MR)");
  QVERIFY(QTest::qWaitFor([&] { return w.count() == 1; }, longest) && w.isAtRest());
  QVERIFY(w.isTinted(5000));
  w.shot("mr-recipe-head");
}

// The first segment is green, which neither grey nor hot iron is.
bool greenSoon(LooksWindow& w) {
  return QTest::qWaitFor(
      [&] {
        const QImage picture = w.view()->picture();
        int count = 0;
        for (int y = 0; y < picture.height(); ++y)
          for (int x = 0; x < picture.width(); ++x)
            if (const QColor c = picture.pixelColor(x, y); c.green() > std::max(c.red(), c.blue()) + 20)
              ++count;
        return count > 300;
      },
      longest);
}

void lesionInSphere(LooksWindow& w, const QByteArray& data) {
  const auto name = [&](const char* what) { return data + "-" + what; };
  w.showPage("segmentGrowing", "growPreview");
  w.take("lesionTool");
  const QPoint at = w.showPlace(pTumour);
  QVERIFY(QTest::qWaitFor([&] { return w.areDrawn(); }, longest));
  const QPoint to = at + QPoint(w.pixels(21), w.pixels(21));
  w.go(w.view(), {at, at + QPoint(5, 5), to});
  QVERIFY(w.idle());
  QVERIFY(greenSoon(w));
  w.shot(name("lesion-sphere").constData());
  w.release(w.view(), to);
  QVERIFY(w.idle());
  QVERIFY2(w.count() == 1, qPrintable(w.child<Banner>("banner")->sentence()));
  QVERIFY(w.voxels(1) > 50);
  QVERIFY(greenSoon(w));
  QTest::qWait(500);  // the other planes
  w.shot(name("lesion-done").constData());
  QVERIFY(openNumbers(w, 1));
  shotOfTable(w, name("numbers").constData(), "TLG");
  w.child<QDialog>("segmentNumbersDialog")->close();
}

// Both were opened, so that the PET lies over its CT.
void awaitFusion(LooksWindow& w) {
  QVERIFY(QTest::qWaitFor(
      [&] { return !flatLookOf(w.workspace().view(axialViewId)).overlay.empty() && w.areDrawn(); }, longest));
  QVERIFY(w.idle());
}

}  // namespace

Q_DECLARE_METATYPE(Look)

class TestSegmentLooks : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void onCt_data();
  void onCt() { lookAtRow(); }
  void onMr_data();
  void onMr() { lookAtRow(); }
  void onPet_data();
  void onPet() { lookAtRow(); }
  void cleanupTestCase() { window_.reset(); }

 private:
  void lookAtRow();

  std::unique_ptr<LooksWindow> window_;  // opened by the first row of its data
  QString opened_;
  int firstStep_ = 0;
};

void TestSegmentLooks::onCt_data() {
  QTest::addColumn<QString>("data");
  QTest::addColumn<Look>("look");
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

void TestSegmentLooks::onMr_data() {
  QTest::addColumn<QString>("data");
  QTest::addColumn<Look>("look");
  const auto add = [](const char* name, Look look) {
    QTest::newRow(name) << QStringLiteral("mr-head-siemens-gap-175") << look;
  };
  add("smart brush", smartBrush);
  add("level trace", lineOfLevel);
  add("grow from seeds", seedsPreviewed);
  add("fill between slices", slicesFilled);
  add("change", hollowedBall);
  add("numbers", tableOfNumbers);
  add("recipe", headSurface);
}

void TestSegmentLooks::onPet_data() {
  QTest::addColumn<QString>("data");
  QTest::addColumn<Look>("look");
  QTest::newRow("lesion") << QStringLiteral("pet-ct/sts019-pet")
                          << Look([](LooksWindow& w) { lesionInSphere(w, "pet"); });
  QTest::newRow("lesion over CT") << QStringLiteral("pet-ct/sts019-ct;pet-ct/sts019-pet")
                                  << Look([](LooksWindow& w) {
                                       awaitFusion(w);
                                       lesionInSphere(w, "pet-ct");
                                     });
}

void TestSegmentLooks::lookAtRow() {
  QFETCH(QString, data);
  QFETCH(Look, look);
  if (opened_ != data) {
    QStringList paths;
    for (const QString& name : data.split(QLatin1Char(';'))) {
      const std::string path = dataPath(name.toStdString());
      NEED_DATA(path);
      paths << QString::fromStdString(path);
    }
    openAlone(false);
    window_.reset();
    window_ = std::make_unique<LooksWindow>(paths);
    QVERIFY(window_->open());
    opened_ = data;
    firstStep_ = window_->steps();
  }
  window_->begin();
  look(*window_);
  QCoreApplication::processEvents();
  const QStringList found = flaws(window_->window);
  window_->take("windowTool");
  window_->session().undoStack().setIndex(firstStep_);
  QVERIFY(window_->idle());
  QVERIFY2(found.isEmpty(), qPrintable(found.join(QLatin1Char('\n'))));
}

VOLUMEN_TEST(TestSegmentLooks);
#include "tst_segment_looks.moc"
