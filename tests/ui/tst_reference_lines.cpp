// Guards the lines of other views' planes: in compared layouts, through links between frames of reference,
// over frames, and of first and last slices. They are switched by action, key and preference.
#include "tests/ui/clean_settings.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/derivations/measured_numbers.h"
#include "ui/views/reference_lines.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Axial on the left, coronal on the right.
struct Crossed : TwoSeries {
  Crossed(const LoadedSeriesPtr& a, const LoadedSeriesPtr& b) : TwoSeries(a, b) {
    session().showAs(right, ViewKind::coronal);
    session().setFocus(left);
    QCoreApplication::processEvents();
  }
  std::vector<ReferenceLine> lines(ViewId id) { return view(id)->referenceLines(); }
  // Returns a point's height in the left view, logical pixels from the top.
  double down(glm::dvec3 p) { return plane(left).pixelFromPatient(p).y / view(left)->devicePixelRatioF(); }
};

// Counts the pixels in which green outweighs red.
int greenPixels(const QImage& image) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) count += qGreen(image.pixel(x, y)) > qRed(image.pixel(x, y)) + 30;
  return count;
}

}  // namespace

class TestReferenceLines : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void aPlaneOfTheSameFrameIsALine();
  void aLineFollowsItsPlane();
  void otherFramesNeedALink();
  void parallelPlanesHaveNone();
  void firstAndLastSlicesAreAnOption();
  void theyAreSwitchedOffAndKept_data();
  void theyAreSwitchedOffAndKept();
  void planesOfOneSeriesHaveTheCrosshairs();
  void theyAreDrawnInTheOthersColour();
  void framesHaveThemToo();
  void localizersOfOneStackHaveThem();
  void picturesHaveThoseOfTheirWorkspace();
};

void TestReferenceLines::aPlaneOfTheSameFrameIsALine() {
  Crossed w(ballIn("A"), ballIn("A", 2));
  const auto lines = w.lines(left);
  QCOMPARE(lines.size(), std::size_t(1));
  QCOMPARE(lines[0].other, right);
  QCOMPARE(lines[0].name, QStringLiteral("Coronal"));
  QCOMPARE(lines[0].colour, QRgb(rowOf(ViewKind::coronal).plane->lineColour));
  const double y = w.down(w.plane(right).centre);
  QVERIFY(std::abs(lines[0].line.y1() - y) < 1e-6 && std::abs(lines[0].line.y2() - y) < 1e-6);
  QVERIFY2(std::abs(lines[0].line.length() - w.view(left)->width()) < 1e-6, "from edge to edge");
  QCOMPARE(w.lines(right).size(), std::size_t(1));
  QCOMPARE(w.lines(right)[0].name, QStringLiteral("Axial"));
}

void TestReferenceLines::aLineFollowsItsPlane() {
  Crossed w(ballIn("A"), ballIn("A", 2));
  w.scroll(right, 1);  // from the middle of A, which lies between two of its slices
  const double before = w.lines(left)[0].line.y1();
  w.scroll(right, 3);
  const double mm = w.plane(left).mmPerPixel * w.view(left)->devicePixelRatioF();
  // Three slices of 2 mm to posterior, which is down in an axial picture.
  QVERIFY(std::abs(w.lines(left)[0].line.y1() - before - 6 / mm) < 1e-6);
}

void TestReferenceLines::otherFramesNeedALink() {
  Crossed w(ballIn("A"), ballIn("B", 2));
  QVERIFY(w.lines(left).empty());
  QVERIFY(w.lines(right).empty());
  w.press("lockHere");
  QCOMPARE(w.lines(left).size(), std::size_t(1));
  QCOMPARE(w.lines(right).size(), std::size_t(1));
  w.press("undo");
  QVERIFY(w.lines(left).empty());
}

void TestReferenceLines::parallelPlanesHaveNone() {
  TwoSeries w(ballIn("A"), ballIn("A", 2));
  QVERIFY(w.view(left)->referenceLines().empty());
}

void TestReferenceLines::firstAndLastSlicesAreAnOption() {
  Crossed w(ballIn("A"), ballIn("A", 0.5));
  QCOMPARE(w.lines(left).size(), std::size_t(1));
  w.press("referenceEnds");
  const auto lines = w.lines(left);
  QCOMPARE(lines.size(), std::size_t(3));
  // 32 slices of 0.5 mm about the origin.
  const double first = w.down({0, -7.75, 0}), last = w.down({0, 7.75, 0});
  QVERIFY(lines[1].part == FlatView::StackPart::first && lines[2].part == FlatView::StackPart::last);
  QVERIFY(std::abs(lines[1].line.y1() - first) < 1e-6);
  QVERIFY(std::abs(lines[2].line.y1() - last) < 1e-6);
  QVERIFY2(lines[1].name.isEmpty() && lines[2].name.isEmpty(), "one name is enough");
  w.press("referenceEnds");
  QCOMPARE(w.lines(left).size(), std::size_t(1));
}

void TestReferenceLines::theyAreSwitchedOffAndKept_data() {
  QTest::addColumn<bool>("byKey");
  QTest::newRow("by the menu") << false;
  QTest::newRow("by Shift+H") << true;
}

void TestReferenceLines::theyAreSwitchedOffAndKept() {
  QFETCH(bool, byKey);
  Crossed w(ballIn("A"), ballIn("A", 2));
  auto* action = w.child<QAction>("referenceLines");
  QVERIFY(action->isChecked());
  if (byKey)
    QTest::keyClick(w.view(left), Qt::Key_H, Qt::ShiftModifier);
  else
    action->trigger();
  QVERIFY(w.lines(left).empty());
  QVERIFY(!action->isChecked());
  QVERIFY(!storedPreferences().referenceLines);
  QVERIFY2(storedPreferences().crosshairLines, "these are others");
  action->trigger();
  QCOMPARE(w.lines(left).size(), std::size_t(1));
}

// Linked planes of one series are moved by their lines. Unlinked, each has its own position.
void TestReferenceLines::planesOfOneSeriesHaveTheCrosshairs() {
  const LoadedSeriesPtr ball = ballIn("A");
  Crossed w(ball, ball);
  QVERIFY(w.lines(left).empty());
  w.session().change(QStringLiteral("Link"), withScrollLinked(w.workspace(), false));
  QCOMPARE(w.lines(left).size(), std::size_t(1));
  w.scroll(right, 4);
  QVERIFY(std::abs(w.lines(left)[0].line.y1() - w.down(w.plane(right).centre)) < 1e-6);
}

void TestReferenceLines::theyAreDrawnInTheOthersColour() {
  Crossed w(ballIn("A"), ballIn("A", 2));
  QVERIFY(greenPixels(w.view(left)->capture()) > w.view(left)->width() / 4);
  w.press("referenceLines");
  QCOMPARE(greenPixels(w.view(left)->capture()), 0);
}

void TestReferenceLines::framesHaveThemToo() {
  NEED_FILES();
  Frames w({"../pet-ct/sts019-ct"});
  QVERIFY(w.settle());
  w.child<QAction>("layoutTwo")->trigger();
  const Series series = w.session().seriesOf(left)->series;
  w.session().showFrames(series, right);
  w.session().showAs(left, ViewKind::coronal);
  QVERIFY(w.shows(right));
  const auto lines = w.view(left)->referenceLines();
  QCOMPARE(lines.size(), std::size_t(1));
  QCOMPARE(lines[0].other, right);
  QCOMPARE(lines[0].colour, QRgb(rowOf(ViewKind::axial).plane->lineColour));
  const glm::dvec2 at = w.view(left)->plane()->pixelFromPatient(frameIn(w.view(right))->geometry().centre());
  QVERIFY(std::abs(lines[0].line.center().y() - at.y / w.view(left)->devicePixelRatioF()) < 0.01);
  QCOMPARE(w.view(right)->referenceLines().size(), std::size_t(1));
  QCOMPARE(w.view(right)->referenceLines()[0].name, QStringLiteral("Coronal"));
  w.child<QAction>("referenceEnds")->trigger();
  QCOMPARE(w.view(left)->referenceLines().size(), std::size_t(3));
}

// Each view has the line of the plane that the other currently shows. Parallel planes have none.
void TestReferenceLines::localizersOfOneStackHaveThem() {
  NEED_FILES();
  Frames w({"../dicom-geometry/mr-localizer-ge-3plane-21"});
  QVERIFY(w.shows());
  const Series stack = *seriesIn(w.workspace(), axialViewId);
  QVERIFY(!stack.notVolume.empty() && !stack.frameOfReferenceUid.empty());
  w.child<QAction>("layoutTwo")->trigger();
  for (const ViewId id : {left, right}) w.session().showFrames(stack, id);
  QVERIFY(w.shows(left) && w.shows(right));
  QVERIFY2(w.view(left)->referenceLines().empty(), "both are axial");
  struct Shown {
    int frame;
    ViewKind kind;
  };
  for (const Shown& shown : {Shown{10, ViewKind::sagittal}, {20, ViewKind::coronal}}) {
    while (w.look(right).frame < shown.frame) QTest::keyClick(w.view(right), Qt::Key_Down);
    QVERIFY(w.shows(right));
    const auto lines = w.view(left)->referenceLines();
    QCOMPARE(lines.size(), std::size_t(1));
    QCOMPARE(lines[0].other, right);
    QCOMPARE(lines[0].colour, QRgb(rowOf(shown.kind).plane->lineColour));
    const glm::dvec3 middle = frameIn(w.view(right))->geometry().centre();
    const glm::dvec2 at = w.view(left)->plane()->pixelFromPatient(middle) / w.view(left)->devicePixelRatioF();
    const QPointF seen = lines[0].line.center();
    const bool isUpright = shown.kind == ViewKind::sagittal;
    QVERIFY(std::abs(isUpright ? seen.x() - at.x : seen.y() - at.y) < 0.01);
    QCOMPARE(w.view(right)->referenceLines().size(), std::size_t(1));
  }
}

// The views on screen have changed meanwhile.
void TestReferenceLines::picturesHaveThoseOfTheirWorkspace() {
  Crossed w(ballIn("A"), ballIn("A", 2));
  const QLineF before = w.lines(left).at(0).line;
  Session copy;
  copy.prefer(w.session().preferences());
  for (const ViewId id : {left, right}) {
    const SeriesKey key = w.workspace().view(id).series;
    copy.pool().put({key, {}}, w.session().seriesNamed(key));
  }
  copy.open({}, w.workspace());
  FrameService frames;
  MeasuredNumbers measurer(copy, frames);
  const std::unique_ptr<FlatView> unseen =
      w.window.views()->unseenView(copy, frames, measurer, left, w.window.views()->highlights());
  unseen->resize(w.view(left)->size());
  w.scroll(right, 5);
  QVERIFY(w.lines(left).at(0).line != before);
  QCOMPARE(unseen->referenceLines().size(), std::size_t(1));
  QCOMPARE(unseen->referenceLines()[0].line, before);
}

VOLUMEN_TEST(TestReferenceLines);
#include "tst_reference_lines.moc"
