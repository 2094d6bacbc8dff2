// Guards the flat views with real mouse and key events in a real window.
#include <QMimeData>
#include <QTreeWidget>

#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/flat_plane.h"

using namespace volumen;
using volumen::tests::Journey;
using volumen::tests::longest;
using volumen::tests::wheel;

namespace {

// A window that shows a ball of 1000 HU, 10 mm about a point, in planes.
struct Planes : Journey {
  Planes() {
    window.session().show(tests::ballSeries(32, 10, {3, -2, 4}));
    child<QAction>("layoutPlanes")->trigger();
    for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) shows(id);
  }
  FlatView* view(ViewId id) { return window.views()->viewAs<FlatView>(id); }
  Session& session() { return window.session(); }
  // Returns whether the picture of the workspace comes on screen.
  bool shows(ViewId id) {
    QSignalSpy shown(view(id), &FlatView::settled);
    return !view(id)->picture().isNull() || shown.wait(longest);
  }
  // Does `act` and waits for its picture.
  bool after(ViewId id, const std::function<void()>& act) {
    QSignalSpy shown(view(id), &FlatView::settled);
    act();
    return !shown.isEmpty() || shown.wait(longest);
  }
  Crosshair crosshair() { return crosshairOf(session().workspace(), *session().series()); }
  glm::dvec3 cursor() { return crosshair().at; }
  StackPlace place(ViewId id) {
    return stackPlace(session().series()->volume->geometry(), session().workspace().view(id).kind,
                      crosshair());
  }
  Window shownWindow() {
    const auto& state = session().workspace().series.begin()->second;
    return state.window.value_or(session().series()->window);
  }
  // Returns the position of a point in a view, logical pixels.
  QPointF pixel(ViewId id, glm::dvec3 p) {
    const glm::dvec2 at = view(id)->plane()->pixelFromPatient(p) / view(id)->devicePixelRatioF();
    return {at.x, at.y};
  }
  FlatLook look(ViewId id) { return flatLookOf(session().workspace().view(id)); }
};

}  // namespace

class TestSliceViews : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void layoutsShowTheirViews();
  void eachPlaneShowsItsCutOfTheBall();
  void theWheelScrolls();
  void keysScroll();
  void aDragChangesTheWindow();
  void escapeGivesUpADrag();
  void digitsChooseWindows();
  void theRightButtonZoomsAboutThePress();
  void theMiddleButtonPans();
  void controlWheelZoomsAtTheCursor();
  void altWheelMakesASlab();
  void shiftMovesTheCrosshairEverywhere();
  void handlesTurnTheOtherPlanes();
  void linesMoveTheirPlane();
  void theViewThatIsPressedIsInFocus();
  void aDoubleClickShowsOneViewAlone();
  void whatIsUnderTheCursorIsRead();
  void resetMakesItWhole();
  void everythingIsUndone();
  void anotherSeriesComesAndGoes();
  void aSeriesIsDraggedIntoAView();
  void tinyWindowsDoNoHarm();
  void notANumberIsShown();
};

void TestSliceViews::layoutsShowTheirViews() {
  Planes w;
  QVERIFY(w.window.view()->isVisible());
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) {
    QVERIFY(w.view(id)->isVisible());
    QVERIFY(!w.view(id)->geometry().intersects(w.window.view()->geometry()));
  }
  w.child<QAction>("layoutOne")->trigger();
  QVERIFY(w.window.view()->isVisible());
  QVERIFY(!w.view(axialViewId)->isVisible());
  w.child<QAction>("layoutBesidePlanes")->trigger();
  QVERIFY(w.view(axialViewId)->isVisible());
  QVERIFY(w.window.view()->width() > 1.9 * w.view(axialViewId)->width());
  w.child<QAction>("undo")->trigger();
  QVERIFY(!w.view(axialViewId)->isVisible());
}

void TestSliceViews::eachPlaneShowsItsCutOfTheBall() {
  Planes w;
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) {
    const SlicePlane plane = *w.view(id)->plane();
    const QImage& picture = w.view(id)->picture();
    QCOMPARE(picture.size(), w.view(id)->pixels());
    const glm::dvec2 centre = plane.pixelFromPatient({3, -2, 4});
    QCOMPARE(qGray(picture.pixel(int(centre.x), int(centre.y))), 255);
    const glm::dvec2 air = plane.pixelFromPatient({-14, -14, -14});
    QCOMPARE(qGray(picture.pixel(int(air.x), int(air.y))), 102);  // 0 HU in the window 400 / 40
  }
}

void TestSliceViews::theWheelScrolls() {
  Planes w;
  const int before = w.place(axialViewId).index;
  QVERIFY(w.after(axialViewId, [&] { wheel(w.view(axialViewId), -3); }));
  QCOMPARE(w.place(axialViewId).index, before + 3);
  QVERIFY2(w.cursor().z < firstCrosshair(w.session().series()->volume->geometry()).at.z, "caudal");
  for (int n = 0; n < 100; ++n) wheel(w.view(axialViewId), -1);
  QCOMPARE(w.place(axialViewId).index, 31);
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.place(axialViewId).index, before);
}

void TestSliceViews::keysScroll() {
  Planes w;
  const std::pair<Qt::Key, int> keys[] = {{Qt::Key_Down, 16},  {Qt::Key_Up, 14},  {Qt::Key_PageDown, 25},
                                          {Qt::Key_PageUp, 5}, {Qt::Key_Home, 0}, {Qt::Key_End, 31}};
  for (const auto& [key, index] : keys) {
    w.view(coronalViewId)->goTo(15);
    QTest::keyClick(w.view(coronalViewId), key);
    QCOMPARE(w.place(coronalViewId).index, index);
  }
}

void TestSliceViews::aDragChangesTheWindow() {
  Planes w;
  const Window before = w.shownWindow();
  tests::drag(w.view(axialViewId), {50, 50}, {90, 50});
  QVERIFY(std::abs(w.shownWindow().width - before.width * 1.5) < 1e-6 * before.width);
  QCOMPARE(w.shownWindow().centre, before.centre);
  QVERIFY2(w.session().scene().window == w.session().series()->firstScene.window, "the 3D window stays");
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.shownWindow(), before);
}

void TestSliceViews::escapeGivesUpADrag() {
  Planes w;
  const Workspace before = w.session().workspace();
  FlatView* view = w.view(axialViewId);
  w.session().setFocus(axialViewId);
  const Workspace pressed = w.session().workspace();
  QTest::mousePress(view, Qt::LeftButton, {}, {50, 50});
  QTest::mouseEvent(QTest::MouseMove, view, Qt::LeftButton, {}, {90, 70});
  QVERIFY(w.session().workspace() != pressed);
  QTest::keyClick(view, Qt::Key_Escape);
  QVERIFY(w.session().workspace() == pressed);
  QTest::mouseEvent(QTest::MouseMove, view, Qt::LeftButton, {}, {120, 70});
  QVERIFY2(w.session().workspace() == pressed, "what follows is no drag any more");
  QTest::mouseRelease(view, Qt::LeftButton, {}, {120, 70});
  QVERIFY(w.session().workspace().crosshairs == before.crosshairs);
}

void TestSliceViews::digitsChooseWindows() {
  Planes w;
  QTest::keyClick(w.view(axialViewId), Qt::Key_1);  // the ball has no windows of its own, so Brain is first
  QCOMPARE(w.shownWindow(), (Window{40, 80}));
  QTest::keyClick(w.view(axialViewId), Qt::Key_0);
  QVERIFY(!w.session().workspace().series.begin()->second.window);
}

void TestSliceViews::theRightButtonZoomsAboutThePress() {
  Planes w;
  FlatView* view = w.view(axialViewId);
  const QPointF at(60, 40);
  const glm::dvec3 under = view->plane()->patientFromPixel({at.x(), at.y()});
  tests::drag(view, at, at - QPointF(0, 50), Qt::RightButton);
  QVERIFY(w.look(axialViewId).zoom > 1.4);
  QVERIFY(glm::length(view->plane()->patientFromPixel({at.x(), at.y()}) - under) < 1e-9);
  QCOMPARE(w.look(coronalViewId).zoom, 1.0);
}

void TestSliceViews::theMiddleButtonPans() {
  Planes w;
  FlatView* view = w.view(sagittalViewId);
  const glm::dvec3 under = view->plane()->patientFromPixel({60, 40});
  tests::drag(view, {60, 40}, {75, 20}, Qt::MiddleButton);
  QVERIFY(glm::length(view->plane()->patientFromPixel({75, 20}) - under) < 1e-9);
}

void TestSliceViews::controlWheelZoomsAtTheCursor() {
  Planes w;
  FlatView* view = w.view(axialViewId);
  const StackPlace place = w.place(axialViewId);
  wheel(view, 2, Qt::ControlModifier);
  QVERIFY(std::abs(w.look(axialViewId).zoom - std::pow(0.85, -2)) < 1e-9);
  QCOMPARE(w.place(axialViewId).index, place.index);
}

void TestSliceViews::altWheelMakesASlab() {
  Planes w;
  wheel(w.view(axialViewId), 5, Qt::AltModifier);
  QCOMPARE(w.look(axialViewId).slabMm, 5.0);
  wheel(w.view(axialViewId), -9, Qt::AltModifier);
  QCOMPARE(w.look(axialViewId).slabMm, 0.0);
}

void TestSliceViews::shiftMovesTheCrosshairEverywhere() {
  Planes w;
  FlatView* view = w.view(axialViewId);
  const glm::dvec3 p = view->plane()->patientFromPixel({70.5, 60.5});
  QTest::mousePress(view, Qt::LeftButton, Qt::ShiftModifier, {70, 60});
  QTest::mouseRelease(view, Qt::LeftButton, Qt::ShiftModifier, {70, 60});
  QVERIFY(glm::length(w.cursor() - p) < view->plane()->mmPerPixel);
  QVERIFY(std::abs(w.view(coronalViewId)->plane()->centre.y - w.cursor().y) < 1e-9);
  QVERIFY(std::abs(w.view(sagittalViewId)->plane()->centre.x - w.cursor().x) < 1e-9);
}

void TestSliceViews::handlesTurnTheOtherPlanes() {
  Planes w;
  FlatView* axial = w.view(axialViewId);
  const Crosshair before = w.crosshair();
  const QImage coronalBefore = w.view(coronalViewId)->picture();
  const QPointF middle = w.pixel(axialViewId, before.at);
  // The sagittal plane's line is upright. Its upper handle moves 30 degrees clockwise.
  const double reach = 0.32 * std::min(axial->width(), axial->height());
  const auto around = [&](double angle) {
    return (middle + reach * QPointF(std::sin(angle), -std::cos(angle))).toPoint();
  };
  const double angle = M_PI / 6;
  QVERIFY(w.after(coronalViewId, [&] { tests::drag(axial, around(0), around(angle)); }));
  const Crosshair after = w.crosshair();
  QCOMPARE(after.axial, before.axial);
  QCOMPARE(after.at, before.at);
  const double turned = std::acos(glm::dot(after.sagittal.normal(), before.sagittal.normal()));
  QVERIFY2(std::abs(turned - angle) < 0.02, "two pixels at 100 from the middle");
  QVERIFY2(after.sagittal.normal().x * after.sagittal.normal().y > 0, "clockwise: from right towards down");
  QVERIFY(w.view(coronalViewId)->picture() != coronalBefore);
  const QPointF still = w.pixel(coronalViewId, after.at);
  w.child<QAction>("resetView")->trigger();
  QVERIFY(!w.crosshair().turned());
  QVERIFY2(QLineF(w.pixel(coronalViewId, after.at), still).length() < 1e-6, "the point stays where it was");
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.crosshair(), after);
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.crosshair(), before);
}

void TestSliceViews::linesMoveTheirPlane() {
  Planes w;
  FlatView* axial = w.view(axialViewId);
  const glm::dvec3 before = w.cursor();
  const QPoint on = (w.pixel(axialViewId, before) + QPointF(0, 0.25 * axial->height())).toPoint();
  tests::drag(axial, on, on + QPoint(30, 5));
  const double mm = axial->plane()->mmPerPixel * axial->devicePixelRatioF();
  QVERIFY(glm::length(w.cursor() - before - glm::dvec3(30 * mm, 0, 0)) < 1e-9);
}

void TestSliceViews::theViewThatIsPressedIsInFocus() {
  Planes w;
  QTest::mouseClick(w.view(coronalViewId), Qt::LeftButton, {}, {30, 30});
  QCOMPARE(w.session().workspace().focus, coronalViewId);
  QVERIFY2(w.session().series(), "panels still work on the 3D view beside it");
  QTest::mouseClick(w.window.view(), Qt::LeftButton, {}, {30, 30});
  QCOMPARE(w.session().workspace().focus, sceneViewId);
}

void TestSliceViews::aDoubleClickShowsOneViewAlone() {
  Planes w;
  FlatView* view = w.view(coronalViewId);
  const int width = view->width();
  QTest::mouseClick(view, Qt::LeftButton, {}, {30, 30});
  QTest::mouseDClick(view, Qt::LeftButton, {}, {30, 30});
  QTRY_VERIFY(view->width() > 1.8 * width);
  QVERIFY(!w.window.view()->isVisible());
  QTest::mouseDClick(view, Qt::LeftButton, {}, {30, 30});
  QTRY_COMPARE(view->width(), width);
  QVERIFY(w.window.view()->isVisible());
}

void TestSliceViews::whatIsUnderTheCursorIsRead() {
  Planes w;
  FlatView* view = w.view(axialViewId);
  wheel(view, -6, Qt::ControlModifier);  // leaves space beside the volume
  QSignalSpy hovered(view, &View::hovered);
  const glm::dvec2 p = view->plane()->pixelFromPatient({3, -2, 4});
  tests::hover(view, {p.x, p.y});
  QVERIFY(!hovered.isEmpty());
  const QString said = hovered.last().value(0).toString();
  QVERIFY2(said.startsWith(QStringLiteral("1000")) && said.contains(QStringLiteral("HU at L ")),
           qPrintable(said));
  tests::hover(view, {2, 2});
  QCOMPARE(hovered.last().value(0).toString(), QString());
}

void TestSliceViews::resetMakesItWhole() {
  Planes w;
  tests::drag(w.view(axialViewId), {60, 80}, {60, 20}, Qt::RightButton);
  QVERIFY(w.look(axialViewId) != FlatLook());
  w.child<QAction>("resetView")->trigger();
  QVERIFY(w.look(axialViewId) == FlatLook());
}

void TestSliceViews::everythingIsUndone() {
  Planes w;
  const Workspace before = w.session().workspace();
  const int steps = w.session().undoStack().index();
  tests::drag(w.view(axialViewId), {60, 80}, {60, 20}, Qt::RightButton);
  tests::drag(w.view(coronalViewId), {60, 80}, {60, 20});
  wheel(w.view(sagittalViewId), -4);
  tests::drag(w.window.view(), {60, 80}, {90, 20});
  QVERIFY(w.session().undoStack().index() >= steps + 4);
  while (w.session().undoStack().index() > steps) w.child<QAction>("undo")->trigger();
  Workspace now = w.session().workspace();
  now.focus = before.focus;
  QVERIFY(now == before);
}

void TestSliceViews::anotherSeriesComesAndGoes() {
  Planes w;
  const LoadedSeriesPtr first = w.session().series();
  tests::drag(w.view(axialViewId), {60, 80}, {60, 20}, Qt::RightButton);
  const FlatLook look = w.look(axialViewId);
  const LoadedSeriesPtr other = tests::ballSeries(16, 4);
  QVERIFY(w.after(axialViewId, [&] { w.session().show(other); }));
  QVERIFY(w.look(axialViewId) == FlatLook());
  QVERIFY(w.after(axialViewId, [&] { w.session().show(first); }));
  QVERIFY(w.look(axialViewId) == look);
  w.session().show(nullptr);
  QVERIFY(!w.view(axialViewId)->plane());
}

void TestSliceViews::aSeriesIsDraggedIntoAView() {
  Journey w({QStringLiteral("phantom:sphere:24"), QStringLiteral("phantom:cube:16")});
  QVERIFY(w.settle());
  auto* tree = w.child<QTreeWidget>("studyTree");
  QTRY_COMPARE_WITH_TIMEOUT(
      tree->findItems(QStringLiteral("cube"), Qt::MatchContains | Qt::MatchRecursive).size(), 1, longest);
  w.child<QAction>("layoutTwo")->trigger();
  QVERIFY(w.window.session().seriesOf(firstComparedId));
  QTreeWidgetItem* cube =
      tree->findItems(QStringLiteral("cube"), Qt::MatchContains | Qt::MatchRecursive).value(0);
  const std::unique_ptr<QMimeData> data(tree->model()->mimeData({tree->indexFromItem(cube)}));
  QVERIFY(data);
  FlatView* right = w.window.views()->viewAs<FlatView>(firstComparedId + 1);
  QVERIFY(tests::drop(*data, right));
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().seriesOf(firstComparedId + 1), longest);
  QVERIFY(w.window.session().seriesOf(firstComparedId + 1)->series.path.find("cube") != std::string::npos);
  QVERIFY(w.window.session().seriesOf(firstComparedId)->series.path.find("sphere") != std::string::npos);
}

void TestSliceViews::tinyWindowsDoNoHarm() {
  Planes w;
  for (const QSize size : {QSize(1, 1), QSize(200, 1), QSize(3840, 2160), QSize(1040, 680)}) {
    w.window.views()->resize(size);
    QCoreApplication::processEvents();
    for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) {
      tests::drag(w.view(id), {0, 0}, {5, 5});
      wheel(w.view(id), 1);
    }
  }
  QVERIFY(w.after(axialViewId, [&] { w.view(axialViewId)->scroll(1); }));
}

void TestSliceViews::notANumberIsShown() {
  Planes w;
  VolumeParts parts;
  parts.geometry.size = {8, 8, 8};
  parts.values = std::vector<float>(512, std::nanf(""));
  std::vector<std::string> warnings;
  auto series = std::make_shared<LoadedSeries>(*tests::ballSeries());
  series->volume = *Volume::make(std::move(parts), warnings);
  QVERIFY(w.after(axialViewId, [&] { w.session().show(series); }));
  wheel(w.view(axialViewId), -1);
  tests::drag(w.view(axialViewId), {10, 10}, {30, 30});
  QCOMPARE(w.place(axialViewId).count, 8);
}

VOLUMEN_TEST(TestSliceViews);
#include "tst_slice_views.moc"
