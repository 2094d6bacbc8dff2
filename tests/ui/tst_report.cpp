// Guards window.md "Save and print pictures": the report of key images and measurements holds what is ticked,
// study after study, with the numbers of the moment of the request.
#include <QComboBox>

#include "results/text/measured_text.h"
#include "tests/ui/report_window.h"
#include "tests/unit/suite.h"
#include "ui/exports/flat_pictures.h"
#include "ui/exports/report_maker.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

class TestReport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void onlyWhatIsTickedIsThere_data();
  void onlyWhatIsTickedIsThere();
  void whatIsNotThereCannotBeTicked();
  void studiesAreApart();
  void numbersAreOfTheRequest();
  void whatIsGivenUpNeverAnswers();
  void segmentsThatCannotBeMeasuredSayWhy();
  void withoutAnythingThereIsASentence();
};

void TestReport::onlyWhatIsTickedIsThere_data() {
  QTest::addColumn<bool>("measurements");
  QTest::addColumn<bool>("segments");
  QTest::newRow("both") << true << true;
  QTest::newRow("measurements") << true << false;
  QTest::newRow("segments") << false << true;
  QTest::newRow("key images alone") << false << false;
}

void TestReport::onlyWhatIsTickedIsThere() {
  QFETCH(bool, measurements);
  QFETCH(bool, segments);
  ReportWindow w;
  QVERIFY(w.isDrawn() && w.makeBoth());
  w.markPicture();
  addMeasurement(w.session(), w.series(), namedLength(QStringLiteral("Stenosis"), 7));
  PagesDialog* dialog = w.askForReport();
  if (!measurements) w.toggle(w.box(dialog, "pagesMeasurements"));
  if (!segments) w.toggle(w.box(dialog, "pagesSegments"));
  const QString path = w.made(dialog), text = paintedText(path);
  QCOMPARE(imagesIn(path).size(), std::size_t(1));
  QCOMPARE(text.contains(QStringLiteral("Stenosis")), measurements);
  QCOMPARE(text.contains(QStringLiteral("Segments of CT Ball")), segments);
  QCOMPARE(text.contains(QStringLiteral("Page 2 of 2")), measurements || segments);
}

// The only measurement is an arrow, which has no number.
void TestReport::whatIsNotThereCannotBeTicked() {
  ReportWindow w;
  QVERIFY(w.isDrawn() && w.makeBoth());
  Shape arrow;
  arrow.kind = ShapeKind::arrow;
  arrow.points = {{0, 0, 0.5}, {5, 0, 0.5}};
  arrow.name = "Here";
  addMeasurement(w.session(), w.series(), arrow);
  PagesDialog* dialog = w.askForReport();
  QVERIFY(!w.box(dialog, "pagesMeasurements")->isEnabled());
  QVERIFY(!w.box(dialog, "pagesMeasurements")->isChecked());
  QVERIFY(!dialog->findChild<QComboBox*>(QStringLiteral("pagesPictures"))->isEnabled());
  const auto* save = dialog->findChild<QPushButton*>(QStringLiteral("pagesPdf"));
  const auto* print = dialog->findChild<QPushButton*>(QStringLiteral("pagesPrint"));
  QVERIFY(save->isEnabled() && print->isEnabled());
  w.toggle(w.box(dialog, "pagesSegments"));
  QVERIFY2(!save->isEnabled() && !print->isEnabled(), "there would be no page");
  w.toggle(w.box(dialog, "pagesSegments"));
  QVERIFY(save->isEnabled());
  QVERIFY(!paintedText(w.made(dialog)).contains(QStringLiteral("Here")));
}

void TestReport::studiesAreApart() {
  const LoadedSeriesPtr first = reportedBalls("Doe^Jane"), second = reportedBalls("Roe^John");
  ReportWindow w(first);
  QVERIFY(w.isDrawn());
  addMeasurement(w.session(), keyOf(first->series), namedLength(QStringLiteral("Stenosis"), 7));
  w.session().show(second);
  w.session().setFocus(axialViewId);
  QVERIFY(w.isDrawn());
  w.markPicture();
  addMeasurement(w.session(), keyOf(second->series), namedLength(QStringLiteral("Nodule"), 9));
  const QString path = w.made(w.askForReport()), text = paintedText(path);
  QCOMPARE(imagesIn(path).size(), std::size_t(1));
  // The study with a key image comes first: its picture, its table, then the table of the other.
  const qsizetype nodule = text.indexOf(QStringLiteral("Nodule")),
                  roe = text.lastIndexOf(QStringLiteral("Roe, John")),
                  doe = text.indexOf(QStringLiteral("Doe, Jane")),
                  stenosis = text.indexOf(QStringLiteral("Stenosis"));
  QCOMPARE(text.count(QStringLiteral("Roe, John")), 2);
  QCOMPARE(text.count(QStringLiteral("Doe, Jane")), 1);
  QVERIFY2(0 <= roe && roe < nodule && nodule < doe && doe < stenosis, qPrintable(text));
  QVERIFY(text.contains(QStringLiteral("Page 3 of 3")));
}

// Measuring a volume takes longer than the request. The report still shows what is deleted or changed
// meanwhile.
void TestReport::numbersAreOfTheRequest() {
  ReportWindow w;
  QVERIFY(w.isDrawn() && w.makeBoth());
  addMeasurement(w.session(), w.series(), namedLength(QStringLiteral("Stenosis"), 7));
  Shape volume;
  volume.kind = ShapeKind::volume;
  volume.range = {900, 2000};
  volume.name = "Bright";
  addMeasurement(w.session(), w.series(), volume);
  QVERIFY2(!w.window.document().measurer.exactNumbersOf(w.last()), "it is not measured yet");
  const Result<Measured> measured = w.measured(w.last());
  QVERIFY(measured && measured->number > 1);
  PagesDialog* dialog = w.askForReport();
  deleteAllMeasurements(w.session());
  w.session().change(QStringLiteral("test"), [](Workspace& all) { all.segmentMaps.clear(); });
  const QString text = paintedText(w.made(dialog));
  QVERIFY2(text.contains(QStringLiteral("Stenosis 7 \u00b1 ")), qPrintable(text));
  QVERIFY2(text.contains(QStringLiteral("Bright ") + measuredLines(volume, measured).join(QLatin1Char(' '))),
           qPrintable(text));
  QVERIFY(text.contains(QStringLiteral("Segments of CT Ball")));
}

void TestReport::whatIsGivenUpNeverAnswers() {
  ReportWindow w;
  QVERIFY(w.isDrawn() && w.makeBoth());
  std::vector<ReportedStudy> studies;
  addNumbers(studies, w.session(), w.window.document().measurer);
  QCOMPARE(segmentCount(studies), 2);
  bool isAnswered = false;
  JobLane lane;
  const PictureMakerPtr pages =
      reportPages(flatPictures(*w.window.views(), {}, {}), studies, w.session(), false);
  QCOMPARE(pages->count(), std::size_t(1));
  pages->make(0, lane, [&](const Result<MadePicture>&) { isAnswered = true; });
  pages->giveUp();
  lane.giveUpAll();
  lane.wait();
  QCoreApplication::processEvents();
  QVERIFY(!isAnswered);
  pages->make(0, lane, [&](const Result<MadePicture>& made) {
    isAnswered = made && made->tables.size() == 1 && made->tables.front().rows.size() == 2;
  });
  QTRY_VERIFY_WITH_TIMEOUT(isAnswered, longest);
}

// The segments belong to a series that is not in memory any more.
void TestReport::segmentsThatCannotBeMeasuredSayWhy() {
  ReportWindow w;
  QVERIFY(w.isDrawn() && w.makeBoth());
  const SeriesKey measured = w.series();
  w.session().show(reportedBalls());
  w.session().pool().forget(measured);
  QVERIFY(!w.session().seriesNamed(measured));
  const QString text = paintedText(w.made(w.askForReport()));
  QVERIFY2(text.contains(
               QStringLiteral("Segments of CT Ball 2026-03-14. The series is not in memory: show it, then "
                              "make the report again.")),
           qPrintable(text));
}

void TestReport::withoutAnythingThereIsASentence() {
  ReportWindow w;
  QVERIFY(!w.askForReport());
  QCOMPARE(w.child<Banner>("banner")->sentence(),
           QStringLiteral("There are no key images, measurements or segments: mark a picture with K, measure "
                          "with D, or make a segment."));
}

VOLUMEN_TEST(TestReport);
#include "tst_report.moc"
