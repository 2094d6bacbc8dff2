// Guards the order in which flat pictures are drawn. Each view's latest request counts, the view in focus
// comes first, and no other view starves.
#include <algorithm>

#include "tests/ui/chance_slices.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr ViewId firstView = 1, secondView = 2, focusView = 3, slowView = 9;

// Slice requests, and the views whose pictures came, in order. Requests wait while the slow one is drawn,
// because it has far more pixels.
struct Turns {
  SliceService service;
  VolumePtr volume = shearedRamp(0);
  std::vector<ViewId> drawn;
  std::vector<double> scales;  // mm per pixel of these pictures
  bool goesOn = false;         // requests the next picture whenever that in focus is there

  Turns() {
    QObject::connect(&service, &SliceService::ready, &service, [this](const SlicePicture& picture) {
      if (picture.request.view == slowView) return;
      drawn.push_back(picture.request.view);
      scales.push_back(picture.request.plane.mmPerPixel);
      if (goesOn && drawn.back() == focusView) ask(focusView, true, scales.back() + 1);
    });
    ask(slowView, false, 0.01, 3000);
  }
  void ask(ViewId view, bool isInFocus = false, double mmPerPixel = 1, int size = 8) {
    SliceRequest request;
    request.view = view;
    request.layers.push_back(plainLayer(volume));
    request.plane.mmPerPixel = mmPerPixel;
    request.plane.size = {size, size};
    service.request(request, isInFocus);
  }
  bool have(std::size_t count) {
    return QTest::qWaitFor([&] { return drawn.size() >= count; }, longest);
  }
};

}  // namespace

class TestSliceTurns : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void inTheOrderAsked();
  void theLatestOfAView();
  void theFocusFirst();
  void noneIsKeptWaiting();
  void whatIsDropped();
};

void TestSliceTurns::inTheOrderAsked() {
  Turns t;
  for (const ViewId view : {secondView, firstView, focusView}) t.ask(view);
  QVERIFY(t.have(3));
  QCOMPARE(t.drawn, (std::vector<ViewId>{secondView, firstView, focusView}));
}

void TestSliceTurns::theLatestOfAView() {
  Turns t;
  for (const double scale : {1.0, 2.0, 3.0}) t.ask(firstView, false, scale);
  t.ask(secondView);
  QVERIFY(t.have(2));
  QCOMPARE(t.drawn, (std::vector<ViewId>{firstView, secondView}));
  QCOMPARE(t.scales[0], 3.0);
}

void TestSliceTurns::theFocusFirst() {
  Turns t;
  t.ask(firstView);
  t.ask(secondView);
  t.ask(focusView, true);
  QVERIFY(t.have(3));
  QCOMPARE(t.drawn, (std::vector<ViewId>{focusView, firstView, secondView}));
}

void TestSliceTurns::noneIsKeptWaiting() {
  Turns t;
  t.ask(firstView);
  t.ask(secondView);
  t.ask(focusView, true);
  t.goesOn = true;
  QVERIFY(t.have(5));
  QCOMPARE(std::ranges::count(t.drawn, firstView), 1);
  QCOMPARE(std::ranges::count(t.drawn, secondView), 1);
}

void TestSliceTurns::whatIsDropped() {
  Turns t;
  t.ask(firstView);
  t.ask(secondView);
  t.service.drop(firstView);
  t.ask(focusView);
  QVERIFY(t.have(2));
  QTest::qWait(50);
  QCOMPARE(t.drawn, (std::vector<ViewId>{secondView, focusView}));
}

VOLUMEN_TEST(TestSliceTurns);
#include "tst_slice_turns.moc"
