// Prints times in the window for the goals of the reading room. Times wheel to picture in one view and in
// three linked views, switches of layout and series, and first images of opened data. Asserts only that each
// picture comes. The application prints the longest events of the UI thread at the end.
#include <QElapsedTimer>
#include <algorithm>

#include "tests/bench/print_times.h"
#include "tests/fixtures/fixtures.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/views/first_image.h"
#include "ui/views/view_grid.h"

using namespace volumen;
using namespace volumen::tests;
using volumen::bench::printTimes;

namespace {

constexpr int times = 21;

struct Chest : Journey {
  Chest() {
    openAlone(false);
    window.resize(1440, 1100);
    window.open({QString::fromStdString(dataPath("ct-chest-lidc0314-138"))});
  }
  ~Chest() { openAlone(); }
  Session& session() { return window.session(); }
  FlatView* view(ViewId id) { return window.views()->viewAs<FlatView>(id); }
  // Returns the ms from an act until each of these views has drawn and painted its picture.
  double until(const std::vector<ViewId>& ids, const std::function<void()>& act) {
    std::vector<std::unique_ptr<QSignalSpy>> drawn;
    for (const ViewId id : ids) drawn.push_back(std::make_unique<QSignalSpy>(view(id), &FlatView::settled));
    QElapsedTimer clock;
    clock.start();
    act();
    const bool came = QTest::qWaitFor(
        [&] { return std::ranges::all_of(drawn, [](const auto& spy) { return !spy->isEmpty(); }); }, longest);
    for (const ViewId id : ids) view(id)->repaint();
    return came ? double(clock.nsecsElapsed()) / 1e6 : -1;
  }
};

}  // namespace

class BenchReading : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theFirstImage();
  void theWheel();
  void layoutsAndSeries();
};

void BenchReading::theFirstImage() {
  NEED_DATA(dataPath("ct-chest-lidc0314-138"));
  std::vector<double> imageMs, volumeMs;
  for (int n = 0; n < 5; ++n) {
    Chest w;
    QElapsedTimer clock;
    const Loader& loader = w.window.document().loader;
    QObject::connect(&loader, &Loader::loadingChanged, &w.window, [&] {
      if (loader.isLoading()) clock.start();
    });
    QVERIFY(QTest::qWaitFor(
        [&] { return w.child<FirstImage>("firstImage")->isVisible() || w.session().series(); }, longest));
    imageMs.push_back(double(clock.nsecsElapsed()) / 1e6);
    QVERIFY(QTest::qWaitFor([&] { return w.view(axialViewId) && !w.view(axialViewId)->picture().isNull(); },
                            longest));
    volumeMs.push_back(double(clock.nsecsElapsed()) / 1e6);
  }
  printTimes("first image of 138 slices, after their headers", imageMs);
  printTimes("the planes of the volume", volumeMs);
}

void BenchReading::theWheel() {
  NEED_DATA(dataPath("ct-chest-lidc0314-138"));
  Chest w;
  QVERIFY(w.settle());
  std::vector<double> three, one;
  for (int n = 0; n < times; ++n)
    three.push_back(w.until({axialViewId}, [&] { wheel(w.view(axialViewId), n % 2 ? 1 : -1); }));
  w.session().setFocus(axialViewId);
  w.child<QAction>("layoutOne")->trigger();
  QCoreApplication::processEvents();
  const QSize size = w.view(axialViewId)->pixels();
  for (int n = 0; n < times; ++n)
    one.push_back(w.until({axialViewId}, [&] { wheel(w.view(axialViewId), n % 2 ? 1 : -1); }));
  printTimes("wheel to picture beside two planes and 3D", three);
  qInfo("one view of %d x %d pixels", size.width(), size.height());
  printTimes("wheel to picture alone", one);
}

void BenchReading::layoutsAndSeries() {
  NEED_DATA(dataPath("ct-chest-lidc0314-138"));
  Chest w;
  QVERIFY(w.settle());
  std::vector<double> layouts, series;
  for (int n = 0; n < times; ++n) {
    w.child<QAction>("layoutOne")->trigger();
    QCoreApplication::processEvents();
    QElapsedTimer clock;
    clock.start();
    w.child<QAction>("layoutPlanes")->trigger();
    QVERIFY(QTest::qWaitFor(
        [&] {
          return std::ranges::all_of(std::vector{axialViewId, coronalViewId, sagittalViewId}, [&](ViewId id) {
            return w.view(id) && w.view(id)->isVisible() && !w.view(id)->picture().isNull();
          });
        },
        longest));
    layouts.push_back(double(clock.nsecsElapsed()) / 1e6);
  }
  const Series chest = w.session().series()->series;
  w.window.open({QStringLiteral("phantom:ct-head:64")});
  QVERIFY(QTest::qWaitFor([&] { return w.session().series()->series.id != chest.id; }, longest));
  const Series head = w.session().series()->series;
  for (int n = 0; n < times; ++n)
    series.push_back(w.until({axialViewId}, [&] { w.window.document().opener.show(n % 2 ? head : chest); }));
  printTimes("a layout switched", layouts);
  printTimes("a series switched that was shown before", series);
}

VOLUMEN_TEST(BenchReading);
#include "bench_reading.moc"
