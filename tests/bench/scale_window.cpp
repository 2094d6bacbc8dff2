#include <algorithm>
#include <cstdio>

#include "io/frame_limit.h"
#include "tests/bench/scale_run.h"
#include "tests/fixtures/cpu_timer.h"
#include "tests/ui/measure_window.h"
#include "viewer/volume/clock.h"

namespace volumen::bench {

namespace {

using namespace volumen::tests;

// Lengths and ellipses in turn, evenly over the axial slices of a volume.
std::vector<Shape> shapesOver(const VoxelGeometry& g, int count) {
  std::vector<Shape> shapes;
  for (int n = 0; n < count; ++n) {
    const int k = n % g.size.z;
    const auto place = [&](double i, double j) { return g.patientFromVoxel({i, j, k}); };
    const double i = g.size.x * (0.3 + 0.05 * (n / g.size.z % 8)), j = g.size.y * 0.4;
    Shape shape;
    shape.kind = n % 2 ? ShapeKind::ellipse : ShapeKind::length;
    shape.points = {place(i, j), place(i + 6, j + 5)};
    if (n % 2) shape.plane = ShapePlane{place(i, j), {1, 0, 0}, {0, 1, 0}};
    shapes.push_back(shape);
  }
  return shapes;
}

}  // namespace

int turnTheWheel(int measurements) {
  constexpr int steps = 20;
  Journey w;
  w.window.resize(1440, 1100);
  w.window.open({QStringLiteral("phantom:ct-head:256")});
  if (!w.settle()) return 1;
  w.child<QAction>("layoutPlanes")->trigger();
  const auto isDrawn = [&] {
    const auto* flat = w.window.views()->viewAs<FlatView>(axialViewId);
    return flat && flat->isVisible() && !flat->picture().isNull();
  };
  if (!QTest::qWaitFor(isDrawn, longest)) return 1;
  Session& session = w.window.session();
  const LoadedSeriesPtr series = session.series();
  if (!series) return 1;
  if (measurements > 0)
    addMeasurements(session, keyOf(series->series), shapesOver(series->volume->geometry(), measurements));
  auto* view = w.window.views()->viewAs<FlatView>(axialViewId);
  const auto step = [&](int notches) {
    QSignalSpy drawn(view, &FlatView::settled);
    wheel(view, notches);
    if (!QTest::qWaitFor([&] { return !drawn.isEmpty(); }, longest)) return false;
    view->repaint();
    QCoreApplication::processEvents();
    return true;
  };
  for (int n = 0; n < 4; ++n) step(n % 2 ? 1 : -1);
  QTest::qWait(3000);  // until nothing is drawn ahead any more
  const CpuTimer cpu;
  for (int n = 0; n < steps; ++n)
    if (!step(n % 2 ? 1 : -1)) return 1;
  std::printf("%.6f\n", cpu.elapsed() / 1000 / steps);
  return 0;
}

int showRadiograph(const std::string& path) {
  setFramePixelLimit(1ull << 30);
  Journey w;
  w.window.resize(1440, 900);
  const CpuTimer cpu;
  w.window.open({QString::fromStdString(path)});
  const auto isSeen = [&] {
    const auto* view = w.window.views()->viewAs<FlatView>(axialViewId);
    return view && view->isVisible() && frameIn(view) && !view->picture().isNull();
  };
  if (!QTest::qWaitFor(isSeen, 5 * longest)) return 1;
  std::printf("%.6f\n", cpu.elapsed() / 1000);
  return 0;
}

int showMammograms(const std::string& folder, double startMs) {
  constexpr int four = 4;
  Journey w;
  w.window.resize(1440, 900);
  w.window.open({QString::fromStdString(folder)});
  const auto areSeen = [&] {
    const auto views = w.window.findChildren<FrameView*>();
    return four == std::ranges::count_if(views, [](const FrameView* view) {
             return view->isVisible() && view->frame() && !view->picture().isNull();
           });
  };
  if (!QTest::qWaitFor(areSeen, longest)) return 1;
  std::printf("%.6f\n", (wallMs() - startMs) / 1000);
  return 0;
}

int showInTurn(int series) {
  constexpr int edge = 256;
  Journey w;
  const CpuTimer cpu;
  for (int n = 0; n < series; ++n) {
    w.settled.clear();
    w.window.open({QStringLiteral("phantom:ct-head:%1").arg(edge + n)});
    if (!w.settle()) return 1;
  }
  std::printf("%.6f\n", cpu.elapsed() / 1000);
  return 0;
}

}  // namespace volumen::bench
