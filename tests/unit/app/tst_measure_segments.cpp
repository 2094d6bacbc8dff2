// Guards segment.md, "Read the numbers": `volumen measure --segments` and `volumen segment` report the same
// numbers for the segments of a file, over time too and in the requested unit of PET. Segments that cannot be
// measured are named.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <cmath>
#include <vector>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/segment_case.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestMeasureSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void numbersAreThoseOfSegment_data();
  void numbersAreThoseOfSegment();
  void numbersAreThoseOfTheVoxels();
  void everyKindOfFileIsMeasured_data();
  void everyKindOfFileIsMeasured();
  void anotherGridIsBroughtToThisOne();
  void petIsInTheUnitAskedFor_data();
  void petIsInTheUnitAskedFor();
  void aTimeInAnotherUnitHasNoValues();
  void shapesAreMeasuredBesides();
  void whatThereIsNoneOfIsSaid();
  void refused_data();
  void refused();

 private:
  QString at(const QString& name) const { return folder_->filePath(name); }
  /// Runs a command line in the folder.
  Outcome told(const QString& commandLine) const {
    return runProgramIn(folder_->path(), commandLine.split(QLatin1Char(' ')));
  }
  void write(const char* name, const QByteArray& bytes) const { writeBytes(at(QLatin1String(name)), bytes); }
  /// Writes 8 x 7 x 6 voxels of 2 x 2 x 2 mm: volumes of int16, or labels.
  void writeNrrd(const char* name, const std::vector<std::vector<std::int16_t>>& volumes) const;
  void writePetOfTwoTimes(bool isWeighedTwice) const;

  std::unique_ptr<QTemporaryDir> folder_;
};

namespace {

constexpr int voxelsOfNrrd = 8 * 7 * 6;

QJsonObject jsonIn(const Outcome& done) { return QJsonDocument::fromJson(done.out).object(); }

QJsonObject segmentIn(const Outcome& done, int n = 0) {
  return jsonIn(done)[QStringLiteral("segments")].toArray().at(n).toObject();
}

bool isAbout(const QJsonValue& value, double wanted) {
  return value.isDouble() && std::abs(value.toDouble() - wanted) <= 1e-5 * std::max(1.0, std::abs(wanted));
}

std::vector<std::int16_t> valuesByChance(std::uint64_t seed, int below) {
  Chance chance(seed);
  std::vector<std::int16_t> values(voxelsOfNrrd);
  for (std::int16_t& value : values) value = std::int16_t(chance.below(below));
  return values;
}

}  // namespace

void TestMeasureSegments::init() { folder_ = std::make_unique<QTemporaryDir>(); }

void TestMeasureSegments::writeNrrd(const char* name,
                                    const std::vector<std::vector<std::int16_t>>& volumes) const {
  const bool isOne = volumes.size() == 1;
  QByteArray bytes = "NRRD0005\ntype: int16\ndimension: " + QByteArray(isOne ? "3" : "4") +
                     "\nspace: left-posterior-superior\nsizes: 8 7 6" +
                     (isOne ? "" : ' ' + QByteArray::number(qsizetype(volumes.size()))) +
                     "\nspace directions: (2,0,0) (0,2,0) (0,0,2)" + (isOne ? "" : " none") +
                     "\nkinds: domain domain domain" + (isOne ? "" : " time") +
                     "\nspace origin: (0,0,0)\nendian: little\nencoding: raw\n\n";
  for (const std::vector<std::int16_t>& values : volumes)
    bytes.append(reinterpret_cast<const char*>(values.data()), qsizetype(values.size() * sizeof values[0]));
  write(name, bytes);
}

void TestMeasureSegments::numbersAreThoseOfSegment_data() {
  QTest::addColumn<QString>("data");  // empty for random volumes
  QTest::addColumn<int>("volumes");
  QTest::addColumn<QString>("range");
  const auto row = [](const char* name, const char* data, int volumes, const char* range) {
    QTest::newRow(name) << QString::fromLatin1(data) << volumes << QString::fromLatin1(range);
  };
  row("a volume by chance", "", 1, "300:800");
  row("volumes of a file", "", 3, "300:800");
  row("CT", "dicom-geometry/ct-tiny-23x38x3", 1, "0:");
  row("MR over time", "dicom-geometry/mr-fmri-ge-50", 2, "500:");
  row("echoes", "field-cases/c66h-echo-time", 3, "0:");
  row("PET", "field-cases/c28-suv-bqml", 1, "1000:");
}

void TestMeasureSegments::numbersAreThoseOfSegment() {
  QFETCH(QString, data);
  QFETCH(int, volumes);
  QFETCH(QString, range);
  QString path = QStringLiteral("scan.nrrd");
  if (data.isEmpty()) {
    std::vector<std::vector<std::int16_t>> all;
    for (int n = 0; n < volumes; ++n) all.push_back(valuesByChance(7 + std::uint64_t(n), 1000));
    writeNrrd("scan.nrrd", all);
  } else {
    const std::string real = dataPath(data.toStdString());
    NEED_DATA(real);
    path = QString::fromStdString(real);
  }
  const Outcome segment =
      told(QStringLiteral("segment %1 --range %2 --json --csv a.csv -o a.seg.nrrd").arg(path, range));
  QVERIFY2(segment.status == 0 && segmentIn(segment)[QStringLiteral("voxels")].toInt() > 0,
           segment.err.constData());
  const Outcome measure = told(QStringLiteral("measure %1 --segments a.seg.nrrd --csv b.csv").arg(path));
  QVERIFY2(measure.status == 0, measure.err.constData());
  QJsonObject wanted = jsonIn(segment);
  for (const char* own : {"recipe", "recipeUnit", "files"}) wanted.remove(QLatin1String(own));
  QJsonArray warnings;  // except the one about given values, which only a recipe has
  for (const QJsonValue& warning : wanted[QStringLiteral("warnings")].toArray())
    if (!warning.toString().startsWith(QLatin1String("Values that were given"))) warnings << warning;
  wanted[QStringLiteral("warnings")] = warnings;
  QCOMPARE(jsonIn(measure), wanted);
  QCOMPARE(wanted.contains(QStringLiteral("timeAxis")), volumes > 1);
  // The file keeps no range, so that the last column ("Made by") is empty.
  const auto numbersOf = [&](const QString& name) {
    QByteArrayList rows = contentsOf(at(name)).split('\n');
    for (QByteArray& row : rows) row.truncate(std::max<qsizetype>(0, row.lastIndexOf(',')));
    return rows;
  };
  QVERIFY(numbersOf(QStringLiteral("a.csv")).size() > 1);
  QCOMPARE(numbersOf(QStringLiteral("b.csv")), numbersOf(QStringLiteral("a.csv")));
}

void TestMeasureSegments::numbersAreThoseOfTheVoxels() {
  const auto first = valuesByChance(1, 1000), second = valuesByChance(2, 1000), labels = valuesByChance(3, 4);
  writeNrrd("scan.nrrd", {first, second});
  writeNrrd("labels.nrrd", {labels});
  const Outcome done = told(QStringLiteral("measure scan.nrrd --segments labels.nrrd"));
  QVERIFY2(done.status == 0, done.err.constData());
  QCOMPARE(jsonIn(done)[QStringLiteral("segments")].toArray().size(), 3);
  for (int label = 1; label <= 3; ++label) {
    const QJsonObject segment = segmentIn(done, label - 1);
    QCOMPARE(segment[QStringLiteral("number")].toInt(), label);
    const QJsonArray times = segment[QStringLiteral("timePoints")].toArray();
    QCOMPARE(times.size(), 2);
    for (int time = 0; time < 2; ++time) {
      double count = 0, sum = 0, low = 1000, high = 0;
      for (std::size_t n = 0; n < labels.size(); ++n) {
        if (labels[n] != label) continue;
        const double value = (time == 0 ? first : second)[n];
        count += 1, sum += value, low = std::min(low, value), high = std::max(high, value);
      }
      QVERIFY(isAbout(times[time][QStringLiteral("mean")], sum / count));
      QVERIFY(isAbout(times[time][QStringLiteral("min")], low));
      QVERIFY(isAbout(times[time][QStringLiteral("max")], high));
      QCOMPARE(segment[QStringLiteral("voxels")].toDouble(), count);
      QVERIFY(isAbout(segment[QStringLiteral("millilitres")], count * 0.008));
    }
    QCOMPARE(segment[QStringLiteral("mean")], times[0][QStringLiteral("mean")]);
  }
}

void TestMeasureSegments::everyKindOfFileIsMeasured_data() {
  QTest::addColumn<QString>("file");
  for (const char* file : {"a.seg.nrrd", "a.dcm", "a.nii.gz", "a.mha"})
    QTest::newRow(file) << QString::fromLatin1(file);
}

void TestMeasureSegments::everyKindOfFileIsMeasured() {
  QFETCH(QString, file);
  QCOMPARE(told(QStringLiteral("convert phantom:ramp:16 -o scans/")).status, 0);
  QCOMPARE(told(QStringLiteral("segment scans/ --range 3:5 -o ") + file).status, 0);
  const Outcome done = told(QStringLiteral("measure scans/ --segments ") + file);
  QVERIFY2(done.status == 0 && done.err.isEmpty(), done.err.constData());
  const QJsonObject segment = segmentIn(done);
  QCOMPARE(segment[QStringLiteral("name")].toString(), QStringLiteral("Range 3:5"));
  QCOMPARE(segment[QStringLiteral("voxels")].toInt(), 3 * 16 * 16);
  QVERIFY(isAbout(segment[QStringLiteral("millilitres")], 0.768));
  QVERIFY(isAbout(segment[QStringLiteral("mean")], 4));
  QVERIFY(isAbout(segment[QStringLiteral("max")], 5));
}

// The phantom is centred on the origin, so planes of 8 x 8 voxels in the middle are inside the smaller one.
void TestMeasureSegments::anotherGridIsBroughtToThisOne() {
  QCOMPARE(told(QStringLiteral("segment phantom:ramp:16 --range 6:7 -o a.seg.nrrd")).status, 0);
  const Outcome done = told(QStringLiteral("measure phantom:ramp:8 --segments a.seg.nrrd"));
  QVERIFY2(done.status == 0 && done.err.contains("0.512 ml became 0.128 ml"), done.err.constData());
  QCOMPARE(segmentIn(done)[QStringLiteral("voxels")].toInt(), 2 * 8 * 8);
  QCOMPARE(segmentIn(done)[QStringLiteral("mean")].toDouble(), 2.5);  // values 6 and 7 of the larger one
}

// Writes the PET of one time point and again 19 s later with values twice as large. Without the patient's
// weight the second has no SUV.
void TestMeasureSegments::writePetOfTwoTimes(bool isWeighedTwice) const {
  const QDir source(QString::fromStdString(dataPath("field-cases/c28-suv-bqml")));
  QVERIFY(QDir(folder_->path()).mkdir(QStringLiteral("pet")));
  for (const QString& name : source.entryList({QStringLiteral("*.dcm")}))
    for (const int time : {1, 2}) {
      DcmFileFormat file;
      QVERIFY(file.loadFile(OFFilename(source.filePath(name).toUtf8().constData())).good());
      DcmDataset& data = *file.getDataset();
      OFString instance, slope;
      QVERIFY(data.findAndGetOFString(DCM_SOPInstanceUID, instance).good() &&
              data.findAndGetOFString(DCM_RescaleSlope, slope).good());
      const QByteArray scaled = QByteArray::number(QByteArray(slope.c_str()).toDouble() * time),
                       uid = QByteArray(instance.c_str()) + '.' + QByteArray::number(time);
      data.putAndInsertString(DCM_SOPInstanceUID, uid.constData());
      data.putAndInsertString(DCM_RescaleSlope, scaled.constData());
      if (time == 2 && !isWeighedTwice) data.findAndDeleteElement(DCM_PatientWeight);
      data.putAndInsertString(DCM_FrameReferenceTime, time == 1 ? "1000" : "20000");
      const QString path = at(QStringLiteral("pet/%1-%2").arg(time).arg(name));
      QVERIFY(file.saveFile(OFFilename(path.toUtf8().constData()), EXS_LittleEndianExplicit).good());
    }
}

void TestMeasureSegments::petIsInTheUnitAskedFor_data() {
  QTest::addColumn<QString>("option");
  QTest::addColumn<QString>("unit");
  QTest::addColumn<double>("mean");
  QTest::newRow("not said") << QString() << QStringLiteral("SUVbw") << 0.584255;
  QTest::newRow("SUVbw") << QStringLiteral(" --unit SUVbw") << QStringLiteral("SUVbw") << 0.584255;
  QTest::newRow("of the file") << QStringLiteral(" --unit file") << QStringLiteral("Bq/ml") << 2000.0;
}

void TestMeasureSegments::petIsInTheUnitAskedFor() {
  NEED_DATA(dataPath("field-cases/c28-suv-bqml"));
  QFETCH(QString, option);
  QFETCH(QString, unit);
  QFETCH(double, mean);
  writePetOfTwoTimes(true);
  QCOMPARE(told(QStringLiteral("segment pet/ --range 1000: -o a.seg.nrrd")).status, 0);
  const Outcome done =
      told(QStringLiteral("measure pet/ --series 1 --segments a.seg.nrrd --csv a.csv") + option);
  QVERIFY2(done.status == 0, done.err.constData());
  const QJsonObject segment = segmentIn(done);
  QCOMPARE(jsonIn(done)[QStringLiteral("unit")].toString(), unit);
  QVERIFY2(isAbout(segment[QStringLiteral("mean")], mean), done.out.constData());
  QVERIFY(isAbout(segment[QStringLiteral("max")], mean) && isAbout(segment[QStringLiteral("peak")], mean));
  const QJsonArray times = segment[QStringLiteral("timePoints")].toArray();
  QCOMPARE(times.size(), 2);
  for (int time = 0; time < 2; ++time)
    QVERIFY(isAbout(times[time][QStringLiteral("mean")], (time + 1) * mean));
  QVERIFY(contentsOf(at(QStringLiteral("a.csv"))).contains('(' + unit.toUtf8() + ')'));
}

void TestMeasureSegments::aTimeInAnotherUnitHasNoValues() {
  NEED_DATA(dataPath("field-cases/c28-suv-bqml"));
  writePetOfTwoTimes(false);
  QCOMPARE(told(QStringLiteral("segment pet/ --range 1000: -o a.seg.nrrd")).status, 0);
  const auto meansIn = [&](const char* unit) {
    const Outcome done =
        told(QStringLiteral("measure pet/ --series 1 --segments a.seg.nrrd --unit ") + QLatin1String(unit));
    return segmentIn(done)[QStringLiteral("timePoints")].toArray();
  };
  const QJsonArray suv = meansIn("SUVbw"), file = meansIn("file");
  QVERIFY(suv.size() == 2 && file.size() == 2);
  QVERIFY(isAbout(suv[0][QStringLiteral("mean")], 0.584255));
  QVERIFY(suv[1][QStringLiteral("mean")].isNull());
  QVERIFY(isAbout(file[1][QStringLiteral("mean")], 4000));
}

void TestMeasureSegments::shapesAreMeasuredBesides() {
  write("shapes.json", R"([{"kind": "volume", "range": [2, 3]}])");
  QCOMPARE(told(QStringLiteral("segment phantom:ramp:8 --range 2:3 -o a.seg.nrrd")).status, 0);
  const Outcome done = told(QStringLiteral("measure phantom:ramp:8 --roi shapes.json --segments a.seg.nrrd"));
  QVERIFY2(done.status == 0, done.err.constData());
  const QJsonArray shapes = jsonIn(done)[QStringLiteral("measurements")].toArray();
  QCOMPARE(shapes.size(), 1);
  QCOMPARE(shapes[0][QStringLiteral("voxels")].toInt(), 128);
  QCOMPARE(segmentIn(done)[QStringLiteral("voxels")].toInt(), 128);
}

// A segment without voxels has no values, and a series without voxel size no lengths.
void TestMeasureSegments::whatThereIsNoneOfIsSaid() {
  QCOMPARE(told(QStringLiteral("segment phantom:ramp:8 --range 100:200 -o a.seg.nrrd")).status, 0);
  const Outcome empty = told(QStringLiteral("measure phantom:ramp:8 --segments a.seg.nrrd"));
  QVERIFY2(empty.status == 0 && empty.err.contains("Range 100:200: no voxel is in it."),
           empty.err.constData());
  QCOMPARE(segmentIn(empty)[QStringLiteral("voxels")].toInt(-1), 0);
  QVERIFY(segmentIn(empty)[QStringLiteral("mean")].isNull());
  write("scan.nrrd",
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" + QByteArray(64, '\7'));
  write("labels.nrrd",
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" + QByteArray(64, '\1'));
  const Outcome done = told(QStringLiteral("measure scan.nrrd --segments labels.nrrd"));
  QVERIFY2(
      done.status == 0 && done.err.contains("Not calibrated: segments have no lengths, areas and volumes."),
      done.err.constData());
  QVERIFY(!done.err.contains("lengths are in pixels"));
  QVERIFY(segmentIn(done)[QStringLiteral("millilitres")].isNull());
  QCOMPARE(segmentIn(done)[QStringLiteral("mean")].toDouble(), 7.0);
}

void TestMeasureSegments::refused_data() {
  QTest::addColumn<QString>("arguments");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("sentence");
  const auto row = [](const char* name, const char* arguments, int status, const char* sentence) {
    QTest::newRow(name) << QString::fromLatin1(arguments) << status << QByteArray(sentence);
  };
  row("nothing to measure", "scan.mha", 2, "Give --roi FILE, --segments FILE or both.");
  row("CSV of shapes", "scan.mha --roi shapes.json --csv a.csv", 2, "--csv goes with --segments FILE.");
  row("no unit", "scan.mha --segments a.seg.nrrd --unit SUV", 2, "--unit");
  row("no series", "none.mha --segments a.seg.nrrd", 1, "none.mha");
  row("no file", "scan.mha --segments none.seg.nrrd", 1, "none.seg.nrrd does not exist.");
  row("a folder", "scan.mha --segments folder", 1, "folder is no file that can be read.");
  row("text", "scan.mha --segments shapes.json", 1, "shapes.json");
  row("a picture", "scan.mha --segments values.nrrd", 1, "values.nrrd");
  row("elsewhere", "scan.mha --segments far.nrrd", 1,
      "far.nrrd: All of its segments lie outside the series.");
  row("an SUV of no PET", "scan.mha --segments a.seg.nrrd --unit SUVbw", 1, "it is no PET series.");
  row("no folder for the CSV", "scan.mha --segments a.seg.nrrd --csv none/a.csv", 1, "none/a.csv");
  row("over the segments", "scan.mha --segments a.seg.nrrd --csv a.seg.nrrd", 1, "it is a file that is read");
  row("over the table of names", "scan.mha --segments b.mha --csv b.label", 1, "it is a file that is read");
  row("over the series", "scan.mha --segments a.seg.nrrd --csv scan.mha", 1, "it is a file that is read");
  row("over the shapes", "scan.mha --segments a.seg.nrrd --roi shapes.json --csv ./shapes.json", 1,
      "it is a file that is read");
}

void TestMeasureSegments::refused() {
  QFETCH(QString, arguments);
  QFETCH(int, status);
  QFETCH(QByteArray, sentence);
  QCOMPARE(told(QStringLiteral("convert phantom:ramp:8 -o scan.mha")).status, 0);
  QCOMPARE(told(QStringLiteral("segment phantom:ramp:8 --range 2:3 -o a.seg.nrrd")).status, 0);
  QCOMPARE(told(QStringLiteral("segment phantom:ramp:8 --range 2:3 -o b.mha")).status, 0);
  QVERIFY(QDir(folder_->path()).mkdir(QStringLiteral("folder")));
  write("shapes.json", "[]");
  const QByteArray head =
      "NRRD0005\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 4\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nendian: little\nencoding: raw\n";
  write("far.nrrd", head + "type: uint8\nspace origin: (500,0,0)\n\n" + QByteArray(64, '\1'));
  write("values.nrrd",
        head + "type: float\nspace origin: (0,0,0)\n\n" + QByteArray("\0\0\0\x3f", 4).repeated(64));
  const QMap<QString, QByteArray> before = allFilesIn(folder_->path());
  QCOMPARE(before.size(), 7);
  const Outcome done = told(QStringLiteral("measure ") + arguments);
  QCOMPARE(done.status, status);
  QVERIFY2(done.err.contains(sentence) && done.out.isEmpty(), done.err.constData());
  QVERIFY(allFilesIn(folder_->path()) == before);
}

VOLUMEN_TEST(TestMeasureSegments);
#include "tst_measure_segments.moc"
