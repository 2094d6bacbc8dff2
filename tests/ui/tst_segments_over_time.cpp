// Guards the curve of segments over time: mean and SD of the same voxels in each time point, read as a job.
// It is shown in the chart, as CSV and in the JSON, and says if it was cancelled. Real events on a file of
// four volumes.
#include <QClipboard>
#include <QDialog>
#include <QGuiApplication>
#include <QLabel>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/fixtures/program.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/panels/segment_chart_box.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Writes four volumes of 16 x 16 x 16 voxels of 2 mm. In volume n, voxels of even x are 101 n, of odd x 99 n,
// and those in the half of larger z are 1000.
QString fourContrasts(const QTemporaryDir& folder) {
  const QString path = folder.filePath(QStringLiteral("contrasts.nrrd"));
  std::ofstream file(path.toStdString(), std::ios::binary);
  file << "NRRD0005\ntype: int16\ndimension: 4\nspace: left-posterior-superior\nsizes: 16 16 16 4\n"
          "space directions: (2,0,0) (0,2,0) (0,0,2) none\nkinds: domain domain domain time\n"
          "space origin: (0,0,0)\nendian: little\nencoding: raw\n\n";
  for (int n = 1; n <= 4; ++n)
    for (int voxel = 0; voxel < 16 * 16 * 16; ++voxel) {
      const auto value = std::int16_t(voxel >= 8 * 16 * 16 ? 1000 : voxel % 2 ? 99 * n : 101 * n);
      file.write(reinterpret_cast<const char*>(&value), sizeof value);
    }
  return path;
}

struct OverTimeWindow : SegmentWindow {
  explicit OverTimeWindow(const QTemporaryDir& folder) : SegmentWindow(QStringList{fourContrasts(folder)}) {}

  // Segments the lower half in the first volume and selects its row.
  bool open() {
    if (!QTest::qWaitFor([this] { return session().series() != nullptr; }, longest)) return false;
    window.resize(1440, 900);
    child<QDockWidget>("segmentDock")->raise();
    QCoreApplication::processEvents();
    if (!make(50, 150) || count() != 1) return false;
    click("segmentNumbersButton");
    if (!idle()) return false;
    auto* table = child<QTableWidget>("segmentNumbers");
    const QPoint place = table->visualItemRect(table->item(0, 0)).center();
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, place);
    return true;
  }
  QComboBox* kind() { return child<QComboBox>("segmentChartKind"); }
  const MeasuredChart& chart() { return child<ChartView>("segmentChart")->chart(); }
  QString chartSaid() { return child<QLabel>("segmentChartSaid")->text(); }
  bool showsAll() {
    return QTest::qWaitFor(
        [this] {
          return chart().lines == std::vector<std::vector<QPointF>>{{{1, 100}, {2, 200}, {3, 300}, {4, 400}}};
        },
        longest);
  }
};

}  // namespace

class TestSegmentsOverTime : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void oneVolumeHasNone();
  void meanAndSdAreDrawn();
  void theyAreSavedOnceRead();
  void cancelledIsSaid();
  void changedVoxelsAreMeasuredAgain();
};

void TestSegmentsOverTime::oneVolumeHasNone() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.press("segmentNumbersButton"));
  QCOMPARE(w.child<QComboBox>("segmentChartKind")->count(), 1);
  QVERIFY(!w.child<QComboBox>("segmentChartKind")->isEnabled());
}

void TestSegmentsOverTime::meanAndSdAreDrawn() {
  const QTemporaryDir folder;
  OverTimeWindow w(folder);
  QVERIFY(w.open());
  QCOMPARE(w.kind()->count(), 2);
  QCOMPARE(w.kind()->currentText(), QStringLiteral("Histogram"));
  QVERIFY(w.chart().sds.empty());
  QTest::keyClick(w.kind(), Qt::Key_Down);
  QVERIFY(w.showsAll());
  QCOMPARE(w.chart().xTitle, QStringLiteral("Volume"));
  QVERIFY(w.chart().marked && w.chart().problem.isEmpty());
  QVERIFY((w.chart().sds == std::vector<std::vector<double>>{{1, 2, 3, 4}}));
  const QString name = QString::fromStdString(w.segment(0).label);
  QCOMPARE(w.chart().looks.at(0).name, name);
  w.shot("segments-over-time");
  QTest::mouseClick(w.child<QToolButton>("segmentChartCopy"), Qt::LeftButton);
  const QStringList rows = QGuiApplication::clipboard()->text().split(QStringLiteral("\r\n"));
  QCOMPARE(rows.size(), qsizetype(6));
  QVERIFY2(rows[0].endsWith(QStringLiteral(",\"SD\"")), qPrintable(rows[0]));
  QVERIFY2(rows[4].endsWith(QStringLiteral(",4,400,4")), qPrintable(rows[4]));
  QTest::keyClick(w.kind(), Qt::Key_Up);
  QVERIFY(w.chart().sds.empty() && !w.chart().lines.empty());
}

void TestSegmentsOverTime::theyAreSavedOnceRead() {
  const QTemporaryDir folder;
  OverTimeWindow w(folder);
  QVERIFY(w.open());
  const auto saved = [&](const char* name) {
    const QString path = folder.filePath(QLatin1String(name));
    w.click("segmentNumbersJson");
    answer(w, "segmentNumbersFileDialog", path);
    if (!QTest::qWaitFor([&] { return QFile::exists(path); }, longest)) return nlohmann::json();
    return nlohmann::json::parse(contentsOf(path).toStdString());
  };
  const nlohmann::json before = saved("before.json");
  QVERIFY(before.contains("segments") && !before.contains("timeAxis"));
  QTest::keyClick(w.kind(), Qt::Key_Down);
  QVERIFY(w.showsAll());
  const nlohmann::json json = saved("after.json");
  QCOMPARE(json["timeAxis"].get<std::string>(), std::string("Volume"));
  const nlohmann::json& points = json["segments"][0]["timePoints"];
  QCOMPARE(points.size(), std::size_t(4));
  for (int n = 1; n <= 4; ++n) {
    const nlohmann::json expected{{"at", n}, {"mean", 100 * n}, {"sd", n}, {"min", 99 * n}, {"max", 101 * n}};
    QVERIFY(points[std::size_t(n - 1)] == expected);
  }
}

// The reading is cancelled before its end. Choosing the curve again restarts it.
void TestSegmentsOverTime::cancelledIsSaid() {
  const QTemporaryDir folder;
  OverTimeWindow w(folder);
  QVERIFY(w.open());
  QTest::keyClick(w.kind(), Qt::Key_Down);
  QVERIFY2(w.chartSaid().startsWith(QStringLiteral("Reading")), qPrintable(w.chartSaid()));
  Jobs& jobs = w.window.jobs();
  for (const JobRow& row : jobs.rows()) jobs.cancel(row.id);
  QVERIFY2(w.chartSaid().startsWith(QStringLiteral("Reading was cancelled")), qPrintable(w.chartSaid()));
  QVERIFY(w.idle() && w.chart().lines.empty());
  QTest::keyClick(w.kind(), Qt::Key_Up);
  QVERIFY(!w.chart().lines.empty());
  QTest::keyClick(w.kind(), Qt::Key_Down);
  QVERIFY(w.showsAll());
}

// Without the voxels of odd x, the SD vanishes.
void TestSegmentsOverTime::changedVoxelsAreMeasuredAgain() {
  const QTemporaryDir folder;
  OverTimeWindow w(folder);
  QVERIFY(w.open());
  QTest::keyClick(w.kind(), Qt::Key_Down);
  QVERIFY(w.showsAll());
  QVERIFY(w.make(100.5, 150));
  QVERIFY(w.idle());
  auto* table = w.child<QTableWidget>("segmentNumbers");
  QTRY_COMPARE_WITH_TIMEOUT(table->rowCount(), 2, longest);
  QVERIFY(w.idle());
  QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, table->visualItemRect(table->item(1, 0)).center());
  const std::vector<std::vector<QPointF>> wanted{{{1, 101}, {2, 202}, {3, 303}, {4, 404}}};
  QTRY_VERIFY_WITH_TIMEOUT(w.chart().lines == wanted, longest);
  QVERIFY((w.chart().sds == std::vector<std::vector<double>>{{0, 0, 0, 0}}));
}

VOLUMEN_TEST(TestSegmentsOverTime);
#include "tst_segments_over_time.moc"
