// Guards the corner texts of a view: patient and study, the acquired slice that a plane shows, and what
// remains if there is little room.
#include <cmath>

#include "io/study/frame_series.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "tests/unit/suite.h"
#include "ui/workspace/corner_text.h"

using namespace volumen;

namespace {

Series stack(glm::dvec3 i, glm::dvec3 j, int slices, double apart) {
  Series series;
  series.path = "/data/mr", series.id = "1.2";
  series.format = "DICOM", series.modality = "MR", series.description = "T1";
  series.patientName = "Doe^Jane", series.patientId = "7";
  series.studyDate = "20260314", series.studyTime = "102231.25";
  series.acquired.size = {64, 64, slices};
  series.acquired.patientFromVoxelStep = glm::dmat3(i, j, apart * glm::cross(i, j));
  for (int n = 0; n < slices; ++n) series.files.push_back(std::to_string(n));
  return series;
}

Series axial(int slices = 20, double apart = 3) { return stack({1, 0, 0}, {0, 1, 0}, slices, apart); }

}  // namespace

class TestCornerText : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void factsOfASeries_data();
  void factsOfASeries();
  void thicknessOfSlices_data();
  void thicknessOfSlices();
  void lossesByCompressionAreSaid_data();
  void lossesByCompressionAreSaid();
  void planesOfUnknownSidesClaimNone_data();
  void planesOfUnknownSidesClaimNone();
  void namesAreHidden();
  void whatMattersMostStays();
  void planesSaySliceNumbers_data();
  void planesSaySliceNumbers();
  void interpolatedSlicesLieBetweenAcquiredOnes();
  void usefulVolumes_data();
  void usefulVolumes();
};

void TestCornerText::factsOfASeries_data() {
  QTest::addColumn<Series>("series");
  QTest::addColumn<QStringList>("left");
  Series noAge = axial(), bornThatDay = axial(), newborn = axial(), minutes = axial(), nameless = axial();
  noAge.patientAge = "000Y", newborn.patientAge = "000D";
  bornThatDay.patientBirthDate = bornThatDay.studyDate;
  minutes.studyTime = "1200";
  nameless.patientName = "^^^^";
  Series nifti = axial();
  nifti.format = "NIfTI", nifti.path = "/data/brain.nii.gz", nifti.description = "FSL3.3";
  nifti.patientName.clear(), nifti.patientId.clear(), nifti.studyDate.clear(), nifti.modality.clear();
  Series woman = axial(), born = axial(), breast = axial(), undated = axial(), file = axial();
  woman.patientSex = "F", woman.patientAge = "045Y";
  born.patientBirthDate = "19800315";
  breast.laterality = "L", breast.viewPosition = "MLO";
  undated.studyDate.clear();
  file.format = "NRRD", file.path = "/data/head.nrrd", file.patientName.clear(), file.patientId.clear();
  file.studyDate.clear(), file.modality.clear(), file.description.clear();
  const QString jane = QStringLiteral("Doe, Jane (7)"), at = QStringLiteral("2026-03-14 10:22:31"),
                t1 = QStringLiteral("MR T1");
  QTest::newRow("date and time") << axial() << QStringList{jane, at, t1};
  QTest::newRow("sex and age") << woman << QStringList{jane, at, QStringLiteral("F, 45 y"), t1};
  QTest::newRow("the day before a birthday") << born << QStringList{jane, at, QStringLiteral("45 y"), t1};
  QTest::newRow("side and view") << breast << QStringList{jane, at, t1, QStringLiteral("L MLO")};
  QTest::newRow("no date") << undated << QStringList{jane, QStringLiteral("(no date)"), t1};
  QTest::newRow("no age") << noAge << QStringList{jane, at, t1};
  QTest::newRow("born on the day of the study") << bornThatDay << QStringList{jane, at, t1};
  QTest::newRow("less than a day old") << newborn << QStringList{jane, at, QStringLiteral("0 d"), t1};
  QTest::newRow("a time without seconds")
      << minutes << QStringList{jane, QStringLiteral("2026-03-14 12:00"), t1};
  QTest::newRow("carets alone are no name") << nameless << QStringList{QStringLiteral("7"), at, t1};
  QTest::newRow("a file is called by its name") << nifti << QStringList{QStringLiteral("brain.nii.gz")};
  QTest::newRow("a file without patients") << file << QStringList{QStringLiteral("head.nrrd")};
}

void TestCornerText::factsOfASeries() {
  QFETCH(Series, series);
  QFETCH(QStringList, left);
  QCOMPARE(seriesCorner(series).left(), left);
}

void TestCornerText::thicknessOfSlices_data() {
  QTest::addColumn<Series>("series");
  QTest::addColumn<QString>("text");
  Series thick = axial(), thin = axial(), uneven = axial(), one = axial(1);
  thick.sliceThickness = 3, thin.sliceThickness = 1, one.sliceThickness = 5;
  uneven.sliceThickness = 3, uneven.regular = Series::Regular{};
  QTest::newRow("not given") << axial() << QStringLiteral("3 mm apart");
  QTest::newRow("as the distance") << thick << QStringLiteral("3 mm thick");
  QTest::newRow("with gaps") << thin << QStringLiteral("1 mm thick, 3 mm apart");
  QTest::newRow("uneven distances") << uneven << QStringLiteral("3 mm thick, unevenly apart");
  QTest::newRow("one slice") << one << QStringLiteral("5 mm thick");
}

void TestCornerText::thicknessOfSlices() {
  QFETCH(Series, series);
  QTEST(thicknessText(series), "text");
}

void TestCornerText::lossesByCompressionAreSaid_data() {
  QTest::addColumn<std::optional<std::string>>("ratio");
  QTest::addColumn<QString>("text");
  using Ratio = std::optional<std::string>;
  QTest::newRow("none") << Ratio() << QString();
  QTest::newRow("a ratio") << Ratio("20") << QStringLiteral("Lossy 20:1");
  QTest::newRow("many digits") << Ratio("12.702") << QStringLiteral("Lossy 12.7:1");
  QTest::newRow("strong") << Ratio("2097") << QStringLiteral("Lossy 2097:1");
  QTest::newRow("two steps") << Ratio("20\\10") << QStringLiteral("Lossy 20:1, 10:1");
  QTest::newRow("no ratio") << Ratio("") << QStringLiteral("Lossy");
  QTest::newRow("no number") << Ratio("high") << QStringLiteral("Lossy");
}

void TestCornerText::lossesByCompressionAreSaid() {
  QFETCH(std::optional<std::string>, ratio);
  QFETCH(QString, text);
  Series series = axial();
  series.lossyRatio = ratio;
  QCOMPARE(lossyText(series), text);
}

void TestCornerText::planesOfUnknownSidesClaimNone_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<bool>("known");
  QTest::addColumn<double>("z");
  QTest::addColumn<QStringList>("right");
  QTest::addColumn<QString>("thickness");
  const auto row = [](const char* name, ViewKind kind, bool known, double z, const char* right,
                      const char* thickness) {
    QTest::newRow(name) << int(kind) << known << z << QString::fromLatin1(right).split(QLatin1Char('|'))
                        << QString::fromLatin1(thickness);
  };
  row("axial", ViewKind::axial, true, 30, "Axial|11 / 20|S 30.0 mm", "3 mm apart");
  row("axial at 0", ViewKind::axial, true, 0, "Axial|1 / 20|0 mm", "3 mm apart");
  row("sagittal", ViewKind::sagittal, true, 30, "Sagittal, reformatted|33 / 64|L 32.0 mm",
      "of axial slices, 3 mm apart");
  row("xy", ViewKind::axial, false, 30, "Plane xy|11 / 20|z 30.0 mm", "3 mm apart");
  row("yz", ViewKind::sagittal, false, 30, "Plane yz, reformatted|33 / 64|x 32.0 mm", "of slices 3 mm apart");
  row("xz", ViewKind::coronal, false, 30, "Plane xz, reformatted|33 / 64|y 32.0 mm", "of slices 3 mm apart");
}

void TestCornerText::planesOfUnknownSidesClaimNone() {
  QFETCH(int, kind);
  QFETCH(bool, known);
  QFETCH(double, z);
  QFETCH(QStringList, right);
  QFETCH(QString, thickness);
  Series series = axial();
  if (!known) series.warnings = {{"The header gives no directions.", WarningKind::noDirections}};
  VolumeParts parts;
  parts.geometry = series.acquired;
  parts.values = std::vector<std::uint8_t>(64 * 64 * 20);
  std::vector<std::string> changed;
  LoadedSeries shown;
  shown.series = series;
  shown.volume = *Volume::make(std::move(parts), changed);
  Workspace workspace;
  ViewState& view = workspace.editView(0);
  view.kind = ViewKind(kind);
  view.series = keyOf(series);
  workspace.series.editOrAdd(view.series).series = std::make_shared<const Series>(series);
  Crosshair crosshair = firstCrosshair(series);
  crosshair.at = {32, 32, z};
  workspace.crosshairs.editOrAdd(frameOfReference(series)) = crosshair;
  const SlicePlane plane = flatPlane(view, {}, series.acquired, crosshair, {100, 100});
  const CornerTexts texts = slicesCorner(workspace, 0, shown, plane);
  QCOMPARE(texts.right(), right);
  QCOMPARE(texts.left().last(), thickness);
}

void TestCornerText::namesAreHidden() {
  hideNames(true);
  const QStringList left = seriesCorner(axial()).left();
  hideNames(false);
  QCOMPARE(left.mid(0, 2), (QStringList{QStringLiteral("(name hidden)"), QStringLiteral("(date hidden)")}));
}

void TestCornerText::whatMattersMostStays() {
  Series woman = axial();
  woman.patientSex = "F";
  CornerTexts texts = seriesCorner(woman);
  texts.add(CornerItem::thickness, thicknessText(woman));
  texts.add(CornerItem::plane, QStringLiteral("Axial"));
  texts.add(CornerItem::position, QStringLiteral("S 3 mm"));
  texts.add(CornerItem::number, QStringLiteral("3 / 20"));
  texts.add(CornerItem::link, QString());
  QCOMPARE(texts.left().size(), 5);
  QCOMPARE(texts.left(3), (QStringList{QStringLiteral("Doe, Jane (7)"), QStringLiteral("2026-03-14 10:22:31"),
                                       QStringLiteral("MR T1")}));
  QCOMPARE(texts.right(),
           (QStringList{QStringLiteral("Axial"), QStringLiteral("3 / 20"), QStringLiteral("S 3 mm")}));
  QCOMPARE(texts.right(2), (QStringList{QStringLiteral("Axial"), QStringLiteral("3 / 20")}));
  QCOMPARE(texts.right(0), QStringList());
  woman.sliceThickness = 3;
  QCOMPARE(thicknessText(woman), QStringLiteral("3 mm thick"));
  woman.sliceThickness = 2;
  QCOMPARE(thicknessText(woman), QStringLiteral("2 mm thick, 3 mm apart"));
}

void TestCornerText::planesSaySliceNumbers_data() {
  QTest::addColumn<Series>("series");
  QTest::addColumn<int>("acquired");
  const double c = std::cos(0.5), s = std::sin(0.5);
  QTest::newRow("axial") << axial() << int(ViewKind::axial);
  QTest::newRow("sagittal") << stack({0, 1, 0}, {0, 0, -1}, 20, 3) << int(ViewKind::sagittal);
  QTest::newRow("coronal, oblique") << stack({c, s, 0}, {0, 0, -1}, 20, 3) << int(ViewKind::coronal);
  QTest::newRow("axial, oblique, feet first") << stack({-1, 0, 0}, {0, c, s}, 20, 3) << int(ViewKind::axial);
}

void TestCornerText::planesSaySliceNumbers() {
  QFETCH(Series, series);
  QFETCH(int, acquired);
  const VoxelGeometry& geometry = series.acquired;
  QCOMPARE(int(acquiredKind(geometry)), acquired);
  Crosshair crosshair = firstCrosshair(geometry);
  for (const ViewKind kind : {ViewKind::axial, ViewKind::coronal, ViewKind::sagittal}) {
    ViewState view;
    view.kind = kind;
    const auto number = [&](const Crosshair& at) {
      return planeNumber(series, geometry, kind, at, flatPlane(view, {}, geometry, at, {100, 100}));
    };
    if (int(kind) != acquired) {
      QVERIFY(number(crosshair).reformatted);
      continue;
    }
    for (const int slice : {0, 6, 19}) {
      Crosshair at = crosshair;
      at.at = geometry.patientFromVoxel({31, 30, slice});
      QVERIFY(!number(at).reformatted);
      QCOMPARE(number(at).text, QStringLiteral("%1 / 20").arg(slice + 1));
    }
    Crosshair between = crosshair;
    between.at = geometry.patientFromVoxel({31, 30, 6.5});
    QVERIFY(number(between).reformatted);
    QCOMPARE(number(between).text, QStringLiteral("between 7 and 8 / 20"));
    QVERIFY2(number(turnedIn(crosshair, kind == ViewKind::axial ? ViewKind::coronal : ViewKind::axial, 0.01))
                 .reformatted,
             "half a degree off");
  }
}

void TestCornerText::interpolatedSlicesLieBetweenAcquiredOnes() {
  Series series = axial(4);
  series.regular = Series::Regular{series.acquired, 2, {0, 1, -1, -1, 2, 3}};
  series.regular->geometry.size.z = 6;
  const VoxelGeometry& drawn = series.regular->geometry;
  ViewState view;
  view.kind = ViewKind::axial;
  const QStringList texts{QStringLiteral("1 / 4"),
                          QStringLiteral("2 / 4"),
                          QStringLiteral("between 2 and 3 / 4"),
                          QStringLiteral("between 2 and 3 / 4"),
                          QStringLiteral("3 / 4"),
                          QStringLiteral("4 / 4")};
  for (int k = 0; k < 6; ++k) {
    const Crosshair at{drawn.patientFromVoxel({31, 30, k})};
    const PlaneNumber number =
        planeNumber(series, drawn, view.kind, at, flatPlane(view, {}, drawn, at, {100, 100}));
    QCOMPARE(number.text, texts[k]);
    QCOMPARE(number.reformatted, k == 2 || k == 3);
  }
}

void TestCornerText::usefulVolumes_data() {
  QTest::addColumn<Series>("series");
  QTest::addColumn<bool>("useful");
  Series thin = axial(40, 10), picture = axial(20), placeless = axial(20, 30), thick = axial(7, 15);
  thin.sliceThickness = 1;
  thick.sliceThickness = 10;
  Series cubes = axial(20, 12);
  cubes.acquired.patientFromVoxelStep = glm::dmat3(12);
  picture.notVolume = "Colour.";
  placeless.acquired.calibrated = false;
  QTest::newRow("a stack") << axial() << true;
  QTest::newRow("four slices") << axial(4) << true;
  QTest::newRow("three slices") << axial(3) << false;
  QTest::newRow("one slice") << axial(1) << false;
  QTest::newRow("a localizer of seven") << axial(7, 15) << false;
  QTest::newRow("thick ones of it") << thick << false;
  QTest::newRow("cubes of 12 mm") << cubes << true;
  QTest::newRow("1 mm of every 10") << thin << false;
  QTest::newRow("pictures") << picture << false;
  QTest::newRow("without a place") << placeless << true;
}

void TestCornerText::usefulVolumes() {
  QFETCH(Series, series);
  QFETCH(bool, useful);
  QCOMPARE(isUsefulVolume(series), useful);
  QCOMPARE(opensAsPictures(series), !useful);
}

VOLUMEN_TEST(TestCornerText);
#include "tst_corner_text.moc"
