// Guards window.md "Save and print pictures": the tables of a report hold the numbers that the panels show,
// as text in the PDF, over as many pages as the rows need.
#include <QPainter>
#include <QProcess>
#include <QStandardPaths>

#include "results/text/text.h"
#include "tests/ui/numbers_table.h"
#include "tests/ui/report_window.h"
#include "tests/unit/suite.h"
#include "ui/overlays/picture_pages.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns the text of each page as a user of a PDF reader copies it.
QStringList copiedPages(const QString& path) {
  QProcess reader;
  reader.start(QStringLiteral("pdftotext"), {QStringLiteral("-layout"), QStringLiteral("-enc"),
                                             QStringLiteral("UTF-8"), path, QStringLiteral("-")});
  if (!reader.waitForFinished(longest)) return {};
  return QString::fromUtf8(reader.readAllStandardOutput()).split(QLatin1Char('\f'), Qt::SkipEmptyParts);
}

bool canCopyPages() { return !QStandardPaths::findExecutable(QStringLiteral("pdftotext")).isEmpty(); }

QString withoutGaps(QString text) { return text.remove(QLatin1Char(' ')).remove(QLatin1Char(',')); }

// Returns a row of the segment statistics table, in the order of the columns of the report.
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

class TestReportTables : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void tablesHoldTheNumbersOfThePanels_data();
  void tablesHoldTheNumbersOfThePanels();
  void textsOfTablesCanBeCopied();
  void namesAreHiddenInTables();
  void manyRowsRunOverPages();
  void rowsFitTheirPages_data();
  void rowsFitTheirPages();
};

void TestReportTables::tablesHoldTheNumbersOfThePanels_data() {
  QTest::addColumn<bool>("onPaper");
  QTest::addColumn<bool>("withKeyImage");
  QTest::newRow("PDF") << false << true;
  QTest::newRow("paper") << true << true;
  QTest::newRow("tables alone") << false << false;
}

// The report shows the uncertainty of a length, which the panel does not show.
void TestReportTables::tablesHoldTheNumbersOfThePanels() {
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

void TestReportTables::textsOfTablesCanBeCopied() {
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

void TestReportTables::namesAreHiddenInTables() {
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

void TestReportTables::manyRowsRunOverPages() {
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

void TestReportTables::rowsFitTheirPages_data() {
  QTest::addColumn<QSizeF>("roomMm");
  QTest::newRow("A4") << QSizeF(186, 250);
  QTest::newRow("A4 across") << QSizeF(273, 160);
  QTest::newRow("a label") << QSizeF(100, 120);
}

// The tables have rows of one to many lines, a word wider than its column and a text longer than a page.
// Nothing is painted below the room of a page, and no row is lost.
void TestReportTables::rowsFitTheirPages() {
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

VOLUMEN_TEST(TestReportTables);
#include "tst_report_tables.moc"
