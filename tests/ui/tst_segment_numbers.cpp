// Guards the segment statistics table. It shows the measured values, follows the segments, is sorted, copied
// and saved, and compares two rows.
#include <QClipboard>
#include <QDialog>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QPointer>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <cmath>
#include <nlohmann/json.hpp>

#include "results/numbers/segment_charts.h"
#include "results/numbers/segment_columns.h"
#include "results/text/value_text.h"
#include "tests/fixtures/program.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/panels/segment_chart_box.h"
#include "ui/widgets/frozen_column.h"
#include "ui/workspace/series_segments.h"
#include "viewer/segment/numbers.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct NumbersWindow : SegmentWindow {
  using SegmentWindow::SegmentWindow;

  QTableWidget* table() { return child<QTableWidget>("segmentNumbers"); }
  QString said() { return child<QLabel>("segmentNumbersSaid")->text(); }
  bool open() {
    click("segmentNumbersButton");
    return idle() && child<QDialog>("segmentNumbersDialog")->isVisible();
  }
  // Finds a column title with any unit.
  int columnOf(const QString& head) {
    for (int column = 0; column < table()->columnCount(); ++column) {
      const QString text = table()->horizontalHeaderItem(column)->text();
      if (text == head || text.startsWith(head + QStringLiteral(" ("))) return column;
    }
    return -1;
  }
  QString cell(int row, const char* head) {
    return table()->item(row, columnOf(QLatin1String(head)))->text();
  }
  void chooseRow(int row, Qt::KeyboardModifiers keys = {}) {
    const QPoint place = table()->visualItemRect(table()->item(row, 0)).center();
    QTest::mouseClick(table()->viewport(), Qt::LeftButton, keys, place);
  }
  // Begins a stroke in an empty area and returns the mouse position. The button stays down.
  QPoint beginStroke() {
    child<QAction>("paintTool")->trigger();
    const QPoint from = showPlace({14.5, -14.5, 0.5}), to = from + QPoint(20, 0);
    QTest::mousePress(view(), Qt::LeftButton, {}, from);
    QTest::mouseEvent(QTest::MouseMove, view(), Qt::LeftButton, {}, to);
    return to;
  }
  const MeasuredChart& chart() { return child<ChartView>("segmentChart")->chart(); }
  QString chartSaid() { return child<QLabel>("segmentChartSaid")->text(); }
  // Returns the histogram of one segment.
  MeasuredChart histogramOf(int number) {
    SegmentReport report;
    report.segment = segment(std::size_t(number - 1));
    report.values = valuesIn(mask(number), *session().series()->volume);
    return segmentHistograms({&report, 1}, shownScale(session().series()->series));
  }
  // Counts chart pixels near this colour, because edges are antialiased.
  int pixelsLike(QColor colour) {
    const QImage picture = child<ChartView>("segmentChart")->grab().toImage();
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        const QColor at = picture.pixelColor(x, y);
        count += std::abs(at.red() - colour.red()) + std::abs(at.green() - colour.green()) +
                     std::abs(at.blue() - colour.blue()) <
                 90;
      }
    return count;
  }
  void clickHead(int column) {
    QHeaderView* head = table()->horizontalHeader();
    QTest::mouseClick(
        head->viewport(), Qt::LeftButton, {},
        {head->sectionViewportPosition(column) + head->sectionSize(column) / 2, head->height() / 2});
  }
};

std::int64_t shellAndSmall() {
  return voxelsWhere([](glm::dvec3 p) { return isShell(p) || isSmall(p); });
}

}  // namespace

class TestSegmentTable : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void hasARowForEachSegment();
  void followsTheSegments();
  void strokesAreMeasuredOnceTheyEnd();
  void aStrokeThatIsGivenUpIsNotMeasured();
  void closedItMeasuresNothing();
  void isInTheOrderOfTheListAtFirst();
  void isSortedByNumbers();
  void namesStayInSight();
  void twoAreCompared();
  void chosenOnesAreDrawn();
  void isCopied();
  void isSaved();
  void isInSuv();
};

void TestSegmentTable::hasARowForEachSegment() {
  NumbersWindow w;
  QVERIFY(!w.button("segmentNumbersButton")->isEnabled());
  QVERIFY(w.makeBoth());
  QVERIFY(w.open());
  QCOMPARE(w.table()->rowCount(), 2);
  QCOMPARE(w.table()->columnCount(), int(segmentColumns().size()) + 1);
  QCOMPARE(w.cell(0, "Voxels"), QString::number(shellAndSmall()));
  QCOMPARE(w.cell(1, "Voxels"), QString::number(voxelsWhere(isCore)));
  QCOMPARE(w.table()->item(0, 0)->text(), QString::fromStdString(w.segment(0).label));
  QCOMPARE(w.cell(1, "Median"), QStringLiteral("500"));
}

// A new name is shown at once, changed voxels are measured again, and an empty list is reported.
void TestSegmentTable::followsTheSegments() {
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.open());
  w.session().change(QStringLiteral("Rename"),
                     withSegmentChanged(w.workspace(), w.series(), 1, [](Segment& s) { s.label = "=A"; }));
  QCOMPARE(w.table()->item(0, 0)->text(), QStringLiteral("=A"));
  QCOMPARE(w.cell(0, "Voxels"), QString::number(shellAndSmall()));
  QVERIFY(w.step("largest"));
  QTRY_COMPARE_WITH_TIMEOUT(w.cell(0, "Voxels"), QString::number(voxelsWhere(isShell)), longest);
  QVERIFY(w.press("segmentRemove"));
  QTRY_COMPARE_WITH_TIMEOUT(w.table()->rowCount(), 1, longest);
  QVERIFY(w.press("segmentRemove"));
  QTRY_COMPARE_WITH_TIMEOUT(w.table()->rowCount(), 0, longest);
}

void TestSegmentTable::strokesAreMeasuredOnceTheyEnd() {
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.open());
  const std::int64_t before = w.voxels(1);
  const QPoint at = w.beginStroke();
  QVERIFY(w.voxels(1) > before);
  QCOMPARE(w.table()->rowCount(), 2);
  QCOMPARE(w.cell(0, "Voxels"), QString::number(before));
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, at);
  const auto isMeasured = [&] {
    return w.table()->rowCount() == 2 && w.cell(0, "Voxels") == QString::number(w.voxels(1));
  };
  QTRY_VERIFY_WITH_TIMEOUT(isMeasured(), longest);
}

void TestSegmentTable::aStrokeThatIsGivenUpIsNotMeasured() {
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.open());
  const QString said = w.said();
  const std::int64_t before = w.voxels(1);
  const QPoint at = w.beginStroke();
  QVERIFY(w.voxels(1) > before);
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, at);
  QCOMPARE(w.voxels(1), before);
  QCOMPARE(w.said(), said);
  QCoreApplication::processEvents();
  QCOMPARE(w.said(), said);
  QCOMPARE(w.table()->rowCount(), 2);
}

// A closed dialog measures nothing even before it is deleted.
void TestSegmentTable::closedItMeasuresNothing() {
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  w.click("segmentNumbersButton");
  const QPointer<QDialog> dialog = w.child<QDialog>("segmentNumbersDialog");
  QCOMPARE(w.window.jobs().rows().size(), std::size_t(1));
  QTest::keyClick(dialog, Qt::Key_Escape);
  QVERIFY(dialog && !dialog->isVisible());
  QVERIFY(w.window.jobs().rows().empty());
  QTRY_VERIFY_WITH_TIMEOUT(!dialog, longest);
}

void TestSegmentTable::isInTheOrderOfTheListAtFirst() {
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  for (const auto& [number, name] : {std::pair(1, "A"), {2, "B"}})
    w.session().change(
        QStringLiteral("Rename"),
        withSegmentChanged(w.workspace(), w.series(), number, [name = name](Segment& s) { s.label = name; }));
  QVERIFY(w.open());
  QCOMPARE(w.table()->item(0, 0)->text(), QStringLiteral("A"));
  QCOMPARE(w.table()->item(1, 0)->text(), QStringLiteral("B"));
}

void TestSegmentTable::isSortedByNumbers() {
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.open());
  const int voxels = w.columnOf(QStringLiteral("Voxels"));
  w.clickHead(voxels);
  const bool firstIsSmaller = w.cell(0, "Voxels").toInt() < w.cell(1, "Voxels").toInt();
  w.clickHead(voxels);
  QCOMPARE(w.cell(0, "Voxels").toInt() < w.cell(1, "Voxels").toInt(), !firstIsSmaller);
}

// Rows can be selected and sorted by their names. The name column hides no number.
void TestSegmentTable::namesStayInSight() {
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.open());
  w.child<QDialog>("segmentNumbersDialog")->resize(500, 440);
  QTableWidget* table = w.table();
  auto* names = w.child<FrozenColumn>("segmentNames");
  table->setCurrentCell(0, table->columnCount() - 1);
  QCoreApplication::processEvents();
  QVERIFY(!table->viewport()->rect().intersects(table->visualItemRect(table->item(0, 0))));
  const QPoint second = names->visualRect(names->model()->index(1, 0)).center();
  QCOMPARE(names->childAt(names->viewport()->mapTo(names, second)), names->viewport());
  QCOMPARE(names->viewport()->mapTo(table, second).y(),
           table->viewport()->mapTo(table, table->visualItemRect(table->item(1, 0)).center()).y());
  QTest::mouseClick(names->viewport(), Qt::LeftButton, {}, second);
  QVERIFY(table->selectionModel()->isRowSelected(1) && !table->selectionModel()->isRowSelected(0));
  QTest::mouseClick(names->horizontalHeader()->viewport(), Qt::LeftButton, {}, {10, 10});
  const QString first = table->item(0, 0)->text();
  QTest::mouseClick(names->horizontalHeader()->viewport(), Qt::LeftButton, {}, {10, 10});
  QVERIFY(table->item(0, 0)->text() != first);
  table->setFocus();
  table->setCurrentCell(0, table->columnCount() - 1);
  for (int column = table->columnCount() - 2; column > 0; --column) {
    QTest::keyClick(table, Qt::Key_Left);
    QCOMPARE(table->currentColumn(), column);
    QVERIFY(table->visualItemRect(table->currentItem()).left() >= names->width());
  }
}

void TestSegmentTable::twoAreCompared() {
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.open());
  QVERIFY(!w.button("segmentNumbersCompare")->isEnabled());
  w.chooseRow(0);
  QVERIFY(!w.button("segmentNumbersCompare")->isEnabled());
  w.chooseRow(1, Qt::ControlModifier);
  QVERIFY(w.press("segmentNumbersCompare"));
  const auto alike = likeness(w.mask(1), w.mask(2));
  QVERIFY(alike.ok() && alike->distances);
  QTRY_VERIFY_WITH_TIMEOUT(w.said().contains(QStringLiteral("Dice 0,")), longest);
  QVERIFY2(
      w.said().contains(QStringLiteral("Hausdorff distance %1 mm").arg(alike->distances->largest, 0, 'g', 4)),
      qPrintable(w.said()));
}

void TestSegmentTable::chosenOnesAreDrawn() {
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.open());
  auto* copy = w.child<QToolButton>("segmentChartCopy");
  QCOMPARE(w.chart().lines.size(), std::size_t(2));  // all rows if none is selected
  QVERIFY(copy->isEnabled() && w.chartSaid().isEmpty());
  w.chooseRow(0);
  QVERIFY(!w.chart().lines.empty());
  QVERIFY(w.chart() == w.histogramOf(1));
  w.chooseRow(1, Qt::ControlModifier);
  QCOMPARE(w.chart().lines.size(), std::size_t(2));
  QVERIFY(w.chart().lines[1] == w.histogramOf(2).lines[0]);
  for (const ChartLineLook& look : w.chart().looks) QVERIFY(w.pixelsLike(look.colour) > 20);
  w.shot("segment-histograms");
  QTest::mouseClick(copy, Qt::LeftButton);
  QCOMPARE(QGuiApplication::clipboard()->text(), chartAsCsv(w.chart()));
  // The selection stays with the measured segments.
  w.session().change(QStringLiteral("Rename"),
                     withSegmentChanged(w.workspace(), w.series(), 1, [](Segment& s) { s.label = "A"; }));
  w.chooseRow(0);
  QCOMPARE(w.chart().looks[0].name, QStringLiteral("A"));
  QVERIFY(w.step("largest"));
  QVERIFY(w.idle());
  QCOMPARE(w.chart().lines.size(), std::size_t(2));
  w.chooseRow(0);
  QVERIFY(w.chart() == w.histogramOf(1));
}

void TestSegmentTable::isCopied() {
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  w.session().change(QStringLiteral("Rename"),
                     withSegmentChanged(w.workspace(), w.series(), 1, [](Segment& s) { s.label = "=1+1"; }));
  QVERIFY(w.open());
  w.click("segmentNumbersCopy");
  QStringList lines = QGuiApplication::clipboard()->text().split(QLatin1Char('\n'));
  QCOMPARE(lines.size(), 3);
  QVERIFY(lines[0].startsWith(QStringLiteral("Name\tVoxels\t")));
  QVERIFY(lines[1].startsWith(QStringLiteral("'=1+1\t%1\t").arg(shellAndSmall())));
  w.chooseRow(1);
  QTest::keyClick(w.table(), Qt::Key_C, Qt::ControlModifier);
  lines = QGuiApplication::clipboard()->text().split(QLatin1Char('\n'));
  QCOMPARE(lines.size(), 2);
  QVERIFY(lines[1].contains(QStringLiteral("\t%1\t").arg(voxelsWhere(isCore))));
}

void TestSegmentTable::isSaved() {
  const QTemporaryDir folder;
  const QString csv = folder.filePath(QStringLiteral("a.csv")),
                json = folder.filePath(QStringLiteral("a.json"));
  NumbersWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.open());
  w.click("segmentNumbersCsv");
  answer(w, "segmentNumbersFileDialog", csv);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(csv), longest);
  QCOMPARE(contentsOf(csv).count("\r\n"), qsizetype(3));
  w.click("segmentNumbersJson");
  answer(w, "segmentNumbersFileDialog", json);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(json), longest);
  const auto read = nlohmann::json::parse(contentsOf(json).toStdString());
  QCOMPARE(read["segments"].size(), std::size_t(2));
  QCOMPARE(read["segments"][1]["voxels"].get<std::int64_t>(), voxelsWhere(isCore));
  QVERIFY(read["segments"][1]["histogram"]["counts"].get<std::vector<std::int64_t>>() ==
          std::vector{voxelsWhere(isCore)});
  w.click("segmentNumbersCsv");
  answer(w, "segmentNumbersFileDialog", folder.filePath(QStringLiteral("none/a.csv")));
  QTRY_VERIFY_WITH_TIMEOUT(w.said().startsWith(QStringLiteral("Cannot write")), longest);
}

// A PET in Bq/ml with an SUV factor of 1/1000.
void TestSegmentTable::isInSuv() {
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  series->series.modality = "PT";
  series->series.unit = "Bq/ml";
  series->series.suv.bodyWeight = 1e-3;
  NumbersWindow w(series);
  QVERIFY(w.make(0.8, 1.2) && w.make(0.4, 0.6));  // in SUV, as shown
  QVERIFY(w.open());
  QCOMPARE(w.cell(0, "SUVmax (SUVbw)"), QStringLiteral("1"));
  QCOMPARE(w.cell(1, "SUVmean (SUVbw)"), QStringLiteral("0.5"));
  QVERIFY(w.cell(0, "SUVpeak (SUVbw)").toDouble() > 0.5);
  QVERIFY(std::abs(w.cell(1, "TLG (SUVbw ml)").toDouble() - double(voxelsWhere(isCore)) / 2000) < 1e-4);
}

VOLUMEN_TEST(TestSegmentTable);
#include "tst_segment_numbers.moc"
