// Guards window.md "Save and print pictures": the report of key images and measurements. Its tables hold the
// numbers that the panels show, of the moment of the request, study after study, as text in the PDF.
#include <QCheckBox>
#include <QComboBox>
#include <QPainter>
#include <QProcess>
#include <QPushButton>
#include <QStandardPaths>
#include <QTemporaryDir>

#include "results/text/measured_text.h"
#include "results/text/text.h"
#include "tests/ui/leaving.h"
#include "tests/ui/numbers_table.h"
#include "tests/ui/pdf_images.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/exports/flat_pictures.h"
#include "ui/exports/report_maker.h"
#include "ui/overlays/picture_pages.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns the hollow balls as a series of this patient, whose slices can be key images.
LoadedSeriesPtr reportedBalls(const char* patient = "Doe^Jane") {
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  series->series.patientName = patient;
  series->series.studyDate = "20260314";
  for (int n = 0; n < 40; ++n) {
    series->series.sopInstanceUids.push_back(series->series.id + "." + std::to_string(n));
    series->series.frames.push_back(0);
  }
  return series;
}

Shape namedLength(const QString& name, double mm) {
  Shape shape;
  shape.points = {{0, 0, 0.5}, {mm, 0, 0.5}};
  shape.name = name.toStdString();
  return shape;
}

struct ReportWindow : SegmentWindow {
  QTemporaryDir folder;

  explicit ReportWindow(const LoadedSeriesPtr& series = reportedBalls()) : SegmentWindow(series) {}

  bool isDrawn() {
    return QTest::qWaitFor([&] { return view() && !view()->picture().isNull() && view()->isMeasured(); },
                           longest);
  }
  void markPicture() {
    view()->setFocus();
    QTest::keyClick(&window, Qt::Key_K);
  }
  PagesDialog* askForReport() {
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    run(*this, "keyImagePages");
    for (auto* dialog : window.findChildren<PagesDialog*>())
      if (dialog->isVisible()) return dialog;
    return nullptr;
  }
  QCheckBox* box(PagesDialog* dialog, const char* name) {
    return dialog->findChild<QCheckBox*>(QLatin1String(name));
  }
  void toggle(QCheckBox* field) { QTest::mouseClick(field, Qt::LeftButton, {}, {8, field->height() / 2}); }

  // Leaves the dialog by a button, answers where to, and returns the file's path once it is written.
  QString made(PagesDialog* dialog, bool onPaper = false) {
    const QString path = folder.filePath(QStringLiteral("report-%1.pdf").arg(made_++));
    QTest::mouseClick(dialog->findChild<QPushButton*>(QLatin1String(onPaper ? "pagesPrint" : "pagesPdf")),
                      Qt::LeftButton);
    answerWhere(
        *this,
        wayOut(onPaper ? QStringLiteral("key images to paper") : QStringLiteral("key images to a PDF")),
        path);
    const auto isThere = [&] { return QFileInfo(path).size() > 0 && window.jobs().rows().empty(); };
    return QTest::qWaitFor(isThere, longest) ? path : QString();
  }

 private:
  int made_ = 0;
};

// Returns the texts of a PDF in the order in which they were painted: cell after cell.
QString paintedText(const QString& path) { return textsIn(path).join(QLatin1Char(' ')).simplified(); }

// Returns the text of each page as a reader copies it.
QStringList copiedPages(const QString& path) {
  QProcess reader;
  reader.start(QStringLiteral("pdftotext"), {QStringLiteral("-layout"), QStringLiteral("-enc"),
                                             QStringLiteral("UTF-8"), path, QStringLiteral("-")});
  if (!reader.waitForFinished(longest)) return {};
  return QString::fromUtf8(reader.readAllStandardOutput()).split(QLatin1Char('\f'), Qt::SkipEmptyParts);
}

bool canCopyPages() { return !QStandardPaths::findExecutable(QStringLiteral("pdftotext")).isEmpty(); }

QString withoutGaps(QString text) { return text.remove(QLatin1Char(' ')).remove(QLatin1Char(',')); }

// Returns the cells of the row of a segment in the table of the window, under the heads of the report.
QStringList panelRow(Journey& w, int row) {
  const auto* table = w.child<QTableWidget>("segmentNumbers");
  QStringList cells;
  for (const char* head :
       {"Name", "Voxels", "Volume (ml)", "Mean (HU)", "SD (HU)", "Minimum (HU)", "Maximum (HU)"})
    for (int column = 0; column < table->columnCount(); ++column)
      if (table->horizontalHeaderItem(column)->text() == QLatin1String(head))
        cells << table->item(row, column)->text();
  return cells;
}

}  // namespace

class TestReport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void tablesHoldTheNumbersOfThePanels_data();
  void tablesHoldTheNumbersOfThePanels();
  void textsOfTablesCanBeCopied();
  void onlyWhatIsTickedIsThere_data();
  void onlyWhatIsTickedIsThere();
  void whatIsNotThereCannotBeTicked();
  void namesAreHiddenInTables();
  void studiesAreApart();
  void manyRowsRunOverPages();
  void rowsFitTheirPages_data();
  void rowsFitTheirPages();
  void numbersAreOfTheRequest();
  void whatIsGivenUpNeverAnswers();
  void segmentsThatCannotBeMeasuredSayWhy();
  void withoutAnythingThereIsASentence();
};

void TestReport::tablesHoldTheNumbersOfThePanels_data() {
  QTest::addColumn<bool>("onPaper");
  QTest::addColumn<bool>("withKeyImage");
  QTest::newRow("PDF") << false << true;
  QTest::newRow("paper") << true << true;
  QTest::newRow("tables alone") << false << false;
}

// A length has its uncertainty besides.
void TestReport::tablesHoldTheNumbersOfThePanels() {
  QFETCH(bool, onPaper);
  QFETCH(bool, withKeyImage);
  ReportWindow w;
  QVERIFY(w.isDrawn() && w.makeBoth());
  if (withKeyImage) w.markPicture();
  w.draw(ShapeKind::length, w.placesWithin(placesOf(ShapeKind::length), inShell, 5));
  w.draw(ShapeKind::bidirectional, w.placesWithin(placesOf(ShapeKind::bidirectional), inShell, 6));
  w.draw(ShapeKind::ellipse, w.placesWithin(placesOf(ShapeKind::ellipse), inShell, 5));
  QVERIFY(w.isDrawn() && openTable(w));
  QCOMPARE(w.all().size(), std::size_t(3));
  PagesDialog* dialog = w.askForReport();
  QVERIFY(dialog);
  QCOMPARE(w.box(dialog, "pagesMeasurements")->text(), QStringLiteral("Measurements (3)"));
  QCOMPARE(w.box(dialog, "pagesSegments")->text(), QStringLiteral("Segments (2)"));
  const QString path = w.made(dialog, onPaper);
  QCOMPARE(imagesIn(path).size(), std::size_t(withKeyImage));
  const QString text = paintedText(path);
  const auto* list = w.child<QTreeWidget>("measurementList");
  for (int row = 0; row < 3; ++row) {
    const QTreeWidgetItem* item = list->topLevelItem(row);
    const bool isLength = row == 0;
    const QString number = item->text(1);  // "23.4 mm" for the length
    const QString cells =
        item->text(0) + QLatin1Char(' ') +
        (isLength ? number.section(QLatin1Char(' '), 0, 0) + QStringLiteral(" \u00b1 ") : number);
    QVERIFY2(withoutGaps(text).contains(withoutGaps(cells)), qPrintable(cells + QLatin1Char('\n') + text));
    const QString place = item->text(2) + QLatin1Char(' ') + item->text(3) + QStringLiteral(" 2026-03-14");
    QCOMPARE(text.count(place) > 0, true);
  }
  QVERIFY2(text.contains(QStringLiteral("long axis \u00b1 ")), qPrintable(text));
  for (int row = 0; row < 2; ++row) {
    const QStringList cells = panelRow(w, row);
    QCOMPARE(cells.size(), 7);
    QVERIFY2(text.contains(cells.join(QLatin1Char(' '))), qPrintable(cells.join(QLatin1Char(' '))));
  }
  QVERIFY(text.contains(QStringLiteral("Segments of CT Ball 2026-03-14 Name Voxels Volume (ml) Mean (HU)")));
}

void TestReport::textsOfTablesCanBeCopied() {
  if (!canCopyPages()) QSKIP("pdftotext is not installed (package poppler-utils)");
  ReportWindow w;
  QVERIFY(w.isDrawn() && w.makeBoth());
  w.markPicture();
  addMeasurement(w.session(), w.series(), namedLength(QStringLiteral("Stenosis"), 7));
  QVERIFY(openTable(w));
  const QStringList pages = copiedPages(w.made(w.askForReport()));
  QCOMPARE(pages.size(), 2);
  for (const QString& page : pages) {
    QVERIFY2(page.contains(QStringLiteral("Doe, Jane (42)")), qPrintable(page));
    QVERIFY2(page.trimmed().contains(QRegularExpression(
                 QStringLiteral("Not for clinical use +volumen [0-9.]+, [0-9]{4}-[0-9]{2}-[0-9]{2}$"))),
             qPrintable(page));
  }
  QVERIFY(pages[1].contains(QRegularExpression(QStringLiteral("Stenosis +7 \u00b1 [0-9.]+ mm"))));
  for (int row = 0; row < 2; ++row)
    QVERIFY2(pages[1].simplified().contains(panelRow(w, row).join(QLatin1Char(' '))), qPrintable(pages[1]));
}

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

// Arrows have no number.
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

void TestReport::namesAreHiddenInTables() {
  ReportWindow w;
  QVERIFY(w.isDrawn() && w.makeBoth());
  addMeasurement(w.session(), w.series(), namedLength(QStringLiteral("Stenosis"), 7));
  const QString shown = paintedText(w.made(w.askForReport()));
  PagesDialog* dialog = w.askForReport();
  w.toggle(w.box(dialog, "pagesHideNames"));
  const QString hidden = paintedText(w.made(dialog));
  QVERIFY(!namesHidden());
  for (const char* secret : {"Doe", "Jane", "(42)", "2026-03-14"}) {
    QVERIFY2(shown.contains(QLatin1String(secret)), secret);
    QVERIFY2(!hidden.contains(QLatin1String(secret)), secret);
  }
  QVERIFY(hidden.contains(QStringLiteral("Stenosis 7 \u00b1 ")));
  QVERIFY(hidden.contains(QStringLiteral("Not for clinical use")));
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

void TestReport::manyRowsRunOverPages() {
  constexpr int count = 200;
  ReportWindow w;
  QVERIFY(w.isDrawn());
  std::vector<Shape> shapes;
  for (int n = 0; n < count; ++n)
    shapes.push_back(namedLength(QStringLiteral("m%1").arg(n + 1, 3, 10, QLatin1Char('0')), 1 + n * 0.05));
  addMeasurements(w.session(), w.series(), shapes);
  const QStringList texts = textsIn(w.made(w.askForReport()));
  const qsizetype pages = texts.filter(QRegularExpression(QStringLiteral("^Page \\d+ of \\d+$"))).size();
  QVERIFY2(pages > 2 && pages < 15, qPrintable(QString::number(pages)));
  for (const char* head : {"Measurements", "Name", "Number", "Series", "Study date", "Not for clinical use"})
    QCOMPARE(texts.count(QLatin1String(head)), pages);
  QStringList names = texts.filter(QRegularExpression(QStringLiteral("^m\\d{3}$"))), wanted;
  for (const Shape& shape : shapes) wanted << QString::fromStdString(shape.name);
  QCOMPARE(names, wanted);
}

void TestReport::rowsFitTheirPages_data() {
  QTest::addColumn<QSizeF>("roomMm");
  QTest::newRow("A4") << QSizeF(186, 250);
  QTest::newRow("A4 across") << QSizeF(273, 160);
  QTest::newRow("a label") << QSizeF(100, 120);
}

// Tables of rows of one to many lines, the longest word wider than its column and one text longer than a
// page. Nothing is painted below the room, and every other row is whole.
void TestReport::rowsFitTheirPages() {
  QFETCH(QSizeF, roomMm);
  QImage paper((roomMm * 4).toSize(), QImage::Format_RGB32);
  paper.setDotsPerMeterX(4000);
  paper.setDotsPerMeterY(4000);
  std::vector<PageTable> tables;
  for (int n = 0; n < 3; ++n) {
    PageTable table{
        QStringLiteral("Table %1").arg(n), {}, {{QStringLiteral("A"), 1}, {QStringLiteral("B"), 3}}, {}};
    for (int row = 0; row < 30; ++row)
      table.rows.push_back(
          {QString(row == 7 ? 5000 : row, QLatin1Char('x')), QStringLiteral("b\n").repeated(row % 5)});
    tables.push_back(table);
  }
  std::vector<QStringList> rows;
  const auto pages = dividedTables(tables, roomMm, paper);
  QVERIFY(pages.size() > 2);
  for (const std::vector<PageTable>& page : pages) {
    QImage room(paper.width(), paper.height() * 2, QImage::Format_RGB32);
    room.setDotsPerMeterX(4000);
    room.setDotsPerMeterY(4000);
    room.fill(Qt::white);
    {
      QPainter painter(&room);
      paintTables(painter, page, 0, roomMm);
    }
    QImage below = room.copy(0, paper.height() + 1, paper.width(), paper.height() - 1), white = below;
    white.fill(Qt::white);
    QCOMPARE(below, white);
    for (const PageTable& table : page) {
      QVERIFY(!table.rows.empty() && table.columns.size() == 2 && !table.title.isEmpty());
      rows.insert(rows.end(), table.rows.begin(), table.rows.end());
    }
  }
  std::vector<QStringList> wanted;
  for (const PageTable& table : tables) wanted.insert(wanted.end(), table.rows.begin(), table.rows.end());
  QVERIFY(rows == wanted);
}

// A volume takes longer than the request. What is deleted or changed meanwhile is as it was then.
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

// The other series is in memory no more.
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
