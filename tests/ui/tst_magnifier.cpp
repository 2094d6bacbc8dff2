// Guards the magnifier under the pointer. Its pixels are those of the slice or frame drawn at that zoom, not
// of the enlarged screen. It disappears with the button and leaves no undo step, no state and nothing in
// saved pictures.
#include "tests/fixtures/small_volumes.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr int lensEdge = 240, lensRing = 4;  // logical pixels

LoadedSeriesPtr randomSeries() {
  auto series = std::make_shared<LoadedSeries>(*seriesOf(randomVolume<std::int16_t>({40, 36, 12}, 0, 1000)));
  series->series.acquired = series->volume->geometry();
  series->series.frameOfReferenceUid = "1.2.3";
  series->window = {500, 1000};
  return series;
}

struct LensWindow : MeasureWindow {
  explicit LensWindow(const LoadedSeriesPtr& series = randomSeries()) : MeasureWindow(series) {
    window.resize(1440, 900);
    child<QAction>("layoutOne")->trigger();
    QCoreApplication::processEvents();
  }
};

QPoint lensMiddle(const QWidget* view) { return view->rect().center() - QPoint(20, 30); }

// Returns the expected content of the lens, drawn directly.
QImage drawnAt(const FlatView* view, QPointF at, double factor) {
  SliceRequest request = *view->requestFor(view->pixels());
  const glm::dvec3 centre = request.plane.patientFromPixel({at.x(), at.y()});
  request.plane.centre = centre;
  request.plane.mmPerPixel /= factor;
  request.plane.size = glm::ivec2(lensEdge);
  const Result<QImage> drawn = drawSlice(request);
  return drawn ? drawn->convertToFormat(QImage::Format_RGB32) : QImage();
}

// Counts the pixels within the ring that differ from `expected`.
int wrongPixels(FlatView* view, QPoint at, const QImage& expected) {
  if (expected.isNull()) return -1;
  const QImage seen = view->grab().toImage().convertToFormat(QImage::Format_RGB32);
  int wrong = 0;
  const double most = lensEdge / 2.0 - lensRing;
  for (int y = 0; y < lensEdge; ++y)
    for (int x = 0; x < lensEdge; ++x) {
      if (std::hypot(x + 0.5 - lensEdge / 2.0, y + 0.5 - lensEdge / 2.0) > most) continue;
      const QPoint p = at + QPoint(x - lensEdge / 2, y - lensEdge / 2);
      if (seen.rect().contains(p) && seen.pixel(p) != expected.pixel(x, y)) ++wrong;
    }
  return wrong;
}

bool showsLens(FlatView* view, QPoint at, double factor) {
  const QImage expected = drawnAt(view, at, factor);
  return QTest::qWaitFor([&] { return wrongPixels(view, at, expected) == 0; }, longest);
}

using Prepare = std::function<void(LensWindow&)>;

}  // namespace

class TestMagnifier : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void itsPixelsAreThoseOfTheSlice_data();
  void itsPixelsAreThoseOfTheSlice();
  void theWheelEnlarges();
  void itFollowsThePointer();
  void measurementsUnderItStay();
  void framesAreEnlargedToo();
};

void TestMagnifier::itsPixelsAreThoseOfTheSlice_data() {
  QTest::addColumn<Prepare>("prepare");
  QTest::newRow("as it is") << Prepare([](LensWindow&) {});
  QTest::newRow("inverted") << Prepare([](LensWindow& w) { w.view()->invert(); });
  QTest::newRow("turned and mirrored") << Prepare([](LensWindow& w) {
    w.view()->turnPicture(QStringLiteral("test"), {1, true});
  });
  QTest::newRow("by a window of the view alone") << Prepare([](LensWindow& w) {
    w.child<QAction>("windowAlone")->trigger();
    QTest::keyClick(w.view(), Qt::Key_6);
    const auto request = w.view()->requestFor(w.view()->pixels());
    QVERIFY(request && request->layers[0].grey.window == Window({-600, 1500}));
    QVERIFY(!w.session().workspace().series.at(w.view()->state().series).window);
  });
  QTest::newRow("voxels as they are")
      << Prepare([](LensWindow& w) { w.child<QAction>("interpolate")->trigger(); });
  QTest::newRow("in colours") << Prepare([](LensWindow& w) {
    w.session().change(QStringLiteral("test"), [&](Workspace& all) {
      all.series.edit(w.view()->state().series).colours = ColourMap::hotIron;
    });
  });
  QTest::newRow("fused") << Prepare([](LensWindow& w) {
    const Series first = w.view()->shown()->series;
    const LoadedSeriesPtr over = randomSeries();
    w.session().show(over);
    w.session().showAgain(first, axialViewId);
    w.session().change(QStringLiteral("test"),
                       withOverlay(w.session().workspace(), axialViewId, &over->series));
  });
}

void TestMagnifier::itsPixelsAreThoseOfTheSlice() {
  QFETCH(Prepare, prepare);
  LensWindow w;
  prepare(w);
  QTest::keyClick(w.view(), Qt::Key_V);
  const auto wanted = w.view()->requestFor(w.view()->pixels());
  QCOMPARE(wanted->layers.size(), std::size_t(QTest::currentDataTag() == QByteArray("fused") ? 2 : 1));
  const QPoint at = lensMiddle(w.view());
  const Workspace before = w.session().workspace();
  const int steps = w.session().undoStack().index();
  QVERIFY(QTest::qWaitFor([&] { return w.view()->picture().size() == w.view()->pixels(); }, longest));
  const QImage captured = w.view()->capture();
  // The picture differs from that of the lens.
  QVERIFY(wrongPixels(w.view(), at, drawnAt(w.view(), at, 2)) > 1000);
  QTest::mousePress(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(showsLens(w.view(), at, 2));
  w.shot("magnifier");
  QCOMPARE(w.view()->capture(), captured);
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(wrongPixels(w.view(), at, drawnAt(w.view(), at, 2)) > 1000);
  QCOMPARE(w.session().undoStack().index(), steps);
  QVERIFY(w.session().workspace() == before);
}

// Four notches double the zoom, which ranges from 1.5 to 8.
void TestMagnifier::theWheelEnlarges() {
  LensWindow w;
  const Workspace before = w.session().workspace();
  QTest::keyClick(w.view(), Qt::Key_V);
  const QPoint at = lensMiddle(w.view());
  QTest::mousePress(w.view(), Qt::LeftButton, {}, at);
  wheel(w.view(), 4);
  QVERIFY(showsLens(w.view(), at, 4));
  wheel(w.view(), 40);
  QVERIFY(showsLens(w.view(), at, 8));
  wheel(w.view(), -80);
  QVERIFY(showsLens(w.view(), at, 1.5));
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.session().workspace() == before);
}

// The lens reaches the edge, too, where part of it is outside the view.
void TestMagnifier::itFollowsThePointer() {
  LensWindow w;
  QTest::keyClick(w.view(), Qt::Key_V);
  QPoint at = lensMiddle(w.view());
  QTest::mousePress(w.view(), Qt::LeftButton, {}, at);
  for (const QPoint next :
       {at + QPoint(31, -17), at + QPoint(-29, 6), QPoint(30, w.view()->height() / 2 + 150)}) {
    at = next;
    QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, at);
    QVERIFY(showsLens(w.view(), at, 2));
  }
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY(wrongPixels(w.view(), at, drawnAt(w.view(), at, 2)) > 1000);
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, at);
}

void TestMagnifier::measurementsUnderItStay() {
  LensWindow w;
  const QPoint at = lensMiddle(w.view());
  w.draw(ShapeKind::length, {at - QPoint(30, 20), at + QPoint(30, 20)});
  const Workspace before = w.session().workspace();
  QTest::keyClick(w.view(), Qt::Key_V);
  drag(w.view(), at, at + QPoint(25, 40));
  QVERIFY(w.session().workspace() == before);
}

void TestMagnifier::framesAreEnlargedToo() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  QTest::keyClick(w.view(), Qt::Key_V);
  const QPoint at = lensMiddle(w.view());
  QVERIFY(wrongPixels(w.view(), at, drawnAt(w.view(), at, 2)) > 1000);
  QTest::mousePress(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(showsLens(w.view(), at, 2));
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, at);
}

VOLUMEN_TEST(TestMagnifier);
#include "tst_magnifier.moc"
