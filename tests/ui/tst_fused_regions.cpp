// Guards regions over fused slices. Numbers of both series have their units, beside the shape, in the panel
// and as CSV. SUV series have an SUVpeak. Real mouse events.
#include <QClipboard>
#include <QElapsedTimer>
#include <QGuiApplication>
#include <QSignalSpy>
#include <QTreeWidget>
#include <cmath>

#include "results/text/measured_text.h"
#include "results/text/text.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/ui/kept_pictures.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/exports/flat_pictures.h"
#include "viewer/measure/scaled.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr double suvOfFile = 0.5;

// Returns a PET on another grid over the CT of ballIn(), with values rising along its rows.
LoadedSeriesPtr risingPet(const char* frame) {
  auto series = std::make_shared<LoadedSeries>(*ballIn(frame, 1, "PT"));
  series->volume = volumeOf<float>({14, 14, 14}, glm::dmat3(3), [](glm::dvec3 x) { return 10 + x.x; });
  series->series.acquired = series->volume->geometry();
  series->series.description = "WB";
  series->series.unit = "Bq/ml";
  series->series.suv.bodyWeight = suvOfFile;
  return series;
}

struct FusedWindow : MeasureWindow {
  const LoadedSeriesPtr pet;

  explicit FusedWindow(LoadedSeriesPtr over = risingPet("1.2.3"))
      : MeasureWindow(ballIn("1.2.3")), pet(std::move(over)) {
    session().keep(pet);
    fuse(&pet->series);
  }
  void fuse(const Series* over) {
    session().change(QStringLiteral("Overlay"), withOverlay(session().workspace(), axialViewId, over));
  }
  // Returns points that lie in both volumes.
  std::vector<QPointF> placesInBoth(ShapeKind kind) { return placesWithin(placesOf(kind), {0, 0, 0}, 6); }
  Result<Measured> both(const Measurement& m) {
    Result<Measured> numbers = measured(m);
    if (!ruleOf(m.shape.kind).region) return numbers;
    numbers->source = seriesText(session().seriesNamed(m.series)->series).toStdString();
    addOther(*numbers, m.shape, *pet->volume, {}, "SUVbw");
    numbers->other->source = seriesText(pet->series).toStdString();
    scaleOther(*numbers, suvOfFile);
    return numbers;
  }
  QString csv() {
    child<QAction>("copyMeasurementsCsv")->trigger();
    return QGuiApplication::clipboard()->text();
  }
  QString listed() {
    const QTreeWidgetItem* item = child<QTreeWidget>("measurementList")->topLevelItem(0);
    return item ? item->text(1) : QString();
  }
};

}  // namespace

class TestFusedRegions : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyRegionIsOfBoth_data();
  void everyRegionIsOfBoth();
  void csvNamesBoth();
  void hiddenNamesAreHiddenInNumbersThatAreThere();
  void withoutTheOverlayItIsOfOne();
  void otherShapesAreOfOne();
  void picturesWaitForNumbersThatTakeLong();
};

void TestFusedRegions::everyRegionIsOfBoth_data() {
  QTest::addColumn<int>("kind");
  for (const ShapeKind kind : drawnKinds)
    if (ruleOf(kind).region) QTest::newRow(ruleOf(kind).name) << int(kind);
}

void TestFusedRegions::everyRegionIsOfBoth() {
  QFETCH(int, kind);
  FusedWindow w;
  w.draw(ShapeKind(kind), w.placesInBoth(ShapeKind(kind)));
  QCOMPARE(w.all().size(), std::size_t(1));
  const Result<Measured> wanted = w.both(w.last());
  QVERIFY(wanted->values && wanted->other->values && wanted->other->peak);
  QVERIFY2(wanted->other->values->n < wanted->values->n, "each is counted on its own grid");
  QTRY_COMPARE_WITH_TIMEOUT(w.drawn(w.last().id).text, measuredLines(w.last().shape, wanted), longest);
  const QStringList text = w.drawn(w.last().id).text;
  QCOMPARE(text.size(), 5);
  QVERIFY2(text[1].startsWith(QStringLiteral("CT Ball: ")) && text[1].endsWith(QStringLiteral(" HU")),
           qPrintable(text[1]));
  QVERIFY2(text[3].startsWith(QStringLiteral("PT WB: ")) && text[3].endsWith(QStringLiteral(" SUVbw")),
           qPrintable(text[3]));
  QVERIFY2(text[4].startsWith(QStringLiteral("SUVmax ")) && text[4].contains(QStringLiteral("SUVpeak ")),
           qPrintable(text[4]));
  QTRY_COMPARE_WITH_TIMEOUT(w.listed(), measuredText(w.last().shape, wanted), longest);
}

void TestFusedRegions::csvNamesBoth() {
  FusedWindow w;
  w.draw(ShapeKind::rectangle, w.placesInBoth(ShapeKind::rectangle));
  const Result<Measured> wanted = w.both(w.last());
  QVERIFY(wanted->values && wanted->other->values && wanted->other->peak);
  QTRY_COMPARE_WITH_TIMEOUT(w.drawn(w.last().id).text, measuredLines(w.last().shape, wanted), longest);
  w.child<QAction>("copyMeasurementsCsv")->trigger();
  const QStringList lines = QGuiApplication::clipboard()->text().split(QStringLiteral("\r\n"));
  const QStringList names = lines[0].split(u','), fields = lines.value(1).split(u',');
  const auto field = [&](const char* name) { return fields.value(names.indexOf(QLatin1String(name))); };
  QCOMPARE(field("mean").toDouble(), wanted->values->mean);
  QCOMPARE(field("value_unit"), QStringLiteral("HU"));
  QCOMPARE(field("other_series"), QStringLiteral("PT WB"));
  QCOMPARE(field("other_mean").toDouble(), wanted->other->values->mean);
  QCOMPARE(field("other_unit"), QStringLiteral("SUVbw"));
  QCOMPARE(field("other_suv_peak").toDouble(), wanted->other->peak->mean);
}

void TestFusedRegions::hiddenNamesAreHiddenInNumbersThatAreThere() {
  auto file = std::make_shared<LoadedSeries>(*risingPet("1.2.3"));
  file->series.format = "NIfTI";
  file->series.path = "/data/Doe_PET.nii";
  file->series.description.clear();
  FusedWindow w(file);
  w.draw(ShapeKind::rectangle, w.placesInBoth(ShapeKind::rectangle));
  const auto said = [&] { return w.drawn(w.last().id).text.join(u'\n') + w.listed() + w.csv(); };
  const QString name = QStringLiteral("Doe_PET.nii");
  QTRY_COMPARE_WITH_TIMEOUT(said().count(name), 3, longest);
  const QString before = said();
  w.child<QAction>("hideNames")->trigger();
  QVERIFY2(!said().contains(QStringLiteral("Doe")), qPrintable(said()));
  QCOMPARE(said().count(QStringLiteral("(file name hidden)")), 3);
  w.child<QAction>("hideNames")->trigger();
  QCOMPARE(said(), before);
}

void TestFusedRegions::withoutTheOverlayItIsOfOne() {
  FusedWindow w;
  w.draw(ShapeKind::ellipse, w.placesInBoth(ShapeKind::ellipse));
  const Measurement drawn = w.last();
  const QStringList both = measuredLines(drawn.shape, w.both(drawn));
  const QStringList one = measuredLines(drawn.shape, w.measured(drawn));
  QTRY_COMPARE_WITH_TIMEOUT(w.drawn(drawn.id).text, both, longest);
  w.fuse(nullptr);
  QTRY_COMPARE_WITH_TIMEOUT(w.drawn(drawn.id).text, one, longest);
  w.undo();
  QTRY_COMPARE_WITH_TIMEOUT(w.drawn(drawn.id).text, both, longest);
}

void TestFusedRegions::otherShapesAreOfOne() {
  FusedWindow w;
  w.draw(ShapeKind::length, placesOf(ShapeKind::length));
  QCOMPARE(w.drawn(w.last().id).text, measuredLines(w.last().shape, w.measured(w.last())));
}

// Computes the SUVpeak of enough fine voxels to take some seconds on any machine.
void TestFusedRegions::picturesWaitForNumbersThatTakeLong() {
  constexpr int n = 300;
  constexpr double mm = 0.25, wantedMs = 5000;
  auto fine = std::make_shared<LoadedSeries>(*risingPet("1.2.3"));
  fine->volume = volumeOf<float>({n, n, 3}, glm::dmat3(mm), [](glm::dvec3 x) { return 10 + x.x; });
  fine->series.acquired = fine->volume->geometry();
  MeasureWindow w(fine);
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const SlicePlane plane = *w.view()->plane();
  const auto square = [&](double side) {
    Shape shape;
    shape.kind = ShapeKind::rectangle;
    shape.plane = ShapePlane{plane.centre, plane.right, plane.down};
    for (const double half : {-side * mm / 2, side * mm / 2})
      shape.points.push_back(plane.centre + half * (plane.right + plane.down));
    return shape;
  };
  const auto msOf = [&](double side) {
    QElapsedTimer timer;
    timer.start();
    return measure(square(side), *fine->volume, "SUVbw") ? double(timer.nsecsElapsed()) / 1e6 : 0.0;
  };
  const double small = msOf(20), larger = msOf(40);
  QVERIFY(small > 0 && larger > small);
  const double side = std::min(n - 4.0, std::sqrt(wantedMs * (40 * 40 - 20 * 20) / (larger - small)));
  addMeasurement(w.session(), keyOf(fine->series), square(side));
  w.session().select(0);
  PictureLook look;
  look.seen = w.view()->size();
  const auto kept = std::make_shared<std::vector<MadePicture>>();
  Exports exports(w.window.jobs());
  QSignalSpy done(&exports, &Exports::done);
  exports.run(
      {QStringLiteral("Saving"),
       flatPictures(*w.window.views(), {heldNow({w.session().workspace(), axialViewId}, w.session())}, look),
       keptIn(kept)});
  QTRY_COMPARE_WITH_TIMEOUT(done.count(), 1, longest);
  QTRY_VERIFY_WITH_TIMEOUT(w.view()->isMeasured(), longest);
  QVERIFY(w.drawn(w.last().id).text.join(u'\n').contains(QStringLiteral("SUVpeak")));
  QCOMPARE(kept->at(0).image, w.view()->capture());
}

VOLUMEN_TEST(TestFusedRegions);
#include "tst_fused_regions.moc"
