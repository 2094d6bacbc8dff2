// Guards slices.md 4 on frames in the window: drawing, millimetres and their qualifying word, and where a
// measurement is visible. Real mouse and key events. Numbers are from the README of the data.
#include <QClipboard>
#include <QDir>
#include <QDockWidget>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidget>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using namespace volumen::tests;
using enum ShapeKind;

namespace {

QString pictureFile(const char* name) {
  return QString::fromStdString(dataPath("dicom-2d")) + QLatin1Char('/') + QLatin1String(name);
}

// A window with one test file, shown as frames.
struct MeasuredFrames : Journey {
  explicit MeasuredFrames(const char* file) {
    window.resize(1440, 900);
    window.open({pictureFile(file)});
  }

  Session& session() { return window.session(); }
  FlatView* view() { return window.views()->viewAs<FlatView>(axialViewId); }
  const SharedList<Measurement>& all() { return session().workspace().measurements; }

  bool shows(int frame = 0) {
    return QTest::qWaitFor(
        [&] {
          auto* asFrames = child<QAction>("showAsFrames");
          if (asFrames->isEnabled() && !asFrames->isChecked()) asFrames->trigger();
          FlatView* v = view();
          return v && frameIn(v) && frameIn(v)->key.index == frame && !v->picture().isNull();
        },
        longest);
  }
  // Returns the position of a frame's pixel in the view.
  QPointF at(glm::dvec2 pixel) {
    const glm::dvec3 p = frameIn(view())->geometry().patientFromVoxel({pixel, 0});
    const glm::dvec2 on = view()->plane()->pixelFromPatient(p) / view()->devicePixelRatioF();
    return {on.x, on.y};
  }
  // Draws with the tool of a menu action, in whole logical pixels as a hand does.
  void draw(ShapeKind kind, const std::vector<glm::dvec2>& pixels) {
    child<QAction>((std::string(ruleOf(kind).name) + "Tool").c_str())->trigger();
    std::vector<QPointF> p;
    for (const glm::dvec2 pixel : pixels) p.push_back(at(pixel));
    drawShape(view(), kind, p);
  }
  // Returns the text beside the last shape.
  QString text() {
    for (const DrawnMeasurement& d : view()->drawnMeasurements())
      if (!all().empty() && d.id == all().back().id) return d.text.join(QStringLiteral("; "));
    return {};
  }
  Shape& exact(Workspace& w, const std::vector<glm::dvec2>& pixels) {
    Shape& shape = w.measurements.edit(w.measurements.size() - 1).shape;
    shape.points.clear();
    for (const glm::dvec2 p : pixels) shape.points.emplace_back(p, 0);
    return shape;
  }
};

#define NEED_PICTURES()                   \
  NEED_DATA(tests::dataPath("dicom-2d")); \
  QVERIFY(QDir(pictureFile("")).exists())

}  // namespace

class TestFrameMeasurements : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void numbersWithTheirWord_data();
  void numbersWithTheirWord();
  void closedForms_data();
  void closedForms();
  void everyToolDraws_data();
  void everyToolDraws();
  void anEndFollowsThePointer_data();
  void anEndFollowsThePointer();
  void onlyOnItsFrame();
  void thePanelGoesThere();
  void asSessionAndJson();
  void aSessionMeasuresFramesThatAreNotOnScreen();
};

void TestFrameMeasurements::numbersWithTheirWord_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<int>("kind");
  QTest::addColumn<std::vector<glm::dvec2>>("pixels");
  QTest::addColumn<QString>("text");
  using Pixels = std::vector<glm::dvec2>;
  const auto row = [](const char* name, const char* file, ShapeKind kind, Pixels pixels, const char* text) {
    QTest::newRow(name) << QString::fromLatin1(file) << int(kind) << pixels << QString::fromUtf8(text);
  };
  row("at the detector", "cr-chest-mono1-jpeg8.dcm", length, {{500, 900}, {1500, 900}},
      "175 mm (at detector)");
  row("magnification", "mg-ermf-overlay-shutter.dcm", length, {{100, 100}, {100, 700}},
      "48.9 mm (magnification corrected)");
  row("no size", "xa-96frames.dcm", length, {{100, 100}, {130, 140}}, "50 px");
  row("in the patient", "ct-two-windows.dcm", length, {{100, 100}, {400, 500}}, "143.6 mm");
  row("ultrasound, across", "us-cine-aspect-regions.dcm", length, {{100, 200}, {200, 200}}, "28.6 mm");
  row("ultrasound, down", "us-cine-aspect-regions.dcm", length, {{100, 200}, {100, 300}}, "22.9 mm");
  row("ultrasound, time", "us-cine-aspect-regions.dcm", length, {{100, 390}, {200, 390}}, "100 px; 0.502 s");
  row("ultrasound, outside", "us-cine-aspect-regions.dcm", length, {{100, 360}, {200, 360}}, "100 px");
  row("colour", "us-cine-aspect-regions.dcm", rectangle, {{100, 200}, {200, 300}}, "Area 653.1 mm\u00b2");
  row("values", "ct-two-windows.dcm", rectangle, {{159.5, 189.5}, {160.5, 190.5}},
      "Area 0.0824 mm\u00b2; Mean 141, SD 0 HU; Min 141, max 141 HU; 1 pixel");
  row("a probe", "ct-two-windows.dcm", probe, {{256, 256}}, "202 HU");
}

// Draws by mouse within a pixel of the screen, then sets the README's exact pixels.
void TestFrameMeasurements::numbersWithTheirWord() {
  NEED_PICTURES();
  QFETCH(QString, file);
  QFETCH(int, kind);
  QFETCH(std::vector<glm::dvec2>, pixels);
  MeasuredFrames w(file.toLatin1());
  QVERIFY(w.shows());
  std::vector<glm::dvec2> far = pixels;
  if (ShapeKind(kind) == rectangle) far = {pixels[0], pixels[0] + glm::dvec2(60, 60)};
  w.draw(ShapeKind(kind), far);
  QCOMPARE(w.all().size(), std::size_t(1));
  const Shape drawn = w.all()[0].shape;
  QVERIFY(drawn.frame && drawn.frame->number == 0 && !drawn.frame->instance.empty());
  const double screenPixel = w.view()->plane()->mmPerPixel / frameIn(w.view())->geometry().spacing().y;
  for (std::size_t n = 0; n < far.size(); ++n)
    QVERIFY(glm::length(glm::dvec2(drawn.points[n]) - far[n]) <= screenPixel);
  w.session().change(QStringLiteral("test"), [&](Workspace& now) { w.exact(now, pixels); });
  QTEST(w.text(), "text");
  w.shot((std::string("frame-") + QTest::currentDataTag()).c_str());
}

void TestFrameMeasurements::closedForms_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<int>("kind");
  QTest::addColumn<std::vector<glm::dvec2>>("pixels");
  QTest::addColumn<double>("number");
  QTest::addColumn<QString>("unit");
  using Pixels = std::vector<glm::dvec2>;
  const auto row = [](const char* name, const char* file, ShapeKind kind, Pixels pixels, double number,
                      const char* unit) {
    QTest::newRow(name) << QString::fromLatin1(file) << int(kind) << pixels << number
                        << QString::fromUtf8(unit);
  };
  const double pi = 3.14159265358979, degrees = 180 / pi;
  // In its region a pixel has these mm across and down: pixels are not square.
  const char* const us = "us-cine-aspect-regions.dcm";
  const double x = 0.285714, y = 0.228571;
  const Pixels triangle{{100, 200}, {200, 200}, {200, 300}};
  row("ultrasound, polyline", us, polyline, triangle, 100 * x + 100 * y, "mm");
  row("ultrasound, slanting polyline", us, polyline, {{100, 200}, {200, 300}, {300, 200}},
      200 * std::hypot(x, y), "mm");
  row("ultrasound, angle", us, angle, {{200, 200}, {100, 200}, {200, 300}}, degrees * std::atan2(y, x),
      "degrees");
  row("ultrasound, Cobb angle", us, cobb, {{100, 200}, {200, 200}, {100, 250}, {200, 300}},
      degrees * std::atan2(50 * y, 100 * x), "degrees");
  row("ultrasound, freehand", us, freehand, triangle, 5000 * x * y, "mm^2");
  row("ultrasound, ellipse", us, ellipse, {{100, 200}, {200, 300}}, pi / 4 * 1e4 * x * y, "mm^2");
  row("ultrasound, axes", us, bidirectional, {{100, 200}, {200, 200}, {150, 180}, {150, 250}}, 100 * x, "mm");
  const char* const mammogram = "mg-ermf-overlay-shutter.dcm";
  const double breast = 0.085 / 1.0433386837881;
  row("magnification, polyline", mammogram, polyline, {{100, 100}, {100, 700}, {500, 700}}, 1000 * breast,
      "mm");
  row("magnification, freehand", mammogram, freehand, {{100, 100}, {500, 100}, {500, 400}, {100, 400}},
      12e4 * breast * breast, "mm^2");
  row("magnification, Cobb angle", mammogram, cobb, {{100, 100}, {400, 100}, {100, 200}, {400, 500}}, 45,
      "degrees");
  const char* const chest = "cr-chest-mono1-jpeg8.dcm";
  row("at the detector, polyline", chest, polyline, {{500, 900}, {800, 1300}, {800, 900}}, 900 * 0.175, "mm");
  row("at the detector, ellipse", chest, ellipse, {{500, 900}, {1500, 1300}}, pi * 500 * 200 * 0.175 * 0.175,
      "mm^2");
  row("at the detector, cardiothoracic ratio", chest, cardiothoracic,
      {{500, 900}, {800, 900}, {400, 1000}, {1400, 1000}}, 0.3, "");
  const char* const unknown = "xa-96frames.dcm";
  row("no size, polyline", unknown, polyline, {{100, 100}, {130, 140}, {130, 240}}, 150, "px");
  row("no size, freehand", unknown, freehand, {{100, 100}, {300, 100}, {100, 200}}, 1e4, "px^2");
  row("no size, angle", unknown, angle, {{200, 100}, {100, 100}, {200, 200}}, 45, "degrees");
}

// All tools give the numbers of the files to their last digit, as copied in CSV.
void TestFrameMeasurements::closedForms() {
  NEED_PICTURES();
  QFETCH(QString, file);
  QFETCH(int, kind);
  QFETCH(std::vector<glm::dvec2>, pixels);
  MeasuredFrames w(file.toLatin1());
  QVERIFY(w.shows());
  w.draw(ShapeKind(kind), pixels);
  QCOMPARE(w.all().size(), std::size_t(1));
  const double screenPixel = w.view()->plane()->mmPerPixel / frameIn(w.view())->geometry().spacing().y;
  QVERIFY(glm::length(glm::dvec2(w.all()[0].shape.points[0]) - pixels[0]) <= screenPixel);
  w.session().change(QStringLiteral("test"), [&](Workspace& now) { w.exact(now, pixels); });
  // The numbers are measured again on another thread.
  QStringList names, fields;
  const auto field = [&](const char* name) { return fields.value(names.indexOf(QLatin1String(name))); };
  const auto isMeasured = [&] {
    w.child<QAction>("copyMeasurementsCsv")->trigger();
    const QStringList lines = QGuiApplication::clipboard()->text().split(QStringLiteral("\r\n"));
    names = lines.value(0).split(u','), fields = lines.value(1).split(u',');
    return !field("number").isEmpty();
  };
  QTRY_VERIFY_WITH_TIMEOUT(isMeasured(), longest);
  QTEST(field("unit"), "unit");
  QFETCH(double, number);
  QVERIFY2(std::abs(field("number").toDouble() - number) < 1e-5 * number, qPrintable(field("number")));
}

void TestFrameMeasurements::everyToolDraws_data() {
  QTest::addColumn<int>("kind");
  for (const ShapeKind kind : drawnKinds) QTest::newRow(ruleOf(kind).name) << int(kind);
}

// Each tool makes one undo step and a number, then the previous tool is back.
void TestFrameMeasurements::everyToolDraws() {
  NEED_PICTURES();
  QFETCH(int, kind);
  MeasuredFrames w("mg-ermf-overlay-shutter.dcm");
  QVERIFY(w.shows());
  std::vector<glm::dvec2> pixels{{300, 500}, {400, 600}};
  if (ruleOf(ShapeKind(kind)).fewest > 2) pixels.emplace_back(300, 600);
  if (ruleOf(ShapeKind(kind)).fewest > 3) pixels.emplace_back(420, 640);
  if (ShapeKind(kind) == probe) pixels.pop_back();
  const int steps = w.session().undoStack().index();
  w.draw(ShapeKind(kind), pixels);
  QCOMPARE(w.all().size(), std::size_t(1));
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  if (ShapeKind(kind) == arrow) {
    auto* field = w.child<QLineEdit>("measurementName");
    QVERIFY(field && field->isVisible());
    QTest::keyClicks(field, QStringLiteral("here"));
    QTest::keyClick(field, Qt::Key_Return);
    QCOMPARE(w.text(), QStringLiteral("here"));
  } else {
    QVERIFY(!w.text().isEmpty());
  }
  QCOMPARE(&w.window.views()->tool(), &toolNamed("window"));
}

void TestFrameMeasurements::anEndFollowsThePointer_data() {
  QTest::addColumn<QString>("file");
  QTest::newRow("square pixels") << QStringLiteral("cr-chest-mono1-jpeg8.dcm");
  QTest::newRow("colour, drawn 0.8 times as high") << QStringLiteral("us-cine-aspect-regions.dcm");
}

// The end moves as far in the frame as the pointer does on screen, each direction by its pixel size.
void TestFrameMeasurements::anEndFollowsThePointer() {
  NEED_PICTURES();
  QFETCH(QString, file);
  MeasuredFrames w(file.toLatin1().constData());
  QVERIFY(w.shows());
  w.draw(length, {{100, 200}, {200, 200}});
  const std::vector<glm::dvec3> before = w.all()[0].shape.points;
  const QPoint end = w.at(before[1]).toPoint(), way(30, 45);
  drag(w.view(), end, end + way);
  const VoxelGeometry& g = frameIn(w.view())->geometry();
  const double mm = w.view()->plane()->mmPerPixel * w.view()->devicePixelRatioF();
  const glm::dvec2 moved(way.x() * mm / g.spacing().x, way.y() * mm / g.spacing().y);
  const std::vector<glm::dvec3> after = w.all()[0].shape.points;
  QVERIFY(after[0] == before[0]);
  const glm::dvec3 off = after[1] - before[1] - glm::dvec3(moved, 0);
  QVERIFY2(glm::length(off) < 1e-9, qPrintable(QStringLiteral("%1, %2 px").arg(off.x).arg(off.y)));
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.all()[0].shape.points == before);
}

void TestFrameMeasurements::onlyOnItsFrame() {
  NEED_PICTURES();
  MeasuredFrames w("us-cine-aspect-regions.dcm");
  QVERIFY(w.shows());
  QTest::keyClick(w.view(), Qt::Key_Down);
  QVERIFY(w.shows(1));
  w.draw(length, {{100, 200}, {200, 200}});
  QCOMPARE(w.all()[0].shape.frame->number, 1);
  QCOMPARE(w.view()->drawnMeasurements().size(), std::size_t(1));
  QTest::keyClick(w.view(), Qt::Key_Down);
  QVERIFY(w.shows(2));
  QVERIFY(w.view()->drawnMeasurements().empty());
  QTest::keyClick(w.view(), Qt::Key_Up);
  QVERIFY(w.shows(1));
  QCOMPARE(w.view()->drawnMeasurements().size(), std::size_t(1));
}

void TestFrameMeasurements::thePanelGoesThere() {
  NEED_PICTURES();
  MeasuredFrames w("us-cine-aspect-regions.dcm");
  QVERIFY(w.shows());
  QTest::keyClick(w.view(), Qt::Key_Down);
  QVERIFY(w.shows(1));
  w.draw(length, {{100, 200}, {200, 200}});
  QTest::keyClick(w.view(), Qt::Key_End);
  QVERIFY(w.shows(33));
  auto* list = w.child<QTreeWidget>("measurementList");
  auto* dock = w.child<QDockWidget>("measurementsDock");
  dock->show();
  dock->raise();
  QCoreApplication::processEvents();
  QVERIFY(list->topLevelItem(0)->text(2).endsWith(QStringLiteral("frame 2")));
  const QPoint row = list->visualItemRect(list->topLevelItem(0)).center();
  QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, row);
  QTest::mouseDClick(list->viewport(), Qt::LeftButton, {}, row);
  QVERIFY(w.shows(1));
  QCOMPARE(w.view()->drawnMeasurements().size(), std::size_t(1));
  w.child<QAction>("copyMeasurementsCsv")->trigger();
  const QStringList lines = QGuiApplication::clipboard()->text().split(QStringLiteral("\r\n"));
  static const QRegularExpression quoted(QStringLiteral("\"[^\"]*\""));  // may contain commas
  const QStringList names = lines[0].split(u','), fields = QString(lines[1]).replace(quoted, {}).split(u',');
  const auto field = [&](const char* name) { return fields.value(names.indexOf(QLatin1String(name))); };
  QCOMPARE(field("frame_number"), QStringLiteral("1"));
  QVERIFY(field("points_mm").isEmpty() && field("points_px").contains(QStringLiteral("; ")));
}

// `volumen measure` reads what the panel saves and what a session keeps.
void TestFrameMeasurements::asSessionAndJson() {
  NEED_PICTURES();
  MeasuredFrames w("us-cine-aspect-regions.dcm");
  QVERIFY(w.shows());
  w.draw(ellipse, {{100, 200}, {200, 300}});
  const Workspace& now = w.session().workspace();
  const auto text = sessionToJson(now, {}, {});
  QVERIFY(text.ok());
  const auto series = now.series.begin()->second.series;
  const auto again = sessionFromJson(*text, [&](const SavedSeries&) { return series; });
  QVERIFY2(again.ok(), again.ok() ? "" : again.message().c_str());
  QVERIFY(again->workspace.measurements == now.measurements);
  const QTemporaryDir folder;
  w.child<QAction>("saveShapes")->trigger();
  answer(w, "measurementSaveDialog", folder.filePath(QStringLiteral("shapes.json")));
  QTRY_VERIFY(QFile::exists(folder.filePath(QStringLiteral("shapes.json"))));
  const Measurement drawn = w.all()[0];
  w.child<QToolButton>("measurementDeleteAll")->click();
  w.child<QToolButton>("measurementOpen")->click();
  answer(w, "measurementOpenDialog", folder.filePath(QStringLiteral("shapes.json")));
  QTRY_COMPARE(w.all().size(), std::size_t(1));
  QVERIFY(w.all()[0].shape == drawn.shape);
}

void TestFrameMeasurements::aSessionMeasuresFramesThatAreNotOnScreen() {
  NEED_PICTURES();
  MeasuredFrames w("us-cine-aspect-regions.dcm");
  QVERIFY(w.shows());
  w.draw(length, {{100, 200}, {200, 200}});
  // Two frames were never shown; one does not exist.
  w.session().change(QStringLiteral("test"), [&](Workspace& now) {
    for (const int frame : {30, 20, 99}) {
      Measurement m = now.measurements[0];
      m.id = frame;
      m.shape.frame->number = frame;
      now.measurements.push_back(m);
    }
  });
  auto* list = w.child<QTreeWidget>("measurementList");
  QTRY_VERIFY_WITH_TIMEOUT(list->topLevelItem(1)->text(1) == list->topLevelItem(0)->text(1) &&
                               list->topLevelItem(2)->text(1) == list->topLevelItem(0)->text(1),
                           longest);
  QCOMPARE(list->topLevelItem(3)->text(1), QStringLiteral("The series does not hold its picture."));
}

VOLUMEN_TEST(TestFrameMeasurements);
#include "tst_frame_measurements.moc"
