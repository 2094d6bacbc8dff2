// Guards gestures of mice and trackpads with any bindings: pinches, two fingers, right clicks, boxes of the
// left button. Drags end with their button, and held keys are respected.
#include <QMenu>
#include <QNativeGestureEvent>
#include <QPointingDevice>

#include "tests/ui/clean_settings.h"
#include "tests/ui/mouse_gestures.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Moves two fingers apart by a share of their distance.
void pinch(QWidget* on, QPointF at, double share) {
  QNativeGestureEvent event(Qt::ZoomNativeGesture, QPointingDevice::primaryPointingDevice(), 2, at, at,
                            on->mapToGlobal(at), share, {});
  QCoreApplication::sendEvent(on, &event);
}

}  // namespace

class TestMouseGestures : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void aPinchZooms_data() { addMousePresets(); }
  void aPinchZooms();
  void twoFingersPan();
  void aRightClickOpensTheMenuAllTheSame_data();
  void aRightClickOpensTheMenuAllTheSame();
  void aBoxIsTheLeftButtons();
  void aDragEndsWithItsButton();
  void aWheelWithShiftLeavesTheCrosshair();
  void theFirstKeyCounts();
};

void TestMouseGestures::aBoxIsTheLeftButtons() {
  for (const MouseSlot& slot : mouseSlots()) {
    const std::vector<MouseAction>& all = mouseActions(slot);
    const bool isOffered = std::ranges::find(all, "regionWindow", &MouseAction::word) != all.end();
    QCOMPARE(isOffered, slot.place == MousePlace::flat && slot.input == MouseInput::left);
  }
  MeasureWindow w;
  Preferences old;
  old.mouseBindings["flat.middle"] = "regionWindow";
  w.session().prefer(old);
  const FlatSeen before(w);
  drag(w.view(), {62, 72}, {92, 40}, Qt::MiddleButton);
  QCOMPARE(doneBetween(before, FlatSeen(w)), std::string("pan"));
}

void TestMouseGestures::aDragEndsWithItsButton() {
  MeasureWindow w;
  const auto zoom = [&] { return flatLookOf(w.view()->state()).zoom; };
  const auto moveTo = [&](int y) {
    QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::RightButton, {}, {62, y});
  };
  const int steps = w.session().undoStack().index();
  QTest::mousePress(w.view(), Qt::RightButton, {}, {62, 72});
  moveTo(92);
  const double first = zoom();
  QVERIFY(first != 1);
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, {62, 92});
  moveTo(122);
  const double second = zoom();
  QVERIFY2(second != first, "the right button is still held");
  QTest::mouseRelease(w.view(), Qt::RightButton, {}, {62, 122});
  moveTo(150);
  QCOMPARE(zoom(), second);
  QCOMPARE(w.session().undoStack().index(), steps + 1);
}

// A hand on the wheel trembles. The crosshair follows the pointer only once it moves further.
void TestMouseGestures::aWheelWithShiftLeavesTheCrosshair() {
  MeasureWindow w;
  const MouseSlot slot{MousePlace::flat, MouseInput::move, Qt::ShiftModifier};
  const auto moveTo = [&](QPointF at) {
    QMouseEvent move(QEvent::MouseMove, at, w.view()->mapToGlobal(at), Qt::NoButton, Qt::NoButton, slot.held);
    QCoreApplication::sendEvent(w.view(), &move);
  };
  const QPointF middle(w.view()->width() / 2.0, w.view()->height() / 2.0), near = middle + QPointF(3, 2);
  hover(w.view(), near);
  const FlatSeen before(w);
  moveTo(near + QPointF(2, 2));
  QCOMPARE(doneBetween(before, FlatSeen(w)), std::string("none"));
  wheel(w.view(), 1, Qt::ShiftModifier);
  moveTo(near);
  QCOMPARE(doneBetween(before, FlatSeen(w)), std::string("fast"));
  moveTo(middle + QPointF(30, 20));
  QCOMPARE(doneBetween(before, FlatSeen(w)), std::string("crosshair"));
  const FlatSeen there(w);
  moveTo(middle + QPointF(32, 20));  // continues in small moves
  QCOMPARE(doneBetween(there, FlatSeen(w)), std::string("crosshair"));
}

void TestMouseGestures::aPinchZooms() {
  QFETCH(QByteArray, preset);
  MeasureWindow w;
  chooseMousePreset(w.session(), preset);
  const QPointF at(70, 60);
  const glm::dvec3 under = w.patient(at);
  pinch(w.view(), at, 0.25);
  pinch(w.view(), at, -0.1);
  QVERIFY(std::abs(flatLookOf(w.view()->state()).zoom - 1.25 * 0.9) < 1e-9);
  QVERIFY2(glm::length(w.patient(at) - under) < 1e-9, "what is between the fingers stays");
  w.session().endGesture();
  w.undo();
  QCOMPARE(flatLookOf(w.view()->state()).zoom, 1.0);
  const double height = w.window.view()->camera().height;
  pinch(w.window.view(), at, 0.25);
  QVERIFY(std::abs(w.window.view()->camera().height * 1.25 / height - 1) < 1e-6);
  pinch(w.window.view(), at, -5);
  QVERIFY2(w.window.view()->camera().height > 0, "nothing turns inside out");
}

void TestMouseGestures::twoFingersPan() {
  MeasureWindow w;
  chooseMousePreset(w.session(), "trackpad");
  const QPointF at(70, 60);
  const glm::dvec3 under = w.patient(at);
  slide(w.view(), {12, -9}, {});
  slide(w.view(), {3, 4}, {});
  QVERIFY2(glm::length(w.patient(at + QPointF(15, -5)) - under) < 1e-9, "it follows the fingers");
  w.session().endGesture();
  w.undo();
  QVERIFY(glm::length(w.patient(at) - under) < 1e-9);
  const FlatSeen before(w);
  wheel(w.view(), -1);
  QVERIFY2(doneBetween(before, FlatSeen(w)) == "scroll", "a wheel has no pixels to pan by");
}

void TestMouseGestures::aRightClickOpensTheMenuAllTheSame_data() { addMousePresets(); }

void TestMouseGestures::aRightClickOpensTheMenuAllTheSame() {
  QFETCH(QByteArray, preset);
  MeasureWindow w;
  chooseMousePreset(w.session(), preset);
  QTest::mouseClick(w.view(), Qt::RightButton, {}, {60, 60});
  auto* menu = w.child<QMenu>("flatMenu");
  QVERIFY(menu && menu->isVisible());
  menu->close();
  QTest::mouseClick(w.window.view(), Qt::RightButton, {}, {60, 60});
  menu = w.child<QMenu>("volumeMenu");
  QVERIFY(menu && menu->isVisible());
  menu->close();
  drag(w.view(), {60, 60}, {90, 90}, Qt::RightButton);
  for (const QMenu* open : w.window.findChildren<QMenu*>(QStringLiteral("flatMenu")))
    QVERIFY2(!open->isVisible(), "a drag is no click");
}

void TestMouseGestures::theFirstKeyCounts() {
  QCOMPARE(heldOf(Qt::ControlModifier | Qt::ShiftModifier), Qt::ShiftModifier);
  QCOMPARE(heldOf(Qt::AltModifier | Qt::ControlModifier), Qt::ControlModifier);
  QCOMPARE(heldOf(Qt::KeypadModifier), Qt::NoModifier);
}

VOLUMEN_TEST(TestMouseGestures);
#include "tst_mouse_gestures.moc"
