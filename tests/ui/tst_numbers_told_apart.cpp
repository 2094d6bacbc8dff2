// Guards exported numbers: each states its patient, study, series, slice, time point and how it was measured.
// Real events.
#include <QClipboard>
#include <QGuiApplication>
#include <QTreeWidget>

#include "tests/ui/segment_window.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestNumbersToldApart : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void measurementsSayWhose();
  void segmentsSayWhose();
  void valuesOfAnotherSeriesNameIt();
};

namespace {

// Returns a ball. Two patients' balls differ in nothing else that is measured.
LoadedSeriesPtr ballOf(const char* patient, const char* date, const char* number) {
  auto series = std::make_shared<LoadedSeries>(*ballSeries(32, 10, {3, -2, 4}));
  series->series.patientName = patient;
  series->series.studyDate = date;
  series->series.seriesNumber = number;
  series->series.seriesUid = std::string("1.2.") + number;
  return series;
}

QString csvOf(const QStringList& lines, int row, const char* column) {
  const QStringList names = lines[0].split(QLatin1Char(','));
  return lines.value(row).split(QLatin1Char(',')).value(names.indexOf(QLatin1String(column)));
}

}  // namespace

void TestNumbersToldApart::measurementsSayWhose() {
  MeasureWindow w(ballOf("Doe", "20260314", "3"));
  w.session().change(QStringLiteral("test"), [&](Workspace& after) {
    after.crosshairs.editOrAdd(frameOfReference(w.session().series()->series)).at = {0.5, 0.5, -0.5};
  });
  w.draw(ShapeKind::ellipse, w.placesWithin(placesOf(ShapeKind::ellipse), {3, -2, -0.5}, 4));
  w.draw(ShapeKind::length, w.placesWithin(placesOf(ShapeKind::length), {0.5, -2, 4}, 4, coronalViewId),
         coronalViewId);
  w.child<QAction>("copyMeasurementsCsv")->trigger();
  const QStringList lines = QGuiApplication::clipboard()->text().split(QStringLiteral("\r\n"));
  for (const int row : {1, 2}) {
    QCOMPARE(csvOf(lines, row, "patient_id"), QStringLiteral("42"));
    QCOMPARE(csvOf(lines, row, "study_date"), QStringLiteral("2026-03-14"));
    QCOMPARE(csvOf(lines, row, "series_number"), QStringLiteral("3"));
    QCOMPARE(csvOf(lines, row, "series_uid"), QStringLiteral("1.2.3"));
  }
  QCOMPARE(csvOf(lines, 1, "patient"), QStringLiteral("Doe"));
  QVERIFY2(lines[1].endsWith(QStringLiteral(",16,drawn in slices")), qPrintable(lines[1]));
  QVERIFY2(lines[2].endsWith(QStringLiteral(",,drawn in slices")), "it goes across slices");
  auto* list = w.child<QTreeWidget>("measurementList");
  const auto text = [&](int row, const char* head) {
    for (int n = 0; n < list->columnCount(); ++n)
      if (list->headerItem()->text(n) == QLatin1String(head)) return list->topLevelItem(row)->text(n);
    return QString();
  };
  QCOMPARE(text(0, "Place"), QStringLiteral("slice 16 of 32"));
  QVERIFY2(text(1, "Place").endsWith(QStringLiteral(" mm")), qPrintable(text(1, "Place")));
  QCOMPARE(text(0, "Study date"), QStringLiteral("2026-03-14"));
  QCOMPARE(text(0, "Patient"), QStringLiteral("Doe (42)"));
  w.child<QAction>("copyMeasurementsText")->trigger();
  QVERIFY(QGuiApplication::clipboard()->text().contains(
      QStringLiteral("(CT Ball (3)), slice 16 of 32, Doe (42), 2026-03-14")));
  w.session().prefer([](Preferences& p) { p.hideNames = true; });
  w.child<QAction>("copyMeasurementsCsv")->trigger();
  QVERIFY(!QGuiApplication::clipboard()->text().contains(QStringLiteral("Doe")));
  w.session().prefer([](Preferences& p) { p.hideNames = false; });
}

void TestNumbersToldApart::segmentsSayWhose() {
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  series->series.studyDate = "20260314";
  series->series.seriesNumber = "3";
  SegmentWindow w(series);
  QVERIFY(w.make(800, 1200));
  w.click("segmentNumbersButton");
  QTRY_VERIFY_WITH_TIMEOUT(w.button("segmentNumbersCopy") && w.button("segmentNumbersCopy")->isEnabled(),
                           longest);
  w.click("segmentNumbersCopy");
  const QString copied = QGuiApplication::clipboard()->text();
  QVERIFY2(copied.contains(QStringLiteral("Test, Ball\t42\t2026-03-14\tCT Ball (3)\t3")), qPrintable(copied));
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("a.csv"));
  w.click("segmentNumbersCsv");
  answer(w, "segmentNumbersFileDialog", path);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), longest);
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QString csv = QString::fromUtf8(file.readAll());
  QVERIFY2(csv.contains(QStringLiteral(
               "Patient,Patient ID,Study date,Series,Series number,Series UID,Time point,Made by")) &&
               csv.contains(
                   QStringLiteral("\"Test, Ball\",42,2026-03-14,CT Ball (3),3,,,range high 1200 low 800")),
           qPrintable(csv));
}

// A region belongs to the CT, in the view of a PET with the same frame of reference.
void TestNumbersToldApart::valuesOfAnotherSeriesNameIt() {
  TwoSeries w(ballIn("1.2.3"), petIn("1.2.3"));
  Shape region;
  region.kind = ShapeKind::ellipse;
  region.plane = ShapePlane{};
  region.plane->centre = w.plane(left).centre;
  region.points = {region.plane->centre - glm::dvec3(4, 4, 0), region.plane->centre + glm::dvec3(4, 4, 0)};
  addMeasurement(w.session(), w.workspace().view(left).series, region);
  const auto textIn = [&](ViewId view) {
    const auto drawn = w.view(view)->drawnMeasurements();
    return drawn.empty() ? QString() : drawn.front().text.join(QLatin1Char('\n'));
  };
  QTRY_VERIFY_WITH_TIMEOUT(textIn(right).contains(QStringLiteral("Mean")), longest);
  QVERIFY2(textIn(right).endsWith(QStringLiteral("of CT Ball")), qPrintable(textIn(right)));
  QVERIFY2(!textIn(left).contains(QStringLiteral("of CT Ball")), qPrintable(textIn(left)));
}

VOLUMEN_TEST(TestNumbersToldApart);
#include "tst_numbers_told_apart.moc"
