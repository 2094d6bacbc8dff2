// Guards that too little memory is told before anything is read, by both figures, and kills nobody: under
// ulimit and in a control group, by the command line.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDir>
#include <QFile>
#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <numeric>

#include "io/worker/sandbox.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/scarce_memory.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

namespace {

constexpr quint64 mebi = 1 << 20;
constexpr const char* outputs[] = {"out.png", "out.nrrd", "out.nii.gz", "out.seg.nrrd", "out.json"};

}  // namespace

class TestShortMemory : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init();
  void tooLittleIsTold_data();
  void tooLittleIsTold();
  void a3dPictureIsDrawnOfAReducedCopy_data();
  void a3dPictureIsDrawnOfAReducedCopy();
  void whatFitsHasTheSameBytes_data();
  void whatFitsHasTheSameBytes();
  void anImportNeedsNoVolume_data();
  void anImportNeedsNoVolume();
  void aSeriesOfManyFilesTakesLittle();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  QStringList words(const QString& line) const;
  // Runs the program with so many MiB beyond what it takes for nothing.
  Outcome runWith(ScarceMemory::By by, int mebibytes, const QString& line);
  void addWays(const std::function<void(ScarceMemory::By, const char*)>& add) const;

  QTemporaryDir folder_;
  quint64 taken_[2] = {};  // by the program itself, in each way
};

// 64 million voxels of 16 bits, 128 MiB: bone is everywhere (big), or in one slice (thin). Where nothing is,
// files take no room on the disk.
void TestShortMemory::initTestCase() {
  if (volumen::worker::sanitized) QSKIP("sanitizers reserve more than any limit");
  constexpr int pixels = 512 * 512;
  const auto write = [&](const char* name, int slices, const std::vector<int>& withBone) {
    QFile header(at(name) + QStringLiteral(".nhdr")), values(at(name) + QStringLiteral(".raw"));
    QVERIFY(header.open(QIODevice::WriteOnly) && values.open(QIODevice::ReadWrite));
    header.write("NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 512 512 " +
                 QByteArray::number(slices) +
                 "\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\n"
                 "endian: little\ndata file: " +
                 name + ".raw\n");
    QVERIFY(values.resize(qint64(slices) * pixels * 2));
    std::vector<qint16> bone(pixels);
    for (int n = 0; n < pixels; n += 4) bone[std::size_t(n)] = 1000;
    for (const int slice : withBone) {
      QVERIFY(values.seek(qint64(slice) * pixels * 2));
      values.write(reinterpret_cast<const char*>(bone.data()), qint64(pixels * sizeof(bone[0])));
    }
  };
  std::vector<int> all(256);
  std::iota(all.begin(), all.end(), 0);
  write("big", 256, all);
  write("thin", 256, {100});
  write("huge", 8192, {});
  DicomPicture radiograph{.columns = 8000, .rows = 8000, .orientation = "", .pixels = {100}};
  radiograph.edit = [](DcmDataset& data) {
    data.putAndInsertString(DCM_SOPClassUID, UID_DigitalXRayImageStorageForPresentation);
    data.putAndInsertString(DCM_Modality, "DX");
    data.findAndDeleteElement(DCM_ImagePositionPatient);
  };
  writeDicom(at("radiograph.dcm").toStdString(), radiograph);
  QFile recipe(at("recipe.json"));
  QVERIFY(recipe.open(QIODevice::WriteOnly));
  recipe.write(R"({"volumenRecipe": 1, "name": "Bone", "segments": [{"name": "Bone"}],
      "steps": [{"step": "range", "segment": "Bone", "low": 500}]})");
  QFile scene(at("bone.json"));
  QVERIFY(scene.open(QIODevice::WriteOnly));
  scene.write(R"({"volumenScene": 1, "transferFunction": {"points": [
      {"value": 500, "colour": [1, 1, 1], "opacity": 0}, {"value": 600, "colour": [1, 1, 1], "opacity": 0.5}]}})");
  QFile shapes(at("shapes.json"));
  QVERIFY(shapes.open(QIODevice::WriteOnly));
  shapes.write(R"([{"kind": "length", "points": [[0, 0, 0], [10, 0, 0]]}])");
}

void TestShortMemory::init() {
  for (const char* name : outputs) QFile::remove(at(name));
  QDir(at("out")).removeRecursively();
}

QStringList TestShortMemory::words(const QString& line) const {
  QStringList all;
  for (const QString& word : line.split(QLatin1Char(' ')))
    all << (word.startsWith(QLatin1String("IN/")) ? folder_.filePath(word.mid(3)) : word);
  return all;
}

Outcome TestShortMemory::runWith(ScarceMemory::By by, int mebibytes, const QString& line) {
  const ScarceMemory memory(by);
  quint64& taken = taken_[int(by)];
  if (taken == 0) {
    constexpr quint64 some = 1000 * mebi;
    const Outcome a =
        runProgram(words(QStringLiteral("slice IN/huge.nhdr -o IN/out.png")), memory.limit(some));
    const auto left =
        QRegularExpression(QStringLiteral(R"(and (\d+) MiB are)")).match(QString::fromUtf8(a.err));
    taken = left.hasMatch() ? some - left.captured(1).toULongLong() * mebi : some;
  }
  return runProgram(words(line), memory.limit(taken + quint64(mebibytes) * mebi));
}

void TestShortMemory::addWays(const std::function<void(ScarceMemory::By, const char*)>& add) const {
  add(ScarceMemory::By::addressSpace, "ulimit -v");
  add(ScarceMemory::By::controlGroup, "control group");
}

void TestShortMemory::tooLittleIsTold_data() {
  QTest::addColumn<ScarceMemory::By>("by");
  QTest::addColumn<int>("mebibytes");
  QTest::addColumn<QString>("line");
  const auto row = [&](const char* name, int mebibytes, const char* line) {
    addWays([&](ScarceMemory::By by, const char* way) {
      QTest::addRow("%s, %s", name, way) << by << mebibytes << QString::fromLatin1(line);
    });
  };
  row("render", 120, "render IN/big.nhdr --preset CT-Bone --size 32x32 -o IN/out.png --stats IN/out.json");
  row("slice", 120, "slice IN/big.nhdr -o IN/out.png");
  row("render, a turntable", 120,
      "render IN/big.nhdr --preset CT-Bone --size 32x32 --turntable 3 -o IN/out.png --stats IN/out.json");
  row("slice, a frame as acquired", 120, "slice IN/radiograph.dcm -o IN/out.png");
  row("measure", 120, "measure IN/big.nhdr --roi IN/shapes.json");
  row("convert", 120, "convert IN/big.nhdr -o IN/out.nrrd");
  row("convert, compressed", 120, "convert IN/big.nhdr -o IN/out.nii.gz");
  row("convert to DICOM", 120, "convert IN/big.nhdr -o IN/out/");
  row("segment, not even read", 120, "segment IN/big.nhdr --range 500: -o IN/out.seg.nrrd");
  row("segment, the values alone fit", 250, "segment IN/big.nhdr --range 500: -o IN/out.seg.nrrd");
  row("segment, a recipe", 120, "segment IN/big.nhdr --recipe IN/recipe.json -o IN/out.seg.nrrd");
  row("info, values", 120, "info IN/big.nhdr --values");
  row("accuracy", 120, "accuracy IN/big.nhdr --preset CT-Bone --size 32x32 -o IN/out");
  row("bench", 120, "bench IN/big.nhdr --preset CT-Bone --size 32x32");
  row("bench, the values alone fit", 400, "bench IN/big.nhdr --preset CT-Bone --size 32x32");
}

void TestShortMemory::tooLittleIsTold() {
  QFETCH(ScarceMemory::By, by);
  QFETCH(int, mebibytes);
  QFETCH(QString, line);
  if (!ScarceMemory(by).isPossible()) QSKIP("control groups of version 1 cannot be made here");
  const Outcome a = runWith(by, mebibytes, line);
  QVERIFY2(a.status == 1, QByteArray::number(a.status) + a.err);
  const QRegularExpression figures(QStringLiteral(R"([\d.]+ [MG]iB.* and [\d.]+ [MG]iB are available)"));
  QVERIFY2(figures.match(QString::fromUtf8(a.err)).hasMatch(), a.err);
  QVERIFY2(a.out.isEmpty() || line.startsWith(QLatin1String("info")), a.out);
  for (const char* name : outputs) QVERIFY2(!QFile::exists(at(name)), name);
  QVERIFY(QDir(at("out")).isEmpty());
}

void TestShortMemory::a3dPictureIsDrawnOfAReducedCopy_data() {
  QTest::addColumn<ScarceMemory::By>("by");
  addWays([](ScarceMemory::By by, const char* way) { QTest::newRow(way) << by; });
}

void TestShortMemory::a3dPictureIsDrawnOfAReducedCopy() {
  QFETCH(ScarceMemory::By, by);
  if (!ScarceMemory(by).isPossible()) QSKIP("control groups of version 1 cannot be made here");
  const QString line = QStringLiteral("render IN/big.nhdr --preset CT-Bone --size 300x300 -o IN/out.png");
  const Outcome a = runWith(by, 330, line + QStringLiteral(" --stats IN/out.json"));
  QVERIFY2(a.status == 0, QByteArray::number(a.status) + a.err);
  QVERIFY2(
      a.err.contains("reduced copy: each voxel is the mean of 2 x 2 x 2") && a.err.contains("are available"),
      a.err);
  const QImage picture(at("out.png"));
  QVERIFY(picture.text(QStringLiteral("volumen-warnings"))
              .startsWith(QStringLiteral("reduced: Drawn from a reduced copy")));
  const QJsonObject stats = QJsonDocument::fromJson(contentsOf(at("out.json"))).object();
  QCOMPARE(stats[QLatin1String("reducedBy")].toInt(), 2);
  QVERIFY(stats[QLatin1String("warnings")].toArray().last().toString().startsWith(
      QLatin1String("Drawn from a reduced")));
  const QJsonObject bytes = stats[QLatin1String("bytes")].toObject();
  QCOMPARE(bytes[QLatin1String("volume")].toInteger(), qint64(256 * 256 * 128 * 2));
  QVERIFY(bytes[QLatin1String("gradients")].toInteger() < 5 * bytes[QLatin1String("volume")].toInteger());
  // The corner says it, too.
  QCOMPARE(runWith(by, 330, line + QStringLiteral(" --no-warning-line")).status, 0);
  QVERIFY(picture != QImage(at("out.png")));
}

void TestShortMemory::whatFitsHasTheSameBytes_data() {
  QTest::addColumn<ScarceMemory::By>("by");
  QTest::addColumn<int>("mebibytes");
  QTest::addColumn<QString>("line");
  addWays([](ScarceMemory::By by, const char* way) {
    QTest::addRow("lit, %s", way) << by << 950
                                  << QStringLiteral(
                                         "render IN/big.nhdr --preset CT-Bone --size 64x64 -o IN/out.png");
    QTest::addRow("gradients of what is visible alone, %s", way)
        << by << 330 << QStringLiteral("render IN/thin.nhdr --scene IN/bone.json --size 64x64 -o IN/out.png");
    QTest::addRow("unlit, no gradients, %s", way)
        << by << 330
        << QStringLiteral("render IN/big.nhdr --preset CT-Bone --mode mip --size 64x64 -o IN/out.png");
    QTest::addRow("slice, %s", way) << by << 330
                                    << QStringLiteral("slice IN/big.nhdr --index 100 -o IN/out.png");
  });
}

void TestShortMemory::whatFitsHasTheSameBytes() {
  QFETCH(ScarceMemory::By, by);
  QFETCH(int, mebibytes);
  QFETCH(QString, line);
  if (!ScarceMemory(by).isPossible()) QSKIP("control groups of version 1 cannot be made here");
  QCOMPARE(runProgram(words(line)).status, 0);
  const QByteArray whole = contentsOf(at("out.png"));
  init();
  const Outcome a = runWith(by, mebibytes, line);
  QVERIFY2(a.status == 0 && a.err.isEmpty(), QByteArray::number(a.status) + a.err);
  QCOMPARE(contentsOf(at("out.png")), whole);
}

void TestShortMemory::anImportNeedsNoVolume_data() {
  QTest::addColumn<ScarceMemory::By>("by");
  addWays([](ScarceMemory::By by, const char* way) { QTest::newRow(way) << by; });
}

// Headers and a slice for the thumbnail take little of a volume of 4 GiB.
void TestShortMemory::anImportNeedsNoVolume() {
  QFETCH(ScarceMemory::By, by);
  if (!ScarceMemory(by).isPossible()) QSKIP("control groups of version 1 cannot be made here");
  QDir(at("index")).removeRecursively();
  const Outcome a = runWith(by, 100, QStringLiteral("import IN/huge.nhdr --index IN/index --json"));
  QVERIFY2(a.status == 0 && a.out.contains("\"new\": 1"), a.out + a.err);
  const Outcome listed = runProgram(words(QStringLiteral("list --index IN/index")));
  QVERIFY2(listed.out.contains("huge.nhdr"), listed.out + listed.err);
}

// A header takes about 5 KiB while its series is sorted, nearly three times as much if each stage copies it.
void TestShortMemory::aSeriesOfManyFilesTakesLittle() {
  constexpr int files = 10'000;
  QVERIFY(QDir().mkpath(at("series")));
  DicomPicture picture{.pixels = {100}};
  for (picture.instance = 1; picture.instance <= files; ++picture.instance) {
    picture.position.z = picture.instance;
    writeDicom(folder_.filePath(QStringLiteral("series/%1").arg(picture.instance)).toStdString(), picture);
  }
  const Outcome a = runWith(ScarceMemory::By::addressSpace, 130, QStringLiteral("info IN/series --json"));
  QVERIFY2(a.status == 0 && a.err.isEmpty(), QByteArray::number(a.status) + a.err);
  QCOMPARE(QJsonDocument::fromJson(a.out).object()[QLatin1String("volumes")].toArray().size(), 1);
}

VOLUMEN_TEST(TestShortMemory);
#include "tst_short_memory.moc"
