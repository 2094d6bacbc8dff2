// Guards the orientation of flat pictures: rotated and mirrored by keys, with letters, measurements and
// corner text. A reference model computes where each patient position must appear, for random turns. Pictures
// have their own pixels and true size, and undo restores them exactly.
#include <QScreen>
#include <glm/mat2x2.hpp>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/two_series.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns a series whose edges and corners all differ.
LoadedSeriesPtr unevenSeries() {
  glm::dmat3 steps(1);
  steps[2] *= 2;
  const LoadedSeriesPtr made = seriesOf(volumeOf<std::int16_t>(
      {40, 26, 11}, steps, [](glm::dvec3 p) { return p.x + 40 * p.y + 3 * p.z * p.x; }));
  auto series = std::make_shared<LoadedSeries>(*made);
  series->series.acquired = series->volume->geometry();
  return series;
}

struct KeyTurn {
  Qt::Key key;
  Qt::KeyboardModifiers with;
  glm::dmat2 seen;  // its effect on positions relative to the picture's middle, x right and y down
};
const std::vector<KeyTurn> turns{{Qt::Key_R, Qt::ControlModifier, {{0, 1}, {-1, 0}}},
                                 {Qt::Key_R, Qt::ControlModifier | Qt::ShiftModifier, {{0, -1}, {1, 0}}},
                                 {Qt::Key_H, Qt::ControlModifier, {{-1, 0}, {0, 1}}},
                                 {Qt::Key_H, Qt::ControlModifier | Qt::ShiftModifier, {{1, 0}, {0, -1}}}};

void press(Journey& w, const KeyTurn& turn) { QTest::keyClick(&w.window, turn.key, turn.with); }

// Returns the picture of the view once it is drawn for its plane.
QImage settledPicture(MeasureWindow& w, const std::function<void()>& act) {
  QSignalSpy settled(w.view(), &FlatView::settled);
  act();
  return settled.wait(longest) ? w.view()->picture().convertToFormat(QImage::Format_RGB32) : QImage();
}

int largestDifference(const QImage& a, const QImage& b) {
  if (a.size() != b.size()) return 256;
  int most = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      most = std::max(most, std::abs(qGreen(a.pixel(x, y)) - qGreen(b.pixel(x, y))));
  return most;
}

}  // namespace

class TestPictureTurns : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void placesAppearWhereATwinPutsThem();
  void aMirroredPictureIsTheMirrorImage();
  void nothingIsShownTheWrongWayRound();
  void whatIsBeingDrawnIsGivenUp();
  void linkedViewsKeepTheirScale();
  void lettersAndCornersFollow();
  void measurementsStayOnThePatient();
  void planesTurnTheWayTheHandGoes();
  void framesTurnToo();
  void sizesAreWhatTheySay();
  void withoutASliceThereIsASentence();
};

void TestPictureTurns::placesAppearWhereATwinPutsThem() {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Chance chance(seed);
    MeasureWindow w(unevenSeries());
    const ViewId id = std::vector{axialViewId, coronalViewId, sagittalViewId}[std::size_t(chance.below(3))];
    w.session().setFocus(id);
    const Workspace before = w.session().workspace();
    const int steps = w.session().undoStack().count();
    const SlicePlane first = *w.view(id)->plane();
    const VoxelGeometry geometry = w.view(id)->shown()->volume->geometry();
    const glm::dvec2 wholeMm(planeAlong(geometry, first.right, first.down).size);
    glm::dmat2 seen(1);
    glm::dvec2 offMm(0);  // offset of the volume's centre from the middle of the view
    for (int n = 0; n < 12; ++n) {
      const double mm = w.view(id)->plane()->mmPerPixel;
      if (chance.oneIn(4)) {
        const QPoint way(chance.below(40) - 20, chance.below(40) - 20);
        drag(w.view(id), {90, 90}, QPointF(90, 90) + way, Qt::MiddleButton);
        offMm += mm * glm::dvec2(way.x(), way.y());
      } else {
        const KeyTurn& turn = turns[std::size_t(chance.below(int(turns.size())))];
        press(w, turn);
        seen = turn.seen * seen;
        offMm = turn.seen * offMm;
      }
      const SlicePlane now = *w.view(id)->plane();
      const glm::dvec2 whole = glm::abs(seen * wholeMm), pixels(now.size);
      const double fitted = std::max(whole.x / pixels.x, whole.y / pixels.y);
      QVERIFY2(std::abs(now.mmPerPixel / fitted - 1) < 0.1, qPrintable(QStringLiteral("seed %1").arg(seed)));
      for (int place = 0; place < 5; ++place) {
        const glm::dvec3 p =
            geometry.patientFromVoxel({chance.below(40), chance.below(26), chance.below(11)});
        const glm::dvec3 from = p - geometry.centre();
        const glm::dvec2 unturned(glm::dot(from, first.right), glm::dot(from, first.down));
        const glm::dvec2 expected = pixels / 2.0 + (seen * unturned + offMm) / now.mmPerPixel;
        QVERIFY2(glm::distance(now.pixelFromPatient(p), expected) < 0.01,
                 qPrintable(QStringLiteral("seed %1, step %2").arg(seed).arg(n)));
      }
    }
    while (w.session().undoStack().index() > steps) w.undo();
    QVERIFY(w.session().workspace() == before);
  }
}

void TestPictureTurns::aMirroredPictureIsTheMirrorImage() {
  MeasureWindow w(unevenSeries());
  w.view()->invert();
  const QImage before = settledPicture(w, [&] { w.view()->invert(); });
  const QImage mirrored = settledPicture(w, [&] { press(w, turns[2]); });
  QVERIFY(largestDifference(mirrored, before.mirrored(true, false)) <= 1);
  const QImage both = settledPicture(w, [&] { press(w, turns[3]); });
  QVERIFY(largestDifference(both, before.mirrored(true, true)) <= 1);
  QVERIFY(largestDifference(both, before) > 20);
  settledPicture(w, [&] { press(w, turns[0]); });
  const QImage around = settledPicture(w, [&] { press(w, turns[0]); });
  QVERIFY(largestDifference(around, before) <= 1);
}

// A late picture is not shown beside letters that are already new.
void TestPictureTurns::nothingIsShownTheWrongWayRound() {
  MeasureWindow w(unevenSeries());
  w.view()->invert();
  settledPicture(w, [&] { w.view()->invert(); });
  const QImage before = w.view()->capture();
  press(w, turns[2]);
  const QImage atOnce = w.view()->grab().toImage(), captured = w.view()->capture();
  const QPoint middle(w.view()->width() / 2 - 40, w.view()->height() / 2);
  QCOMPARE(atOnce.pixelColor(middle), QColor(Qt::black));
  QVERIFY(captured.pixelColor(middle) != QColor(Qt::black));
  QVERIFY(captured != before);
}

// An unfinished shape is cancelled instead of being continued on another picture.
void TestPictureTurns::whatIsBeingDrawnIsGivenUp() {
  MeasureWindow w;
  w.choose(ShapeKind::polyline);
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, {60, 60});
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, {90, 70});
  press(w, turns[2]);
  QTest::keyClick(w.view(), Qt::Key_Return);
  QVERIFY(w.all().empty());
  QVERIFY(flatLookOf(w.view()->state()).turn.mirrored);
  QTest::mousePress(w.view(), Qt::MiddleButton, {}, {60, 60});
  press(w, turns[2]);
  QVERIFY(flatLookOf(w.view()->state()).turn.mirrored);  // not during a drag
  QTest::mouseRelease(w.view(), Qt::MiddleButton, {}, {60, 60});
}

void TestPictureTurns::linkedViewsKeepTheirScale() {
  TwoSeries w(unevenSeries(), unevenSeries());
  w.session().change(QStringLiteral("Link"), [](Workspace& all) { all.links.zoom = true; });
  const double before = w.plane(left).mmPerPixel;
  press(w, turns[0]);
  QVERIFY(std::abs(w.plane(left).mmPerPixel / before - 1) > 0.1);  // the fitted size differs
  QVERIFY(std::abs(w.plane(left).mmPerPixel / w.plane(right).mmPerPixel - 1) < 1e-6);
}

void TestPictureTurns::lettersAndCornersFollow() {
  MeasureWindow w;
  const Overlays before = w.view()->overlays();
  QCOMPARE(before.left + before.right + before.top + before.bottom, QStringLiteral("RLAP"));
  press(w, turns[2]);
  QCOMPARE(w.view()->overlays().left, before.right);
  QVERIFY(w.view()->overlays().topRight.contains(QStringLiteral("Mirrored")));
  press(w, turns[2]);
  press(w, turns[0]);
  QCOMPARE(w.view()->overlays().right, before.top);
  QCOMPARE(w.view()->overlays().top, before.left);
  QVERIFY(w.view()->overlays().topRight.contains(QStringLiteral("Turned 90\u00b0")));
  QTest::keyClick(&w.window, Qt::Key_F);
  QCOMPARE(w.view()->overlays().topRight, before.topRight);
}

void TestPictureTurns::measurementsStayOnThePatient() {
  MeasureWindow w(unevenSeries());
  w.draw(ShapeKind::length, {{70, 60}, {131, 111}});
  const Measurement drawn = w.last();
  const double mm = w.measured(drawn)->number;
  const QPointF middle = w.drawn(drawn.id).middle;
  press(w, turns[2]);
  const QPointF mirrored(w.view()->width() - middle.x(), middle.y());
  QVERIFY(QLineF(w.drawn(drawn.id).middle, mirrored).length() < 1e-6);
  drag(w.view(), mirrored, mirrored + QPointF(-10, 0));  // drags by its line
  QVERIFY(QLineF(w.drawn(drawn.id).middle, mirrored + QPointF(-10, 0)).length() < 0.5);
  QVERIFY(std::abs(w.measured(w.last())->number - mm) < 1e-6);
}

// Dragging around the handle of another plane's line turns it with the pointer, mirrored or not.
void TestPictureTurns::planesTurnTheWayTheHandGoes() {
  for (const bool mirrored : {false, true}) {
    MeasureWindow w;
    if (mirrored) press(w, turns[2]);
    const auto coronal = [&] {
      const auto line = referenceLine(*w.view()->plane(), *w.view(coronalViewId)->plane());
      return std::atan2(line->to.y - line->from.y, line->to.x - line->from.x);
    };
    const double before = coronal();
    const SlicePress press{w.session(), axialViewId, w.view()->shown(), *w.view()->plane(), 1, {150.0, 80.0},
                           {},          {}};
    beginTurn(press)->moveTo({160, 90}, {});
    const QPointF middle = press.pixelAt(crosshairOf(w.session().workspace(), *w.view()->shown()).at);
    const auto angle = [&](QPointF p) { return std::atan2(p.y() - middle.y(), p.x() - middle.x()); };
    QVERIFY(std::abs(std::remainder(coronal() - before - (angle({160, 90}) - angle({150, 80})), M_PI)) <
            1e-6);
  }
}

void TestPictureTurns::framesTurnToo() {
  const std::string data = dataPath("dicom-2d");
  NEED_DATA(data);
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.session().setFocus(axialViewId);
  const QImage before = w.view()->picture().convertToFormat(QImage::Format_RGB32);
  QVERIFY(w.after([&] { press(w, turns[2]); }));
  QVERIFY(largestDifference(w.view()->picture().convertToFormat(QImage::Format_RGB32),
                            before.mirrored(true, false)) <= 1);
  QVERIFY(w.view()->overlays().topRight.contains(QStringLiteral("Mirrored")));
}

void TestPictureTurns::sizesAreWhatTheySay() {
  MeasureWindow w(unevenSeries());
  QTest::keyClick(&w.window, Qt::Key_O);
  QVERIFY(std::abs(w.view()->plane()->mmPerPixel - 1) < 1e-9);
  QTest::keyClick(&w.window, Qt::Key_O, Qt::ShiftModifier);
  const QScreen* screen = w.view()->screen();
  if (screen->physicalSize().isEmpty())
    QCOMPARE(w.child<Banner>("banner")->sentence(),
             QStringLiteral("The screen does not say how large it is."));
  else
    QVERIFY(std::abs(w.view()->plane()->mmPerPixel - 25.4 / screen->physicalDotsPerInch()) < 1e-9);
}

void TestPictureTurns::withoutASliceThereIsASentence() {
  Journey w;
  for (const KeyTurn& turn : turns) {
    w.child<Banner>("banner")->hide();
    press(w, turn);
    QVERIFY(w.child<Banner>("banner")->isVisible());
  }
}

VOLUMEN_TEST(TestPictureTurns);
#include "tst_picture_turns.moc"
