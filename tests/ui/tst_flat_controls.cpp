// Guards settings of flat views in the window: interpolation, slab, and the window typed in the corner. The
// clip box of the 3D scene is seen and dragged in slices. Real mouse and key events.
#include <QCheckBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTreeWidget>

#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/views/clip_lines.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct FlatWindow : MeasureWindow {
  FlatLook look(ViewId id = axialViewId) { return flatLookOf(session().workspace().view(id)); }
  int steps() { return session().undoStack().index(); }
  // Opens a submenu of View.
  QMenu* opened(const char* name) {
    auto* menu = child<QMenu>(name);
    menu->popup(window.mapToGlobal(QPoint(60, 60)));
    return menu;
  }
  void choose(const char* menuName, const char* action) {
    QMenu* menu = opened(menuName);
    auto* entry = menu->findChild<QAction*>(QLatin1String(action));
    QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(entry).center());
  }
  // Returns the position of the window's numbers.
  QPoint corner(ViewId id = axialViewId) {
    FlatView* v = view(id);
    const Overlays over = v->overlays();
    for (const PlacedText& text :
         placeOverlays(over, QRectF(v->rect()).adjusted(0, 0, -6, 0), v->font()).texts)
      if (text.text == over.bottomRight) return text.rect.center().toPoint();
    return {};
  }
  std::optional<Window> flatWindowSet() {
    return session().workspace().series.at(view()->state().series).window;
  }
  Clip clip() { return session().scene().clip; }
  std::vector<ClipLine> lines(bool whole, ViewId id = axialViewId) {
    FlatView* v = view(id);
    const SlicePress press{session(), id, v->shown(), *v->plane(), v->devicePixelRatioF(), {}};
    return clipLines(press, whole);
  }
};

}  // namespace

class TestFlatControls : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void interpolationIsSwitched();
  void aSlabIsTyped();
  void aModeMakesASlab();
  void theWindowIsTyped();
  void typingGivenUp();
  void whatIsNoNumberStays();
  void theClipBoxIsSeen();
  void aClipEdgeIsDragged();
  void aSegmentIsTinted();
};

void TestFlatControls::interpolationIsSwitched() {
  FlatWindow w;
  auto* action = w.child<QAction>("interpolate");
  QVERIFY(action->isEnabled() && action->isChecked());
  const int before = w.steps();
  action->trigger();
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) {
    QVERIFY(w.look(id).nearest);
    QCOMPARE(w.view(id)->plane()->interpolation, Interpolation::nearest);
  }
  QCOMPARE(w.steps(), before + 1);
  w.undo();
  QVERIFY(!w.look().nearest && action->isChecked());
}

void TestFlatControls::aSlabIsTyped() {
  FlatWindow w;
  QMenu* menu = w.opened("slabMenu");
  auto* field = menu->findChild<QDoubleSpinBox*>(QStringLiteral("slabThickness"));
  QVERIFY(field && field->isVisible());
  const int before = w.steps();
  field->setFocus();
  field->selectAll();
  QTest::keyClicks(field, QStringLiteral("12.5"));
  QTest::keyClick(field, Qt::Key_Return);
  menu->close();
  QCOMPARE(w.look().slabMm, 12.5);
  QCOMPARE(w.look(coronalViewId).slabMm, 0.0);
  QCOMPARE(w.steps(), before + 1);
  QVERIFY(w.view()->overlays().topRight.contains(QStringLiteral("MIP 12.5 mm")));
}

void TestFlatControls::aModeMakesASlab() {
  FlatWindow w;
  const int before = w.steps();
  w.choose("slabMenu", "slabMean");
  QCOMPARE(w.look().slabMm, 10.0);
  QCOMPARE(w.look().slabMode, SlabMode::mean);
  w.choose("slabMenu", "slabMin");
  QCOMPARE(w.look().slabMode, SlabMode::min);
  QCOMPARE(w.steps(), before + 2);
  QVERIFY(w.view()->overlays().topRight.contains(QStringLiteral("MinIP 10.0 mm")));
}

void TestFlatControls::theWindowIsTyped() {
  FlatWindow w;
  const int before = w.steps();
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, w.corner());
  auto *width = w.child<QLineEdit>("flatWindowWidth"), *centre = w.child<QLineEdit>("flatWindowCentre");
  QVERIFY(width && centre && width->isVisible());
  w.shot("window-typed");
  QTest::keyClicks(width, QStringLiteral("350"));
  QTest::keyClick(width, Qt::Key_Tab);
  QTest::keyClicks(centre, QStringLiteral("-12,5"));
  QTest::keyClick(centre, Qt::Key_Return);
  QVERIFY(w.flatWindowSet() == (Window{-12.5, 350}));
  QCOMPARE(w.view()->overlays().bottomRight, QStringLiteral("W 350.0 L -12.5"));
  QCOMPARE(w.steps(), before + 1);
  QVERIFY(!width->isVisible());
  w.undo();
  QVERIFY(!w.flatWindowSet());
}

void TestFlatControls::typingGivenUp() {
  FlatWindow w;
  const int before = w.steps();
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, w.corner());
  auto* width = w.child<QLineEdit>("flatWindowWidth");
  QTest::keyClicks(width, QStringLiteral("350"));
  QTest::keyClick(width, Qt::Key_Escape);
  QVERIFY(!width->isVisible() && !w.flatWindowSet());
  QCOMPARE(w.steps(), before);
}

void TestFlatControls::whatIsNoNumberStays() {
  FlatWindow w;
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, w.corner());
  auto* width = w.child<QLineEdit>("flatWindowWidth");
  for (const char* typed : {"wide", "0", "-5"}) {
    width->selectAll();
    QTest::keyClicks(width, QLatin1String(typed));
    QTest::keyClick(width, Qt::Key_Return);
    QVERIFY(width->isVisible() && width->hasSelectedText() && !w.flatWindowSet());
  }
}

// Each plane shows four edges at the box's faces. The whole box has none unless the panel is shown.
void TestFlatControls::theClipBoxIsSeen() {
  FlatWindow w;
  QVERIFY(w.lines(false).empty());
  QCOMPARE(w.lines(true).size(), std::size_t(4));
  w.session().edit(QStringLiteral("test"), [](Scene& s) { s.clip.boxHigh = {0.75, 1, 1}; });
  const VoxelGeometry& geometry = w.view()->shown()->volume->geometry();
  const double x = geometry.patientFromVoxel({0.75 * 32 - 0.5, 0, 0}).x;
  int found = 0;
  for (const ClipLine& line : w.lines(false)) {
    if (line.axis != 0 || !line.high) continue;
    ++found;
    for (const QPointF end : {line.line.p1(), line.line.p2()}) QVERIFY(std::abs(w.patient(end).x - x) < 1e-9);
  }
  QCOMPARE(found, 1);
  // A slice outside the box shows no edges.
  w.session().edit(QStringLiteral("test"), [](Scene& s) { s.clip.boxHigh.z = 0.1; });
  QVERIFY(w.lines(false).empty());
}

void TestFlatControls::aClipEdgeIsDragged() {
  FlatWindow w;
  w.session().edit(QStringLiteral("test"), [](Scene& s) { s.clip.boxHigh = {0.75, 1, 1}; });
  w.session().endGesture();
  const auto all = w.lines(false);
  const auto right = std::ranges::find_if(all, [](const ClipLine& l) { return l.axis == 0 && l.high; });
  QVERIFY(right != all.end());
  const int before = w.steps();
  // Starts beside the crosshair's line, which lies in the middle.
  const QPointF from = right->line.pointAt(0.3), to = from - QPointF(30, 0);
  drag(w.view(), from, to);
  const double moved = (w.patient(to).x - w.patient(from).x) / 32;
  QVERIFY(std::abs(w.clip().boxHigh.x - (0.75 + moved)) < 0.01 && moved < -0.05);
  QCOMPARE(w.clip().boxHigh.y, 1.0);
  QCOMPARE(w.clip().boxLow, glm::dvec3(0));
  QCOMPARE(w.steps(), before + 1);
  w.shot("clip-lines");
  w.undo();
  QCOMPARE(w.clip().boxHigh.x, 0.75);
}

// The ball of 1000 HU in its middle slice is tinted inside, grey beside, and grey again when everything is
// shown. The segment itself is hidden.
void TestFlatControls::aSegmentIsTinted() {
  FlatWindow w;
  w.child<QDockWidget>("segmentDock")->raise();
  w.child<QDoubleSpinBox>("segmentLow")->setValue(500);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(1000);
  QTest::mouseClick(w.child<QPushButton>("segment"), Qt::LeftButton);
  auto* only = w.child<QCheckBox>("segmentOnly");
  QTRY_VERIFY_WITH_TIMEOUT(only->isEnabled(), longest);
  auto* list = w.child<QTreeWidget>("segmentList");
  list->topLevelItem(0)->setCheckState(0, Qt::Unchecked);
  const auto at = [&](glm::dvec3 p) {
    const glm::dvec2 pixel = w.view()->plane()->pixelFromPatient(p);
    return w.view()->picture().pixel(int(pixel.x), int(pixel.y));
  };
  const auto isGrey = [](QRgb c) { return qRed(c) == qGreen(c) && qGreen(c) == qBlue(c); };
  const double z = w.view()->plane()->centre.z;
  QTRY_VERIFY_WITH_TIMEOUT(isGrey(at({3, -2, z})), longest);
  QSignalSpy settled(w.view(), &FlatView::settled);
  only->click();
  QVERIFY(settled.wait(longest));
  QVERIFY(!isGrey(at({3, -2, z})) && qRed(at({3, -2, z})) > qBlue(at({3, -2, z})));
  QVERIFY(isGrey(at({-13, 13, z})));
  w.shot("segment-tinted");
  settled.clear();
  only->click();
  QVERIFY(settled.wait(longest));
  QVERIFY(isGrey(at({3, -2, z})));
}

VOLUMEN_TEST(TestFlatControls);
#include "tst_flat_controls.moc"
