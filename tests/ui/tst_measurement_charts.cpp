// Guards the chart of values under a measurement, by real events: profile, histogram and mean over time. It
// follows the selection and the shape, and can be copied.
#include <QClipboard>
#include <QComboBox>
#include <QDockWidget>
#include <QGuiApplication>
#include <QLabel>
#include <QTemporaryDir>
#include <QToolButton>
#include <fstream>

#include "results/text/value_text.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "ui/panels/chart_panel.h"
#include "ui/workspace/flat_plane.h"

using namespace volumen;
using namespace volumen::tests;
using enum ShapeKind;

namespace {

// The chart panel of any window.
struct ChartOf {
  Journey& w;

  void open() {
    w.child<QAction>("measurementChart")->trigger();
    QCoreApplication::processEvents();
  }
  const MeasuredChart& shown() { return w.child<ChartView>("chartView")->chart(); }
  QString said() { return w.child<QLabel>("chartSaid")->text(); }
  QComboBox* kind() { return w.child<QComboBox>("chartKind"); }
};

struct ChartWindow : MeasureWindow {
  ChartOf chart{*this};

  // Returns a line through the middle of the ball and out on both sides.
  std::vector<QPointF> acrossTheBall() {
    const SlicePlane plane = *view()->plane();
    const glm::dvec2 middle = plane.pixelFromPatient({3, -2, 4});
    const QPointF centre(std::round(middle.x), std::round(middle.y)),
        half(std::round(12 / plane.mmPerPixel), 0);
    return {centre - half, centre + half};
  }
  // Moves points so that half of them lie in the ball and half in the air beside it.
  std::vector<QPointF> atItsEdge(const std::vector<QPointF>& places) {
    return placesWithin(places, {-5, -2, 4}, 6);
  }
  LoadedSeriesPtr seriesOf(const Measurement& m) { return session().seriesNamed(m.series); }
  MeasuredChart profile(const Measurement& m, Interpolation how = Interpolation::linear) {
    const LoadedSeriesPtr series = seriesOf(m);
    return profileChart(m.shape.points, *series->volume, shownScale(series->series), how, *measured(m));
  }
  MeasuredChart histogram(const Measurement& m) {
    const LoadedSeriesPtr series = seriesOf(m);
    return histogramChart(m.shape, *series->volume, shownScale(series->series), QStringLiteral("Voxels"));
  }
};

// Writes four volumes of 16 voxels of 2 mm along each edge. Volume n has the value 100 n.
QString fourSteps(const QTemporaryDir& folder) {
  const QString path = folder.filePath(QStringLiteral("four.nrrd"));
  std::ofstream file(path.toStdString(), std::ios::binary);
  file << "NRRD0005\ntype: int16\ndimension: 4\nspace: left-posterior-superior\nsizes: 16 16 16 4\n"
          "space directions: (2,0,0) (0,2,0) (0,0,2) none\nkinds: domain domain domain time\n"
          "space origin: (0,0,0)\nendian: little\nencoding: raw\n\n";
  for (int n = 1; n <= 4; ++n) {
    const std::vector<std::int16_t> values(16 * 16 * 16, std::int16_t(100 * n));
    file.write(reinterpret_cast<const char*>(values.data()),
               std::streamsize(values.size() * sizeof values[0]));
  }
  return path;
}

}  // namespace

class TestMeasurementCharts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void nothingSelectedSaysWhatToDo();
  void aLineHasItsProfile_data();
  void aLineHasItsProfile();
  void nearestIsAsThePlaneShows();
  void aRegionHasItsHistogram();
  void itFollowsTheSelection();
  void aChartIsOfWhatIsSelected();
  void behindAnotherTabNothingIsWorkedOut();
  void csvIsCopied();
  void aRegionThroughTime();
  void onAFrame();
};

void TestMeasurementCharts::nothingSelectedSaysWhatToDo() {
  ChartWindow w;
  w.chart.open();
  QVERIFY(w.child<ChartView>("chartView")->isVisible());
  QVERIFY2(w.chart.said().startsWith(QStringLiteral("Select a length")), qPrintable(w.chart.said()));
  QVERIFY(!w.child<QToolButton>("chartCopy")->isEnabled());
  w.draw(angle, placesOf(angle));
  QVERIFY2(w.chart.said().startsWith(QStringLiteral("Select a length")), "an angle has none");
}

void TestMeasurementCharts::aLineHasItsProfile_data() {
  QTest::addColumn<int>("kind");
  QTest::newRow("length") << int(length);
  QTest::newRow("polyline") << int(polyline);
}

// The line crosses the ball, from the air of 0 to its 1000 HU.
void TestMeasurementCharts::aLineHasItsProfile() {
  QFETCH(int, kind);
  ChartWindow w;
  w.chart.open();
  w.draw(ShapeKind(kind), w.acrossTheBall());
  const MeasuredChart wanted = w.profile(w.last());
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == wanted, longest);
  QCOMPARE(wanted.xTitle, QStringLiteral("Distance (mm)"));
  QCOMPARE(wanted.yTitle, QStringLiteral("Value (HU)"));
  double least = 1e9, most = -1e9;
  for (const QPointF p : wanted.lines.at(0)) least = std::min(least, p.y()), most = std::max(most, p.y());
  QCOMPARE(least, 0.0);
  QCOMPARE(most, 1000.0);
  QVERIFY(std::abs(wanted.lines.back().back().x() - w.measured(w.last())->number) < 1e-9);
  QCOMPARE(w.chart.said(), nameText(w.last()));
  QVERIFY(!w.chart.kind()->isEnabled());
  // The view draws something.
  auto* view = w.child<ChartView>("chartView");
  const QImage picture = view->grab().toImage();
  int coloured = 0;
  const QColor line = view->palette().color(QPalette::Highlight);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const QColor at = picture.pixelColor(x, y);
      const int off = std::abs(at.red() - line.red()) + std::abs(at.green() - line.green()) +
                      std::abs(at.blue() - line.blue());
      coloured += off < 90;  // antialiased edges
    }
  QVERIFY(coloured > 50);
  w.shot("chart-profile");
}

void TestMeasurementCharts::nearestIsAsThePlaneShows() {
  ChartWindow w;
  w.chart.open();
  w.draw(length, w.acrossTheBall());
  const MeasuredChart linear = w.profile(w.last()), nearest = w.profile(w.last(), Interpolation::nearest);
  QVERIFY(!(linear == nearest));
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == linear, longest);
  w.session().change(QStringLiteral("test"), [&](Workspace& now) {
    ViewState& view = now.editView(axialViewId);
    view.flats.editOrAdd(view.series).nearest = true;
  });
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == nearest, longest);
  w.undo();
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == linear, longest);
}

void TestMeasurementCharts::aRegionHasItsHistogram() {
  ChartWindow w;
  w.chart.open();
  const std::vector<QPointF> places = w.atItsEdge(placesOf(ellipse));
  w.draw(ellipse, places);
  const MeasuredChart wanted = w.histogram(w.last());
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == wanted, longest);
  QCOMPARE(wanted.yTitle, QStringLiteral("Voxels"));
  QVERIFY(!wanted.lines.empty());
  // After an edge is dragged, the chart is that of the new region.
  drag(w.view(), places[1], places[1] + QPointF(19, 29));
  const MeasuredChart larger = w.histogram(w.last());
  QVERIFY(!(larger == wanted));
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == larger, longest);
  w.undo();
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == wanted, longest);
}

void TestMeasurementCharts::itFollowsTheSelection() {
  ChartWindow w;
  w.chart.open();
  const std::vector<QPointF> p =
      w.atItsEdge({{50, 150}, {130, 150}, {60, 60}, {120, 110}, {90, 150}, {20, 180}});
  w.draw(length, {p[0], p[1]});
  w.draw(rectangle, {p[2], p[3]});
  QVERIFY(!w.histogram(w.all()[1]).lines.empty() && !w.profile(w.all()[0]).lines.empty());
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == w.histogram(w.all()[1]), longest);
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, p[4].toPoint());
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == w.profile(w.all()[0]), longest);
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, p[5].toPoint());
  QVERIFY(w.chart.shown().lines.empty());
  QVERIFY(w.chart.said().startsWith(QStringLiteral("Select a length")));
}

// A measurement whose series is not in memory has no chart, not even an earlier one. The others then have
// theirs again.
void TestMeasurementCharts::aChartIsOfWhatIsSelected() {
  ChartWindow w;
  w.chart.open();
  const std::vector<QPointF> p = w.atItsEdge({{50, 150}, {130, 150}, {60, 60}, {120, 110}});
  w.draw(length, {p[0], p[1]});
  w.draw(rectangle, {p[2], p[3]});
  const Measurement line = w.all()[0], box = w.all()[1];
  const int notHere = box.id + 1;
  w.session().change(QStringLiteral("test"), [&](Workspace& now) {
    auto series = std::make_shared<Series>(w.seriesOf(line)->series);
    series->id = "elsewhere";
    now.series.editOrAdd(keyOf(*series)).series = series;
    Measurement other = line;
    other.id = notHere;
    other.series = keyOf(*series);
    now.measurements.push_back(other);
  });
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == w.histogram(box), longest);
  const auto hasNone = [&] {
    return w.chart.shown().lines.empty() && w.chart.said().startsWith(QStringLiteral("Show the series of "));
  };
  w.session().select(line.id);
  w.session().select(notHere);
  QVERIFY(hasNone());
  QTest::qWait(200);
  QVERIFY2(hasNone(), "the chart that was under way is given up");
  w.session().select(line.id);
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == w.profile(line), longest);
  w.session().select(notHere);
  QVERIFY(hasNone());
  w.session().select(line.id);
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == w.profile(line), longest);
  QCOMPARE(w.chart.said(), nameText(line));
}

void TestMeasurementCharts::behindAnotherTabNothingIsWorkedOut() {
  ChartWindow w;
  w.chart.open();
  const auto isInFront = [&] { return w.child<QDockWidget>("chartDock")->geometry().right() >= 0; };
  QTRY_VERIFY_WITH_TIMEOUT(isInFront(), longest);
  w.child<QDockWidget>("measurementsDock")->raise();
  QTRY_VERIFY_WITH_TIMEOUT(!isInFront(), longest);
  w.draw(length, w.acrossTheBall());
  QTest::qWait(200);
  QVERIFY(w.chart.shown().lines.empty());
  w.chart.open();
  QTRY_VERIFY_WITH_TIMEOUT(w.chart.shown() == w.profile(w.last()), longest);
}

void TestMeasurementCharts::csvIsCopied() {
  ChartWindow w;
  w.chart.open();
  w.draw(length, w.atItsEdge(placesOf(length)));
  auto* copy = w.child<QToolButton>("chartCopy");
  QTRY_VERIFY_WITH_TIMEOUT(copy->isEnabled(), longest);
  QTest::mouseClick(copy, Qt::LeftButton);
  QCOMPARE(QGuiApplication::clipboard()->text(), chartAsCsv(w.profile(w.last())));
  QVERIFY(QGuiApplication::clipboard()->text().startsWith(
      QStringLiteral("\"Distance (mm)\",\"Value (HU)\"\r\n")));
}

// Time points that were never shown are read for the chart.
void TestMeasurementCharts::aRegionThroughTime() {
  const QTemporaryDir folder;
  Journey w({fourSteps(folder)});
  QVERIFY(QTest::qWaitFor([&] { return w.window.session().series() != nullptr; }, longest));
  w.child<QAction>("layoutPlanes")->trigger();
  QCoreApplication::processEvents();
  w.window.session().setFocus(axialViewId);
  auto* view = w.window.views()->viewAs<FlatView>(axialViewId);
  ChartOf chart{w};
  chart.open();
  const glm::dvec2 middle = view->plane()->pixelFromPatient({15, 15, 15});
  const QPointF centre(std::round(middle.x), std::round(middle.y));
  w.child<QAction>("rectangleTool")->trigger();
  drawShape(view, rectangle, {centre - QPointF(25, 20), centre + QPointF(25, 20)});
  QCOMPARE(w.window.session().workspace().measurements.size(), std::size_t(1));
  QCOMPARE(chart.kind()->count(), 2);
  QCOMPARE(chart.kind()->currentText(), QStringLiteral("Histogram"));
  QTest::keyClick(chart.kind(), Qt::Key_Down);
  QCOMPARE(chart.kind()->currentText(), QStringLiteral("Over time"));
  MeasuredChart wanted;
  wanted.xTitle = QStringLiteral("Volume");
  wanted.marked = true;
  wanted.lines = {{{1, 100}, {2, 200}, {3, 300}, {4, 400}}};
  QTRY_VERIFY_WITH_TIMEOUT(chart.shown().lines == wanted.lines, longest);
  QCOMPARE(chart.shown().xTitle, wanted.xTitle);
  QVERIFY(chart.shown().marked && chart.shown().problem.isEmpty());
  // Dragging a corner reads nothing. The release does.
  const auto isRead = [&] {
    return std::ranges::any_of(w.window.jobs().rows(), [](const JobRow& row) {
      return row.text.startsWith(QStringLiteral("Reading all time points"));
    });
  };
  const QPoint corner = (centre + QPointF(25, 20)).toPoint();
  const Shape before = w.window.session().workspace().measurements[0].shape;
  QTest::mousePress(view, Qt::LeftButton, {}, corner);
  for (const QPoint way : {QPoint(4, 4), QPoint(8, 8), QPoint(12, 12)}) {
    QTest::mouseEvent(QTest::MouseMove, view, Qt::LeftButton, {}, corner + way);
    QVERIFY(!isRead());
  }
  QTest::mouseRelease(view, Qt::LeftButton, {}, corner + QPoint(12, 12));
  QVERIFY(w.window.session().workspace().measurements[0].shape != before);
  QVERIFY(!isRead());
  auto* drawn = w.child<ChartView>("chartView");
  drawn->setChart({});
  QTRY_VERIFY_WITH_TIMEOUT(chart.shown().lines == wanted.lines, longest);
}

void TestMeasurementCharts::onAFrame() {
  NEED_FILES();
  Frames w({"cr-chest-mono1-jpeg8.dcm"});
  QVERIFY(w.shows());
  ChartOf chart{w};
  chart.open();
  w.child<QAction>("lengthTool")->trigger();
  const QPointF middle = QRectF(w.view()->rect()).center();
  drawShape(w.view(), length, {middle - QPointF(60, 40), middle + QPointF(60, 40)});
  QCOMPARE(w.workspace().measurements.size(), std::size_t(1));
  QTRY_VERIFY_WITH_TIMEOUT(!chart.shown().lines.empty(), longest);
  const Measurement m = w.workspace().measurements[0];
  const LoadedFramePtr frame = frameIn(w.view());
  const auto number = measureOnFrame(m.shape, pixelsOf(*frame), {});
  QCOMPARE(chart.shown().xTitle, QStringLiteral("Distance (mm)"));
  QVERIFY(std::abs(chart.shown().lines.back().back().x() - number->number) < 1e-6);
}

VOLUMEN_TEST(TestMeasurementCharts);
#include "tst_measurement_charts.moc"
