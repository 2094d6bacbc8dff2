// Guards narrow windows. The warnings of the series, the date of the study in its view and in the list, and
// the list itself keep their room, also once the window has been narrow.
#include <QDockWidget>
#include <QFontMetrics>
#include <QTemporaryDir>
#include <QTreeWidget>

#include "io/export/dicom_series.h"
#include "results/pictures/overlays.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/status_line.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

class TestWindowNarrow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theWarningIsRead_data();
  void theWarningIsRead();
  void theDateIsThere_data();
  void theDateIsThere();
  void theListHasTheDate_data();
  void theListHasTheDate();
  void theListStaysWide();
};

namespace {

void addSizes() {
  QTest::addColumn<int>("width");
  for (const int width : {640, 800, 900, 1024}) QTest::addRow("%d pixels wide", width) << width;
}

const QString date = QStringLiteral("2026-03-14");

// Writes a head whose patient and series have long names.
bool writeHead(const QString& folder, const char* study) {
  DicomSeriesTags tags;
  tags.patientName = "Featherstonehaugh^Bartholomew Maximilian", tags.patientId = "4711-0815-2342";
  tags.studyDate = "20260314", tags.studyDescription = study;
  tags.description = "Thorax with contrast, lung kernel, 1 mm";
  return writeDicomSeries(**makePhantom("ct-head:24"), tags, folder.toStdString()).ok();
}

}  // namespace

void TestWindowNarrow::theWarningIsRead_data() { addSizes(); }

// Beside the longest texts that the line has: of the pointer, of a task and of what was done.
void TestWindowNarrow::theWarningIsRead() {
  QFETCH(int, width);
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  series->warnings = {Warning("Slices are unevenly spaced: drawn slices are interpolated.")};
  MeasureWindow w(series);
  w.window.resize(width, 600);
  auto* line = w.window.findChild<StatusLine*>();
  line->showHover(QStringLiteral("R 123.4, A 123.4, S 1234.5 mm: -1024 HU in slice 123 of 456"));
  line->tell(QStringLiteral("Saved /home/someone/a long folder/another long folder/measurements.csv"));
  QCoreApplication::processEvents();
  const auto* warning = w.child<QLabel>("warningText");
  QVERIFY2(warning->text().startsWith(QStringLiteral("! Slices are unevenly")), qPrintable(warning->text()));
  QVERIFY(warning->isVisible());
  QVERIFY(warning->visibleRegion().boundingRect().width() >=
          warning->fontMetrics().horizontalAdvance(warning->text()));
}

void TestWindowNarrow::theDateIsThere_data() { addSizes(); }

void TestWindowNarrow::theDateIsThere() {
  QFETCH(int, width);
  const QTemporaryDir folder;
  QVERIFY(writeHead(folder.filePath(QStringLiteral("a")), "Abdomen"));
  MeasureWindow w(QStringList{folder.filePath(QStringLiteral("a"))});
  w.window.resize(width, 600);
  QVERIFY(w.settle());
  w.child<QAction>("layoutPlanes")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.view() && !w.view()->picture().isNull(), longest);
  QStringList seen;
  for (const PlacedText& text :
       placeOverlays(w.view()->overlays(), QRectF(w.view()->rect()), w.view()->font()).texts)
    seen << text.text;
  QVERIFY2(!seen.filter(date).isEmpty(), qPrintable(seen.join(QLatin1Char('|'))));
}

void TestWindowNarrow::theListHasTheDate_data() { addSizes(); }

// The row begins as that of a study of the same date with nothing else to tell.
void TestWindowNarrow::theListHasTheDate() {
  QFETCH(int, width);
  const QTemporaryDir folder;
  QImage rows[2];
  for (const bool isLong : {false, true}) {
    const QString path = folder.filePath(isLong ? QStringLiteral("long") : QStringLiteral("short"));
    QVERIFY(writeHead(path, isLong ? "Abdomen and pelvis, three phases, late one with contrast" : ""));
    MeasureWindow w(QStringList{path});
    w.window.resize(width, 600);
    QVERIFY(w.settle());
    auto* tree = w.child<QTreeWidget>("studyTree");
    QRect row = tree->visualItemRect(tree->topLevelItem(0)->child(0));
    row.setWidth(tree->fontMetrics().horizontalAdvance(date));
    QVERIFY(row.right() < tree->viewport()->width());
    rows[isLong] = tree->viewport()->grab(row).toImage();
  }
  QCOMPARE(rows[1], rows[0]);
}

void TestWindowNarrow::theListStaysWide() {
  MeasureWindow w;
  auto* dock = w.child<QDockWidget>("studiesDock");
  for (const int width : {1440, 640, 400, 800, 1440}) {
    w.window.resize(width, 700);
    QCoreApplication::processEvents();
    QVERIFY2(dock->width() >= 150, qPrintable(QString::number(dock->width())));
  }
}

VOLUMEN_TEST(TestWindowNarrow);
#include "tst_window_narrow.moc"
