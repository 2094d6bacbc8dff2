// Guards how segment tools look in use on hospital MR and PET, by real events on a small screen. The picture
// shows the current act, and no text of the window is cut off. If $VOLUMEN_SHOTS names a folder, takes
// screenshots.
#include <QComboBox>
#include <QPainter>
#include <QTableWidget>

#include "tests/ui/hand.h"
#include "tests/ui/look_rows.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Positions in the head. The white matter is that of the frontal lobe. The last one lies on the border of the
// right ventricle.
constexpr glm::dvec3 pStem(-6, -14, 21), pWhite(20, -75, 45), pVentricle(-14, -45, 45);
constexpr glm::dvec3 pTumour(-19, -76, -157);

void hollowedBall(LooksWindow& w) {
  paintBall(w, pStem, 60);
  w.chooseStep("shell");
  w.showPage("segmentChange", "segmentApply");
  const std::int64_t before = w.voxels(1);
  QVERIFY(w.SegmentWindow::press("segmentApply"));
  QVERIFY(w.voxels(1) > 1000 && w.voxels(1) < before);
  QVERIFY(w.isTinted(300));
  QTest::qWait(300);  // waits for the other planes
  w.shot("mr-change");
}

// Moves the statistics table to the window's foot, as on a real screen, and scrolls to a column.
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
  QTest::qWait(300);  // waits for the other planes
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

// Waits for the first segment's green, which occurs neither in grey nor in hot iron.
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
  QTest::qWait(500);  // waits for the other planes
  w.shot(name("lesion-done").constData());
  QVERIFY(openNumbers(w, 1));
  shotOfTable(w, name("numbers").constData(), "TLG");
  w.child<QDialog>("segmentNumbersDialog")->close();
}

// Waits until the PET lies over its CT. Both were opened.
void awaitFusion(LooksWindow& w) {
  QVERIFY(QTest::qWaitFor(
      [&] { return !flatLookOf(w.workspace().view(axialViewId)).overlay.empty() && w.areDrawn(); }, longest));
  QVERIFY(w.idle());
}

}  // namespace

class TestSegmentLooks : public LookRows {
  Q_OBJECT
 private Q_SLOTS:
  void onMr_data();
  void onMr() { lookAtRow(); }
  void onPet_data();
  void onPet() { lookAtRow(); }
  void cleanupTestCase() { closeWindow(); }
};

void TestSegmentLooks::onMr_data() {
  addColumns();
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
  addColumns();
  QTest::newRow("lesion") << QStringLiteral("pet-ct/sts019-pet")
                          << Look([](LooksWindow& w) { lesionInSphere(w, "pet"); });
  QTest::newRow("lesion over CT") << QStringLiteral("pet-ct/sts019-ct;pet-ct/sts019-pet")
                                  << Look([](LooksWindow& w) {
                                       awaitFusion(w);
                                       lesionInSphere(w, "pet-ct");
                                     });
}

VOLUMEN_TEST(TestSegmentLooks);
#include "tst_segment_looks.moc"
