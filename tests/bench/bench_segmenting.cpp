// Prints times in the window for the goals of segmentation: pointer to picture while painting, range on the
// curve's axis to slices and 3D, undo, and the size of label maps. Asserts only that each picture comes.
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>
#include <algorithm>
#include <set>

#include "tests/bench/print_times.h"
#include "tests/fixtures/fixtures.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/curve_editor.h"

using namespace volumen;
using namespace volumen::tests;
using volumen::bench::printTimes;

namespace {

constexpr int moves = 21;
const std::vector<ViewId> planes{axialViewId, coronalViewId, sagittalViewId};

struct ChestSegments : SegmentWindow {
  ChestSegments() : SegmentWindow({QString::fromStdString(dataPath("ct-chest-lidc0314-138"))}) {
    window.resize(1440, 1100);
    settle();
    child<QAction>("layoutPlanes")->trigger();
    child<QDockWidget>("segmentDock")->raise();
    settle();
    QTest::qWait(5000);  // waits for pictures drawn in advance, such as preset thumbnails
  }
  // Returns the ms from an act until each of these views has drawn and painted its picture. If `in3d`, also
  // waits for a new 3D picture.
  double until(const std::vector<ViewId>& ids, bool in3d, const std::function<void()>& act) {
    QEventLoop loop;
    std::set<QObject*> awaited;
    const auto drew = [&](QObject* view) {
      if (awaited.erase(view) && awaited.empty()) loop.quit();
    };
    for (const ViewId id : ids) {
      awaited.insert(view(id));
      QObject::connect(view(id), &FlatView::settled, &loop, [&, on = view(id)] { drew(on); });
    }
    if (in3d) awaited.insert(window.view());
    QObject::connect(window.view(), &VolumeView::drawn, &loop, [&] { drew(window.view()); });
    QTimer::singleShot(longest, &loop, &QEventLoop::quit);
    QElapsedTimer clock;
    clock.start();
    act();
    if (!awaited.empty()) loop.exec();
    for (const ViewId id : ids) view(id)->repaint();
    return awaited.empty() ? double(clock.nsecsElapsed()) / 1e6 : -1;
  }
};

}  // namespace

class BenchSegmenting : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aStroke();
  void theEndOfARange();
  void stepsUndone();
};

void BenchSegmenting::aStroke() {
  NEED_DATA(dataPath("ct-chest-lidc0314-138"));
  for (const bool alone : {false, true}) {
    ChestSegments w;
    w.session().prefer([](Preferences& p) { p.brush = {.ball = true, .diameterMm = 20}; });
    w.session().setFocus(axialViewId);
    if (alone) w.child<QAction>("layoutOne")->trigger();
    w.child<QAction>("paintTool")->trigger();
    w.settle();
    FlatView* view = w.view(axialViewId);
    const QPoint from(view->width() / 3, view->height() / 2);
    std::vector<double> ms;
    w.until({axialViewId}, false, [&] { QTest::mousePress(view, Qt::LeftButton, {}, from); });
    for (int n = 1; n <= moves; ++n)
      ms.push_back(w.until({axialViewId}, false, [&] {
        QTest::mouseEvent(QTest::MouseMove, view, Qt::LeftButton, {}, from + QPoint(6 * n, n % 2));
      }));
    QTest::mouseRelease(view, Qt::LeftButton, {}, from + QPoint(6 * moves, 1));
    QVERIFY(w.settle() && w.idle());
    QVERIFY(w.count() == 1);
    printTimes(
        alone ? "a stroke, pointer to picture, alone" : "a stroke, pointer to picture, beside planes and 3D",
        ms);
  }
}

void BenchSegmenting::theEndOfARange() {
  NEED_DATA(dataPath("ct-chest-lidc0314-138"));
  ChestSegments w;
  w.child<QDockWidget>("transferDock")->raise();
  w.click("segmentFromCurve");
  auto* curve = w.child<CurveEditor>("curveEditor");
  curve->showValues(-1000, 1500);
  w.child<QDoubleSpinBox>("segmentLow")->setValue(200);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(3000);
  QVERIFY(w.settle());
  const QPoint from = curve->rangeHandle(0).center().toPoint();
  std::vector<double> slices, all;
  QTest::mousePress(curve, Qt::LeftButton, {}, from);
  QTest::mouseEvent(QTest::MouseMove, curve, Qt::LeftButton, {}, from - QPoint(20, 0));  // starts the drag
  QVERIFY(w.settle());
  const auto isSnappedTo = [&](QPoint at) {  // the end did not move, so nothing is drawn
    const double low = curve->range()->low;
    QTest::mouseEvent(QTest::MouseMove, curve, Qt::LeftButton, {}, at);
    return curve->range()->low == low;
  };
  for (int n = 1; n <= 2 * moves; ++n) {
    const QPoint at = from - QPoint(20 + 2 * n, 0);
    const bool in3d = n % 2;
    if (isSnappedTo(at)) continue;
    QVERIFY(w.settle());
    const double ms = w.until(planes, in3d, [&] {
      QTest::mouseEvent(QTest::MouseMove, curve, Qt::LeftButton, {}, at - QPoint(1, 0));
    });
    (in3d ? all : slices).push_back(ms);
  }
  QTest::mouseRelease(curve, Qt::LeftButton, {}, from - QPoint(20 + 4 * moves, 0));
  printTimes("an end of a range, to three slices", slices);
  printTimes("an end of a range, to three slices and 3D", all);
}

void BenchSegmenting::stepsUndone() {
  NEED_DATA(dataPath("ct-chest-lidc0314-138"));
  ChestSegments w;
  QVERIFY(w.make(226, 3000) && w.make(-200, 225) && w.make(-1000, -500));
  qInfo("three segments of %lld voxels: %.1f MB of labels",
        (long long)w.map()->labels->geometry().voxelCount(), double(w.map()->labels->bytes()) / 1e6);
  w.choose(0);
  w.chooseStep("close");
  w.setField("radiusMm", 3);
  QVERIFY(w.press("segmentApply"));
  QVERIFY(w.settle());
  std::vector<double> undone, pictured;
  for (int n = 0; n < moves; ++n) {
    QAction* way = w.child<QAction>(n % 2 ? "redo" : "undo");
    pictured.push_back(w.until(planes, false, [&] {
      QElapsedTimer clock;
      clock.start();
      way->trigger();
      undone.push_back(double(clock.nsecsElapsed()) / 1e6);
    }));
    QVERIFY(w.settle());
  }
  printTimes("a step on bone undone or done again", undone);
  printTimes("the same, to three slices", pictured);
}

VOLUMEN_TEST(BenchSegmenting);
#include "bench_segmenting.moc"
