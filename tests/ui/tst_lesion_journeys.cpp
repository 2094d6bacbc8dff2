// Guards two workflows from a lesion to its numbers, by real events. A PET over its CT is opened by folder,
// and its lesion segmented by a sphere and 41 %. SUVpeak and TLG are read in the table and a CSV file, and
// the session is saved and reopened. A synthetic cone has known numbers.
#include <QComboBox>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/fixtures/program.h"
#include "tests/ui/fusion_window.h"
#include "tests/ui/hand.h"
#include "tests/ui/looks_window.h"
#include "tests/ui/numbers_table.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr glm::dvec3 pHot(2.5, -3.5, 1.5);                       // a voxel centre
constexpr double hotTop = 16, hotMm = 11, suvOfBecquerel = 0.5;  // SUV 8

double hotValue(glm::dvec3 p) { return hotTop * std::max(0.0, 1 - glm::distance(p, pHot) / hotMm); }

// Returns a PET with a cone of 16 Bq/ml (SUV 8) in a background of 0.
LoadedSeriesPtr hotPet() {
  auto series = std::make_shared<LoadedSeries>(*seriesOf(volumeOf<float>(
      glm::ivec3(40), glm::dmat3(1), [](glm::dvec3 pVoxel) { return hotValue(pVoxel - 19.5); })));
  series->series.acquired = series->volume->geometry();
  series->series.modality = "PT";
  series->series.unit = "Bq/ml";
  series->series.suv.bodyWeight = suvOfBecquerel;
  series->firstScene.transferFunction.points = {{1, {1, 1, 1}, 0.0}, {8, {1, 1, 1}, 1.0}};
  return series;
}

using CsvFields = std::map<QString, QString>;

// Returns the field below each title of a CSV with one row. Quoted fields, which may hold commas, are
// skipped.
CsvFields fieldsOfCsv(const QByteArray& csv) {
  const QStringList lines = QString::fromUtf8(csv).split(QStringLiteral("\r\n"));
  CsvFields fields;
  if (lines.size() != 3) return fields;
  static const QRegularExpression quoted(QStringLiteral("\"[^\"]*\""));
  const QStringList heads = lines[0].split(QLatin1Char(',')),
                    values = QString(lines[1]).replace(quoted, QString()).split(QLatin1Char(','));
  if (heads.size() != values.size()) return fields;
  for (qsizetype n = 0; n < heads.size(); ++n) fields[heads[n]] = values[n];
  return fields;
}

// Saves the statistics table and returns its fields; empty if it is not written.
CsvFields savedCsv(Journey& w, const QString& path) {
  QTest::mouseClick(w.child<QWidget>("segmentNumbersCsv"), Qt::LeftButton);
  answer(w, "segmentNumbersFileDialog", path);
  if (!QTest::qWaitFor([&] { return QFile::exists(path); }, longest)) return {};
  return fieldsOfCsv(contentsOf(path));
}

double numberUnder(const char* head, const CsvFields& fields) {
  const auto field = fields.find(QLatin1String(head));
  return field == fields.end() ? NAN : field->second.toDouble();
}

bool isWithin(double is, double wanted, double part) { return std::abs(is / wanted - 1) < part; }

// Returns whether a PET lies over its CT.
bool areFused(SegmentWindow& w) {
  const auto modality = [&](const SeriesKey& key) {
    return key.empty() ? std::string() : w.workspace().series.at(key).series->modality;
  };
  return std::ranges::all_of(std::array{axialViewId, coronalViewId, sagittalViewId}, [&](ViewId id) {
    const ViewState& view = w.workspace().view(id);
    return modality(view.series) == "CT" && modality(flatLookOf(view).overlay) == "PT";
  });
}

// Returns the centre of the voxel with the largest value.
glm::dvec3 placeOfLargest(const Volume& volume) {
  const VoxelGeometry& grid = volume.geometry();
  glm::ivec3 largest(0);
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i)
        if (volume.value(i, j, k) > volume.value(largest.x, largest.y, largest.z)) largest = {i, j, k};
  return grid.patientFromVoxel(largest);
}

}  // namespace

class TestLesionJourneys : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aTumourOfAPetOverItsCt();
  void aConeFromPetToCsv();
};

// Compares with numpy's results on the PET files (TestRealRecipes).
void TestLesionJourneys::aTumourOfAPetOverItsCt() {
  const std::string data = dataPath("pet-ct");
  NEED_DATA(data);
  const UsualLayouts usual;
  const QTemporaryDir folder;
  const QString session = folder.filePath(QStringLiteral("s.volumen"));
  QStringList told;
  std::string checksum;
  {
    LooksWindow w(QStringList{QString::fromStdString(data)});
    QVERIFY(w.open());
    QTRY_VERIFY_WITH_TIMEOUT(areFused(w) && w.areDrawn(), longest);
    w.begin();
    // The coronal slice shows the height of the lesion. The other views follow the pointer there.
    const VoxelGeometry& grid = w.session().series()->volume->geometry();
    const glm::dvec3 pLargest = placeOfLargest(*w.session().series()->volume);
    const glm::dvec2 up = w.view(coronalViewId)->plane()->pixelFromPatient(pLargest);
    Hand(w.window).moveHolding(Qt::ShiftModifier, w.view(coronalViewId), {up.x, up.y});
    const SlicePlane plane = *w.view()->plane();
    QVERIFY(std::abs(glm::dot(pLargest - plane.centre, plane.normal())) < 0.5);

    w.showPage("segmentGrowing", "growPreview");
    QCOMPARE(w.child<QComboBox>("lesionThreshold")->currentText(), QStringLiteral("41 % of the maximum"));
    w.click("segmentLesion");
    const glm::dvec2 pixel = plane.pixelFromPatient(pLargest);
    const QPoint at(int(pixel.x), int(pixel.y));
    const int steps = w.steps();
    drag(w.view(), at, at + QPoint(w.pixels(60), 0));
    QVERIFY(w.idle());
    QVERIFY2(w.count() == 1, qPrintable(w.child<Banner>("banner")->sentence()));
    QCOMPARE(w.steps(), steps + 1);
    QCOMPARE(w.segment(0).label, std::string("Lesion 1"));
    QVERIFY(w.map()->labels->geometry() == grid);

    QVERIFY(openTable(w));
    const CsvFields fields = savedCsv(w, folder.filePath(QStringLiteral("lesion.csv")));
    for (const auto& [head, known, part] : std::initializer_list<std::tuple<const char*, double, double>>{
             {"Voxels", 307, 1e-9},
             {"Volume (ml)", 307 * grid.voxelVolume() / 1000, 1e-4},
             {"SUVmax (SUVbw)", 16.327686, 1e-5},
             {"SUVmean (SUVbw)", 9.70702, 1e-5},
             {"SUVpeak (SUVbw)", 11.7579, 1e-3},
             {"TLG (SUVbw ml)", 214.1186, 1e-3}}) {
      const double saved = numberUnder(head, fields);
      QVERIFY2(isWithin(saved, known, part),
               qPrintable(QStringLiteral("%1 %2").arg(QLatin1String(head)).arg(saved)));
      QVERIFY2(isWithin(cellOf(w, QLatin1String(head)).toDouble(), saved, 1e-4), head);
    }
    w.child<QAction>("saveSessionAs")->trigger();
    answer(w, "saveSessionDialog", session);
    QVERIFY(QTest::qWaitFor([&] { return w.window.windowTitle().contains(QStringLiteral("s.volumen")); },
                            longest));
    told = tableTexts(w);
    checksum = checksumOf(*w.map()->labels);
  }
  SegmentWindow again(QStringList{session});
  again.window.resize(1366, 768);
  QTRY_VERIFY_WITH_TIMEOUT(again.session().series() && areFused(again), longest);
  QCOMPARE(again.count(), std::size_t(1));
  QVERIFY(again.map()->labels);
  QCOMPARE(checksumOf(*again.map()->labels), checksum);
  again.child<QDockWidget>("segmentDock")->raise();
  QCoreApplication::processEvents();
  QVERIFY(openTable(again));
  QCOMPARE(tableTexts(again), told);
}

// The part of a cone above 41 % of its top is a ball of 59 % of its radius r. The mean of a cone in a ball of
// radius b about its centre is top (1 - 3 b / (4 r)). The ball of 1 ml has a radius of 6.2 mm and lies in the
// lesion.
void TestLesionJourneys::aConeFromPetToCsv() {
  const QTemporaryDir folder;
  SegmentWindow w(hotPet());
  w.click("segmentGrowing");
  w.child<QComboBox>("lesionThreshold")->setCurrentIndex(0);
  w.child<QAction>("lesionTool")->trigger();
  const QPoint at = w.showPlace(pHot);
  drag(w.view(), at, at + QPoint(int(12.5 / w.view()->plane()->mmPerPixel), 0));
  QVERIFY(w.idle());
  QCOMPARE(w.count(), std::size_t(1));
  QVERIFY(openTable(w));
  const CsvFields fields = savedCsv(w, folder.filePath(QStringLiteral("lesion.csv")));
  const auto number = [&](const char* head) { return numberUnder(head, fields); };

  // Sums over voxels.
  const double top = hotTop * suvOfBecquerel, radius = 0.59 * hotMm;
  std::int64_t voxels = 0;
  double sum = 0;
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) {
        const glm::dvec3 p = glm::dvec3(i, j, k) - 19.5;
        if (glm::distance(p, pHot) > radius + 1e-6) continue;
        ++voxels;
        sum += suvOfBecquerel * double(float(hotValue(p)));
      }
  QCOMPARE(number("Voxels"), double(voxels));
  QCOMPARE(number("Volume (ml)"), double(voxels) / 1000);
  QVERIFY(isWithin(number("SUVmax (SUVbw)"), top, 1e-6));
  QVERIFY(isWithin(number("SUVmean (SUVbw)"), sum / double(voxels), 1e-6));
  QVERIFY(isWithin(number("TLG (SUVbw ml)"), sum / 1000, 1e-6));
  // The closed forms of the cone hold as far as voxels of 1 mm allow.
  const double ballMm = std::cbrt(1000 * 3 / (4 * std::numbers::pi));
  QVERIFY(isWithin(number("SUVpeak (SUVbw)"), top * (1 - 0.75 * ballMm / hotMm), 0.01));
  const double coneMl = 4 * std::numbers::pi / 3 * radius * radius * radius / 1000;
  QVERIFY(isWithin(number("TLG (SUVbw ml)"), coneMl * top * (1 - 0.75 * 0.59), 0.05));
  // The window shows the numbers of the file, to five digits.
  for (const char* head : {"SUVpeak (SUVbw)", "TLG (SUVbw ml)", "SUVmax (SUVbw)"})
    QVERIFY2(isWithin(cellOf(w, QLatin1String(head)).toDouble(), number(head), 1e-4), head);
}

VOLUMEN_TEST(TestLesionJourneys);
#include "tst_lesion_journeys.moc"
