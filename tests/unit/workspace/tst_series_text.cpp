// Guards design.md 8: the text of each entry in the list of series.
#include <glm/gtc/matrix_transform.hpp>

#include "io/study/series.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "tests/unit/suite.h"

using namespace volumen;

class TestSeriesText : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void planesHaveTheirNames_data();
  void planesHaveTheirNames();
  void slicesAreCounted();
  void namesakesAreToldApart_data();
  void namesakesAreToldApart();
  void everythingIsSaid();
  void framesAreNotWarnedOfTheirVolume();
};

namespace {

// Returns slices whose normal is z, rotated by an angle about an axis.
VoxelGeometry turned(double degrees, glm::dvec3 axis) {
  VoxelGeometry g{.size = {64, 64, 28}};
  g.patientFromVoxelStep = glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(degrees), axis));
  g.patientFromVoxelStep[2] *= 4;
  return g;
}

Series with(const char* echoTime, const char* bValue, const char* timePoint, const char* time) {
  Series series;
  series.echoTime = echoTime;
  series.bValue = bValue;
  series.timePoint = timePoint;
  series.time = time;
  return series;
}

}  // namespace

void TestSeriesText::planesHaveTheirNames_data() {
  QTest::addColumn<double>("degrees");
  QTest::addColumn<bool>("aboutX");
  QTest::addColumn<QString>("plane");
  const auto row = [](const char* name, double degrees, bool aboutX, const char* plane) {
    QTest::newRow(name) << degrees << aboutX << QString::fromLatin1(plane);
  };
  row("axial", 0, true, "axial");
  row("axial from above", 180, true, "axial");
  row("gantry tilt", 25, true, "axial");
  row("coronal", 90, true, "coronal");
  row("coronal from behind", -90, true, "coronal");
  row("sagittal", 90, false, "sagittal");
  row("half way", 45, true, "oblique");
  row("half way to sagittal", -45, false, "oblique");
}

void TestSeriesText::planesHaveTheirNames() {
  QFETCH(double, degrees);
  QFETCH(bool, aboutX);
  QFETCH(QString, plane);
  VoxelGeometry g = turned(degrees, aboutX ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  QCOMPARE(planeText(g), plane);
  // Gantry tilt shears the volume, and the slices stay the same.
  g.patientFromVoxelStep[2] += glm::dvec3(0, 2, 0);
  QCOMPARE(planeText(g), plane);
  g.calibrated = false;
  QCOMPARE(planeText(g), QString());
}

void TestSeriesText::slicesAreCounted() {
  Series series;
  series.acquired = turned(0, {1, 0, 0});
  QCOMPARE(slicesText(series), QStringLiteral("28 slices, axial"));
  series.warnings = {{"The header gives no directions.", WarningKind::noDirections}};
  QCOMPARE(slicesText(series), QStringLiteral("28 slices"));
  series.warnings.clear();
  series.acquired.size.z = 1;
  series.acquired.calibrated = false;
  QCOMPARE(slicesText(series), QStringLiteral("1 slice"));
}

void TestSeriesText::namesakesAreToldApart_data() {
  QTest::addColumn<std::vector<Series>>("all");
  QTest::addColumn<QStringList>("texts");  // texts of the first series
  using All = std::vector<Series>;
  QTest::newRow("alone") << All{with("20", "0", "1", "102231")} << QStringList{};
  QTest::newRow("echo times") << All{with("20", "", "", "10"), with("40", "", "", "10")}
                              << QStringList{QStringLiteral("TE 20 ms")};
  QTest::newRow("b-values") << All{with("80", "1000", "", "10"), with("80", "0", "", "11")}
                            << QStringList{QStringLiteral("b 1000")};
  QTest::newRow("time points") << All{with("", "", "3", "10"), with("", "", "4", "10")}
                               << QStringList{QStringLiteral("time point 3")};
  All breasts{with("", "", "", "10"), with("", "", "", "10"), with("", "", "", "10")};
  breasts[0].laterality = breasts[1].laterality = "L", breasts[2].laterality = "R";
  breasts[0].viewPosition = breasts[2].viewPosition = "CC", breasts[1].viewPosition = "MLO";
  QTest::newRow("projections") << breasts << QStringList{QStringLiteral("L CC")};
  Series breast = with("", "", "", "10"), chest = breast, knee = breast;
  breast.laterality = "R", breast.viewPosition = "MLO";
  chest.viewPosition = "PA", knee.laterality = "R";
  breast.notVolume = chest.notVolume = "A picture.";
  QTest::newRow("a breast alone") << All{breast} << QStringList{QStringLiteral("R MLO")};
  QTest::newRow("a chest alone") << All{chest} << QStringList{QStringLiteral("view PA")};
  QTest::newRow("slices of a knee alone") << All{knee} << QStringList{};
  All labelled{with("20", "", "", "10"), with("20", "", "", "10")};
  labelled[0].label = "direction 12", labelled[1].label = "direction 13";
  QTest::newRow("a label") << labelled << QStringList{QStringLiteral("direction 12")};
  QTest::newRow("time of day") << All{with("", "", "", "102231.5"), with("", "", "", "112231.5")}
                               << QStringList{QStringLiteral("10:22:31")};
  QTest::newRow("two together") << All{with("20", "0", "", ""), with("40", "0", "", ""),
                                       with("20", "50", "", "")}
                                << QStringList{QStringLiteral("TE 20 ms"), QStringLiteral("b 0")};
  QTest::newRow("nothing does") << All{with("20", "", "", ""), with("20", "", "", "")} << QStringList{};
}

void TestSeriesText::namesakesAreToldApart() {
  QFETCH(std::vector<Series>, all);
  QFETCH(QStringList, texts);
  std::vector<const Series*> others;
  for (const Series& series : all) others.push_back(&series);
  QCOMPARE(tellingApart(all[0], others), texts);
}

void TestSeriesText::everythingIsSaid() {
  Series series = with("20", "1000", "3", "102231");
  series.label = "direction 12";
  series.format = "DICOM";
  series.patientName = "Doe^Jane";
  series.studyDate = "20260314";
  series.studyDescription = "Head";
  series.modality = "MR";
  series.description = "T2";
  series.valueType = "uint16";
  series.path = "/data/a";
  series.acquired = turned(0, {1, 0, 0});
  series.regular = Series::Regular{series.acquired, 3, {}};
  series.warnings = {{"A slice is missing.", WarningKind::missingSlices}};
  const QString all = everythingOf(series).join(QLatin1Char('\n'));
  for (const char* part :
       {"Doe, Jane", "2026-03-14 Head", "MR T2", "28 slices, axial", "64 x 64 x 28, 1 x 1 x 4 mm",
        "in 3D 28 even slices, 3 of them interpolated", "TE 20 ms", "b 1000", "time point 3", "direction 12",
        "10:22:31", "DICOM, uint16", "/data/a", "! A slice is missing."})
    QVERIFY2(all.contains(QString::fromLatin1(part)), part);
  series.format = "NIfTI", series.path = "/data/brain.nii.gz", series.description = "FSL3.3";
  const QStringList file = everythingOf(series);
  QVERIFY(file.contains(QStringLiteral("MR brain.nii.gz")) && file.contains(QStringLiteral("FSL3.3")));
}

void TestSeriesText::framesAreNotWarnedOfTheirVolume() {
  Series series = with("", "", "", "10");
  series.warnings = {{"Not calibrated: no measurements in mm in 3D.", WarningKind::notCalibrated},
                     {"A pixel is 0.2 x 0.2 mm.", WarningKind::other}};
  const QString ofVolume = QStringLiteral("! Not calibrated: no measurements in mm in 3D."),
                ofFrames = QStringLiteral("! A pixel is 0.2 x 0.2 mm."), mark = QStringLiteral("! ");
  QCOMPARE(factsOf(series, series.warnings).filter(mark), (QStringList{ofVolume, ofFrames}));
  series.notVolume = "A picture.";
  QCOMPARE(factsOf(series, series.warnings).filter(mark), QStringList{ofFrames});
}

VOLUMEN_TEST(TestSeriesText);
#include "tst_series_text.moc"
