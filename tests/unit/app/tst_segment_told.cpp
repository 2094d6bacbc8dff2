// Guards design.md 8 (segment): reports about a series besides its segments. These are values of the same
// voxels at each time point, and a warning if the recipe is for other series.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <fstream>
#include <functional>

#include "io/open.h"
#include "results/series/time_points.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentTold : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void valuesOverTimeAreThoseOfEachVolume_data();
  void valuesOverTimeAreThoseOfEachVolume();
  void oneVolumeHasNoneOverTime();
  void contrastThatIsNotNamedIsSaid_data();
  void contrastThatIsNotNamedIsSaid();
  void recipesForOtherModalitiesAreSaid();
  void notesAndUnitsAreInTheJson();
  void theJsonSaysWhoseNumbersItHas_data();
  void theJsonSaysWhoseNumbersItHas();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  Outcome segment(const QString& series, const QStringList& how) const {
    return runProgram(QStringList{QStringLiteral("segment"), series, QStringLiteral("-o"), at("a.seg.nrrd"),
                                  QStringLiteral("--json")} +
                      how);
  }
  std::string fourVolumes() const;
  void writeSlice(const std::function<void(DcmDataset&)>& change) const;
  void writeRecipe(const char* name, const QByteArray& recipe) const;

  QTemporaryDir folder_;
};

namespace {

// A recipe of one range for CT with contrast agent.
constexpr const char* brightRecipe =
    R"({"volumenRecipe": 1, "name": "Bright", "modalities": ["CT"], "contrast": true,
        "segments": [{"name": "A"}], "steps": [{"step": "range", "segment": "A", "low": 0}]})";

// Returns the numbers of the only segment.
QJsonObject numbersIn(const Outcome& done) {
  return QJsonDocument::fromJson(done.out)[QStringLiteral("segments")].toArray().at(0).toObject();
}

QString timeAxisIn(const Outcome& done) {
  return QJsonDocument::fromJson(done.out)[QStringLiteral("timeAxis")].toString();
}

}  // namespace

// Writes volumes of 8 x 8 x 8 voxels. In the n-th one a voxel has the value n (x + 2 y) + z.
std::string TestSegmentTold::fourVolumes() const {
  const std::string path = at("four.nrrd").toStdString();
  std::ofstream file(path, std::ios::binary);
  file << "NRRD0005\ntype: int16\ndimension: 4\nspace: left-posterior-superior\nsizes: 8 8 8 4\n"
          "space directions: (2,0,0) (0,2,0) (0,0,2) none\nkinds: domain domain domain time\n"
          "space origin: (0,0,0)\nendian: little\nencoding: raw\n\n";
  for (int n = 1; n <= 4; ++n)
    for (int voxel = 0; voxel < 8 * 8 * 8; ++voxel) {
      const auto value = std::int16_t(n * (voxel % 8 + 2 * (voxel / 8 % 8)) + voxel / 64);
      file.write(reinterpret_cast<const char*>(&value), sizeof value);
    }
  return path;
}

void TestSegmentTold::valuesOverTimeAreThoseOfEachVolume_data() {
  QTest::addColumn<QString>("data");
  QTest::addColumn<QString>("axis");
  QTest::newRow("volumes of a file") << QString() << QStringLiteral("Volume");
  QTest::newRow("time points") << QStringLiteral("dicom-geometry/mr-fmri-ge-50") << QStringLiteral("Volume");
  QTest::newRow("echoes") << QStringLiteral("field-cases/c66h-echo-time") << QStringLiteral("Echo time (ms)");
}

// Values over time equal those that each volume alone gives for the same voxels, whichever was segmented.
void TestSegmentTold::valuesOverTimeAreThoseOfEachVolume() {
  QFETCH(QString, data);
  QFETCH(QString, axis);
  const std::string path = data.isEmpty() ? fourVolumes() : dataPath(data.toStdString());
  NEED_DATA(path);
  const auto study = openStudy(path);
  QVERIFY(study && study->volumes.size() > 1);
  std::vector<const Series*> steps;
  for (const Series& series : study->volumes) steps.push_back(&series);
  sortTimePoints(steps);
  const auto told = [&](const Series& series, const QStringList& how) {
    return segment(QString::fromStdString(path),
                   QStringList{QStringLiteral("--series"), QString::fromStdString(series.id)} + how);
  };
  const Outcome first = told(*steps.back(), {QStringLiteral("--range"), QStringLiteral("8:")});
  QVERIFY2(first.status == 0 && timeAxisIn(first) == axis, first.err.constData());
  const QJsonArray points = numbersIn(first)[QStringLiteral("timePoints")].toArray();
  QCOMPARE(std::size_t(points.size()), steps.size());
  for (int n = 0; n < int(points.size()); ++n) {
    const Outcome alone = told(*steps[std::size_t(n)], {QStringLiteral("--from"), at("a.seg.nrrd")});
    const QJsonObject numbers = numbersIn(alone), point = points[n].toObject();
    QVERIFY(timeAxisIn(alone) == axis && numbers[QStringLiteral("voxels")].toInt() > 0);
    QVERIFY(numbers[QStringLiteral("timePoints")].toArray() == points);
    for (const char* what : {"mean", "sd", "min", "max"})
      QCOMPARE(point[QLatin1String(what)].toDouble(-1), numbers[QLatin1String(what)].toDouble(-2));
    if (n > 0) QVERIFY(point[QStringLiteral("mean")] != points[n - 1].toObject()[QStringLiteral("mean")]);
    if (data.isEmpty()) QCOMPARE(point[QStringLiteral("at")].toInt(), n + 1);
  }
}

void TestSegmentTold::oneVolumeHasNoneOverTime() {
  const Outcome done =
      segment(QStringLiteral("phantom:ramp:8"), {QStringLiteral("--range"), QStringLiteral("2:3")});
  QCOMPARE(numbersIn(done)[QStringLiteral("voxels")].toInt(), 128);
  QVERIFY(!done.out.contains("timeAxis") && !done.out.contains("timePoints"));
}

// Writes "a.dcm", a slice of 8 x 8 pixels as the program writes it, with a change.
void TestSegmentTold::writeSlice(const std::function<void(DcmDataset&)>& change) const {
  const QTemporaryDir folder;
  const QString slices = folder.filePath(QStringLiteral("slices/"));
  QCOMPARE(
      runProgram({QStringLiteral("convert"), QStringLiteral("phantom:ramp:8"), QStringLiteral("-o"), slices})
          .status,
      0);
  const QString first = slices + QDir(slices).entryList(QDir::Files).value(0);
  DcmFileFormat file;
  QVERIFY(file.loadFile(OFFilename(first.toUtf8().constData())).good());
  DcmDataset& data = *file.getDataset();
  data.putAndInsertString(DCM_Modality, "CT");
  change(data);
  QVERIFY(file.saveFile(OFFilename(at("a.dcm").toUtf8().constData()), EXS_LittleEndianExplicit).good());
}

void TestSegmentTold::writeRecipe(const char* name, const QByteArray& recipe) const {
  QFile file(at(name));
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(recipe) == recipe.size());
}

void TestSegmentTold::contrastThatIsNotNamedIsSaid_data() {
  QTest::addColumn<QByteArray>("agent");
  QTest::addColumn<QByteArray>("code");
  QTest::addColumn<QByteArray>("description");
  QTest::addColumn<bool>("said");
  const QByteArray none, chest("Chest");
  QTest::newRow("nothing") << none << none << chest << true;
  QTest::newRow("none") << QByteArray("NONE") << none << chest << true;
  QTest::newRow("the description says none") << none << none << QByteArray("Chest w/o contrast") << true;
  QTest::newRow("an agent") << QByteArray("IOHEXOL 350") << none << chest << false;
  QTest::newRow("a code") << none << QByteArray("Iohexol") << chest << false;
  QTest::newRow("the description says so") << none << none << QByteArray("Chest with contrast") << false;
}

// Only a recipe for series with contrast agent reports its absence.
void TestSegmentTold::contrastThatIsNotNamedIsSaid() {
  QFETCH(QByteArray, agent);
  QFETCH(QByteArray, code);
  QFETCH(QByteArray, description);
  QFETCH(bool, said);
  writeSlice([&](DcmDataset& data) {
    data.putAndInsertString(DCM_SeriesDescription, description.constData());
    data.putAndInsertString(DCM_ContrastBolusAgent, agent.constData());
    if (code.isEmpty()) return;
    DcmItem* item = nullptr;
    QVERIFY(data.findOrCreateSequenceItem(DCM_ContrastBolusAgentSequence, item, -2).good());
    item->putAndInsertString(DCM_CodeMeaning, code.constData());
  });
  writeRecipe("contrast.json", brightRecipe);
  writeRecipe("plain.json", QByteArray(brightRecipe).replace("\"contrast\": true,", ""));
  const Outcome plain = segment(at("a.dcm"), {QStringLiteral("--recipe"), at("plain.json")}),
                contrast = segment(at("a.dcm"), {QStringLiteral("--recipe"), at("contrast.json")});
  QVERIFY2(plain.status == 0 && !plain.err.contains("contrast agent"), plain.err.constData());
  QVERIFY2(contrast.status == 0, contrast.err.constData());
  QVERIFY2(contrast.err.contains("The header names no contrast agent: the recipe \"Bright\"") == said,
           contrast.err.constData());
}

// A file other than DICOM has no header with modality or agent, so there is no warning.
void TestSegmentTold::recipesForOtherModalitiesAreSaid() {
  writeSlice([](DcmDataset& data) { data.putAndInsertString(DCM_Modality, "MR"); });
  writeRecipe("contrast.json", brightRecipe);
  const QStringList how{QStringLiteral("--recipe"), at("contrast.json")};
  const Outcome other = segment(at("a.dcm"), how), none = segment(QString::fromStdString(fourVolumes()), how);
  QVERIFY2(other.status == 0 && other.err.contains("The recipe \"Bright\" is for CT, the series is MR"),
           other.err.constData());
  QVERIFY2(none.status == 0 && !none.err.contains("Bright"), none.err.constData());
}

// The JSON holds the messages of stderr and the unit of each segment's values.
void TestSegmentTold::notesAndUnitsAreInTheJson() {
  const std::string path = fourVolumes();
  for (const QString& how : {QStringLiteral("5000:"), QStringLiteral("1:5")}) {
    const Outcome a = segment(QString::fromStdString(path), {QStringLiteral("--range"), how});
    QVERIFY2(a.status == 0, a.err);
    const QJsonObject all = QJsonDocument::fromJson(a.out).object();
    QByteArray told;
    for (const QJsonValue& warning : all[QStringLiteral("warnings")].toArray())
      told += "volumen: " + warning.toString().toUtf8() + "\n";
    QCOMPARE(told, a.err);
    QVERIFY(!a.err.isEmpty());
    QCOMPARE(numbersIn(a)[QStringLiteral("unit")], all[QStringLiteral("unit")]);
  }
}

void TestSegmentTold::theJsonSaysWhoseNumbersItHas_data() {
  QTest::addColumn<QString>("line");
  QTest::newRow("segments that are made") << QStringLiteral("segment %1/a.dcm --range 2:3 --json");
  QTest::newRow("shapes") << QStringLiteral("measure %1/a.dcm --roi %1/shapes.json");
}

void TestSegmentTold::theJsonSaysWhoseNumbersItHas() {
  QFETCH(QString, line);
  writeSlice([](DcmDataset& data) {
    data.putAndInsertString(DCM_PatientName, "Doe^Jane");
    data.putAndInsertString(DCM_PatientID, "7");
    data.putAndInsertString(DCM_StudyDate, "20260314");
    data.putAndInsertString(DCM_SeriesNumber, "3");
    data.putAndInsertString(DCM_SeriesDescription, "Thorax");
    data.putAndInsertString(DCM_SeriesInstanceUID, "1.2.3");
  });
  writeRecipe("shapes.json", R"([{"kind": "length", "points": [[0, 0, 0], [3, 4, 0]]}])");
  const Outcome done = runProgram(line.arg(at("")));
  QVERIFY2(done.status == 0, done.err);
  const QJsonObject of = QJsonDocument::fromJson(done.out)[QStringLiteral("of")].toObject();
  const QStringList found{
      of[QStringLiteral("patient")].toString(),       of[QStringLiteral("patient_id")].toString(),
      of[QStringLiteral("study_date")].toString(),    of[QStringLiteral("series")].toString(),
      of[QStringLiteral("series_number")].toString(), of[QStringLiteral("series_uid")].toString()};
  QCOMPARE(found.join(QLatin1Char('|')), QStringLiteral("Doe, Jane|7|2026-03-14|CT Thorax (3)|3|1.2.3"));
}

VOLUMEN_TEST(TestSegmentTold);
#include "tst_segment_told.moc"
