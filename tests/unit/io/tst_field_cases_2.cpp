// Guards import.md and slices.md on ../shared/data/field-cases-2 (its CASES.tsv says why).
#include <cmath>

#include "io/export/read_segments.h"
#include "io/frames.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/series_summary.h"
#include "tests/unit/suite.h"
#include "viewer/slice/grey.h"

using namespace volumen;
using namespace volumen::tests;

class TestFieldCases2 : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void picturesThatBelongTogether_data();
  void picturesThatBelongTogether();
  void singleFilesReadAsMeant_data();
  void singleFilesReadAsMeant();
  void namesReadAsMeant_data();
  void namesReadAsMeant();
  void aSigmoidInSmallLetters();
  void uptakeOfAnEnhancedPet();
  void segmentsOfFiles_data();
  void segmentsOfFiles();
  void aLabelMapIsNoVolume();
};

namespace {

/// Returns the study of a case by its folder or file; an empty one if it cannot be opened.
Study openCase(const QString& name) {
  const Result<Study> study = openStudy(dataPath("field-cases-2/" + name.toStdString()));
  return study ? *study : Study{};
}

}  // namespace

void TestFieldCases2::picturesThatBelongTogether_data() {
  QTest::addColumn<QStringList>("volumes");
  const auto row = [](const char* folder, const QStringList& volumes) { QTest::newRow(folder) << volumes; };
  const QString tenSlices = QStringLiteral("8x8x10 1,1,3 @0,0,0: 0,1,2,3,4,5,6,7,8,9");
  row("lo01d-localizer-on-the-line", {tenSlices, QStringLiteral("8x8x1 1,1,3 @0,0,30: 900; LOCALIZER")});
  row("lo01e-localizer-at-a-slice", {tenSlices, QStringLiteral("8x8x1 1,1,3 @0,0,12: 900; LOCALIZER")});
  row("mf16d-complex-component", {QStringLiteral("8x8x4 1,1,2 @0,0,0: 0,1,2,3; MAGNITUDE"),
                                  QStringLiteral("8x8x4 1,1,2 @0,0,0: 100,101,102,103; PHASE")});
  row("mx01b-two-thicknesses",
      {QStringLiteral("8x8x6 1,1,5 @0,0,0: 0,1,2,3,4,5; slice thickness 5 mm"),
       QStringLiteral("8x8x6 1,1,5 @0,0,2.5: 500,501,502,503,504,505; slice thickness 1 mm")});
  row("mx02c-before-and-after-contrast",
      {QStringLiteral("8x8x6 1,1,5 @0,0,0: 0,1,2,3,4,5; contrast not given"),
       QStringLiteral("8x8x6 1,1,5 @0,0,2.5: 500,501,502,503,504,505; contrast AGENT")});
  row("mx03-kernels-at-the-same-places",
      {QStringLiteral("8x8x6 1,1,5 @0,0,0: 0,1,2,3,4,5; kernel B30f"),
       QStringLiteral("8x8x6 1,1,5 @0,0,0: 500,501,502,503,504,505; kernel B70f")});
}

void TestFieldCases2::picturesThatBelongTogether() {
  NEED_DATA(dataPath());
  QFETCH(QStringList, volumes);
  QStringList found;
  for (const Series& s : openCase(QString::fromUtf8(QTest::currentDataTag())).volumes) found << summaryOf(s);
  QCOMPARE(found, volumes);
}

void TestFieldCases2::singleFilesReadAsMeant_data() {
  QTest::addColumn<QString>("volume");
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("ma02e-no-pixel-representation")
      << QStringLiteral("8x8x3 1,1,1 @0,0,0: -1000,-999,-998")
      << QByteArray("PixelRepresentation is missing: its values were read as signed");
  QTest::newRow("ni08-sform-of-zeros")
      << QStringLiteral("7x6x5 1,1,2 @-1,-2,3: 0,42,84,126,168") << QByteArray("the qform is taken");
}

void TestFieldCases2::singleFilesReadAsMeant() {
  NEED_DATA(dataPath());
  QFETCH(QString, volume);
  QFETCH(QByteArray, says);
  const Study study = openCase(QString::fromUtf8(QTest::currentDataTag()));
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(summaryOf(study.volumes[0]), volume);
  QVERIFY(warns(study.volumes[0].warnings, says.toStdString()));
}

void TestFieldCases2::namesReadAsMeant_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<bool>("told");
  QTest::newRow("ch07b-utf-8-as-latin-1") << QString::fromUtf8("Иванов^Пётр") << true;
  QTest::newRow("ch07e-latin-1-stays") << QString::fromUtf8("Müller^José") << false;
}

void TestFieldCases2::namesReadAsMeant() {
  NEED_DATA(dataPath());
  QFETCH(QString, name);
  QFETCH(bool, told);
  const Study study = openCase(QString::fromUtf8(QTest::currentDataTag()));
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(QString::fromStdString(study.volumes[0].patientName), name);
  QCOMPARE(warns(study.volumes[0].warnings,
                 "in UTF-8 under SpecificCharacterSet \"ISO_IR 100\": they were read as UTF-8"),
           told);
}

void TestFieldCases2::aSigmoidInSmallLetters() {
  NEED_DATA(dataPath());
  const Study study = openCase(QStringLiteral("vo01d-sigmoid-in-lower-case"));
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QVERIFY(warns(study.volumes[0].warnings, "\"sigmoid\" is no term of the standard: it was read as SIGMOID"));
  const auto frame = loadFrame(study.volumes[0], 0);
  QVERIFY(frame.ok());
  const auto bytes = greyBytes(std::vector<float>{352, 1104, 1472}, frame->greys.at(0).mapping);
  QCOMPARE(QList<int>(bytes.begin(), bytes.end()), (QList<int>{0, 3, 17}));
}

void TestFieldCases2::uptakeOfAnEnhancedPet() {
  NEED_DATA(dataPath());
  const Study study = openCase(QStringLiteral("pt07-enhanced-pet"));
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& pet = study.volumes[0];
  QVERIFY2(pet.suv.bodyWeight, pet.suv.why.c_str());
  const auto loaded = loadSeries(pet);
  QVERIFY(loaded.ok());
  const double bq = loaded->acquired->value(0, 0, 1);
  QCOMPARE(bq, 2002.0);
  QVERIFY(std::abs(bq * *pet.suv.bodyWeight - 0.584839) < 1e-6);
  QCOMPARE(valueScale(pet, PetUnit::file).unit, std::string("Bq/ml"));
}

void TestFieldCases2::segmentsOfFiles_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QStringList>("segments");  // empty if refused
  QTest::addColumn<QByteArray>("told");
  const auto row = [](const char* folder, const char* file, const QStringList& segments, const char* told) {
    QTest::newRow(folder) << QString::fromLatin1(file) << segments << QByteArray(told);
  };
  row("sg04-labelmap", "seg.dcm", {QStringLiteral("Alpha 42"), QStringLiteral("Beta 41")}, "");
  row("sg11b-frame-of-no-segment", "seg.dcm", {QStringLiteral("Alpha 27")},
      "is of a segment that it does not describe (2): left out.");
  row("nl02b-labels-off-by-rounding", "seg.nii.gz",
      {QStringLiteral("Label 1 42"), QStringLiteral("Label 2 42")},
      "labels are off whole numbers by up to 5e-05, and were rounded.");
  row("nl02f-value-between-labels", "seg.nii.gz", {}, "values that are no labels, such as 2.5:");
}

void TestFieldCases2::segmentsOfFiles() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(QStringList, segments);
  QFETCH(QByteArray, told);
  const QString name = QString::fromUtf8(QTest::currentDataTag());
  const Study study = openCase(name + QStringLiteral("/ct"));
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const std::string path = dataPath("field-cases-2/" + name.toStdString() + "/" + file.toStdString());
  const auto read = readSegments(path, study.volumes[0], study.volumes[0].acquired);
  if (segments.isEmpty()) {
    QVERIFY(!read);
    QVERIFY2(read.message().find(told) != std::string::npos, read.message().c_str());
    return;
  }
  QVERIFY2(read, read ? "" : read.message().c_str());
  QStringList found;
  for (const Segmented& map : read->maps) {
    const auto counts = labelCounts(map.labels);
    for (const Segment& segment : map.segments)
      found << QStringLiteral("%1 %2")
                   .arg(QString::fromStdString(segment.label))
                   .arg(counts[std::size_t(segment.number)]);
  }
  QCOMPARE(found, segments);
  QCOMPARE(read->notes.size(), std::size_t(!told.isEmpty()));
  if (!told.isEmpty()) QVERIFY2(read->notes[0].find(told) != std::string::npos, read->notes[0].c_str());
}

void TestFieldCases2::aLabelMapIsNoVolume() {
  NEED_DATA(dataPath());
  const Study study = openCase(QStringLiteral("sg04-labelmap"));
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.derived.size(), std::size_t(1));
  QCOMPARE(int(study.derived[0].kind), int(DerivedKind::segmentation));
  QCOMPARE(study.derived[0].pictures.size(), std::size_t(6));
  QCOMPARE(study.derived[0].notHere, std::size_t(0));
}

VOLUMEN_TEST(TestFieldCases2);
#include "tst_field_cases_2.moc"
