// Guards design.md 4: the meaning of a UID of several volumes in every command, and 4-D NIfTI.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <array>
#include <cmath>

#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/io/dicom_frames.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestConvertVolumes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void allVolumesOfASeriesAreWritten_data();
  void allVolumesOfASeriesAreWritten();
  void everyCommandSaysWhichItUses_data();
  void everyCommandSaysWhichItUses();
  void otherGridsAreRefused();
  void oneOfThemIsWrittenAlone();
  void diffusionWeightsStandBeside_data();
  void diffusionWeightsStandBeside();
  void directionsOfPhilipsAreKnown();
  void oneFileIsReadOnceForAllItsVolumes();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  QTemporaryDir folder_;
};

namespace {

constexpr const char* timePoints = "dicom-geometry/mr-fmri-ge-50";

Outcome run(const QString& command, const std::string& path, const std::string& series,
            const QString& output) {
  return runProgram({command, QString::fromStdString(path), QStringLiteral("--series"),
                     QString::fromStdString(series), QStringLiteral("-o"), output});
}

}  // namespace

void TestConvertVolumes::allVolumesOfASeriesAreWritten_data() {
  QTest::addColumn<QString>("name");
  QTest::newRow("time points") << QString::fromLatin1(timePoints);
  QTest::newRow("echoes") << QStringLiteral("field-cases/c66h-echo-time");
}

void TestConvertVolumes::allVolumesOfASeriesAreWritten() {
  QFETCH(QString, name);
  const std::string from = dataPath(name.toStdString());
  NEED_DATA(from);
  const auto source = openStudy(from);
  QVERIFY(source && source->volumes.size() > 1);
  const QString file = folder_.filePath(QString::number(name.size()) + QStringLiteral(".nii.gz"));
  const Outcome a = run(QStringLiteral("convert"), from, source->volumes[0].seriesUid, file);
  QVERIFY2(a.status == 0, a.err);
  QVERIFY2(a.err.contains(QByteArray::number(int(source->volumes.size())) + " volumes of series"), a.err);
  const auto copy = openStudy(file.toStdString());
  QVERIFY(copy);
  QCOMPARE(copy->volumes.size(), source->volumes.size());
  for (std::size_t n = 0; n < copy->volumes.size(); ++n) {
    const auto was = loadSeries(source->volumes[n]), is = loadSeries(copy->volumes[n]);
    QVERIFY(was && is && was->drawn->size() == is->drawn->size());
    for (std::size_t v = 0; v < std::size_t(is->drawn->geometry().voxelCount()); v += 7)
      QCOMPARE(is->drawn->valueAt(v), was->drawn->valueAt(v));
  }
}

void TestConvertVolumes::everyCommandSaysWhichItUses_data() {
  QTest::addColumn<QString>("command");
  QTest::addColumn<QString>("output");
  QTest::newRow("convert") << QStringLiteral("convert") << QStringLiteral("one.nrrd");
  QTest::newRow("slice") << QStringLiteral("slice") << QStringLiteral("one.png");
  QTest::newRow("render") << QStringLiteral("render") << QStringLiteral("one.png");
}

void TestConvertVolumes::everyCommandSaysWhichItUses() {
  QFETCH(QString, command);
  QFETCH(QString, output);
  const std::string from = dataPath(timePoints);
  NEED_DATA(from);
  const auto study = openStudy(from);
  QVERIFY(study && study->volumes.size() > 1);
  const std::string uid = study->volumes[0].seriesUid;
  const Outcome a = run(command, from, uid, folder_.filePath(output));
  QVERIFY2(a.status == 0, a.err);
  const QByteArray said = "Series " + QByteArray::fromStdString(uid) + " holds " +
                          QByteArray::number(int(study->volumes.size())) + " volumes; using number 1, \"";
  QVERIFY2(a.err.contains(said) && a.err.contains("Choose another with --series."), a.err);
  const Outcome byId = run(command, from, study->volumes[1].id, folder_.filePath(output));
  QVERIFY2(byId.status == 0 && !byId.err.contains("using number"), byId.err);
}

void TestConvertVolumes::otherGridsAreRefused() {
  const std::string from = dataPath("dicom-geometry/mr-qt2-multiecho-7");
  NEED_DATA(from);
  const auto study = openStudy(from);
  QVERIFY(study && study->volumes.size() > 1);
  const Outcome a = run(QStringLiteral("convert"), from, study->volumes[0].seriesUid, at("grids.nii.gz"));
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("does not lie on the grid of the first"), a.err);
  QVERIFY(!QFile::exists(at("grids.nii.gz")));
}

void TestConvertVolumes::oneOfThemIsWrittenAlone() {
  const std::string from = dataPath(timePoints);
  NEED_DATA(from);
  const QString file = at("alone.nii.gz");
  QCOMPARE(run(QStringLiteral("convert"), from, "2", file).status, 0);
  const auto copy = openStudy(file.toStdString());
  QVERIFY(copy);
  QCOMPARE(copy->volumes.size(), std::size_t(1));
}

namespace {

// Adds weight and direction as GE writes them. The third component points against the slices.
void putGeDiffusion(DcmDataset& data, int b, const double (&direction)[3]) {
  data.putAndInsertString(DcmTag(0x0043, 0x0010, EVR_LO), "GEMS_PARM_01");
  data.putAndInsertString(DcmTag(0x0043, 0x1039, EVR_IS), (QByteArray::number(b) + "\\8\\0\\0").constData());
  data.putAndInsertString(DcmTag(0x0019, 0x0010, EVR_LO), "GEMS_ACQU_01");
  for (Uint16 axis = 0; axis < 3; ++axis)
    data.putAndInsertString(DcmTag(0x0019, Uint16(0x10bb + axis), EVR_DS),
                            QByteArray::number(axis == 2 ? -direction[axis] : direction[axis]).constData());
}

}  // namespace

void TestConvertVolumes::diffusionWeightsStandBeside_data() {
  QTest::addColumn<bool>("isOfGe");
  QTest::newRow("of DICOM") << false;
  QTest::newRow("of GE") << true;
}

// Five slices each of b 0, 500 and 1000, with gradients along x and z.
void TestConvertVolumes::diffusionWeightsStandBeside() {
  QFETCH(bool, isOfGe);
  for (const char* made : {"one", "dwi"}) QDir(at(made)).removeRecursively();
  QVERIFY(QDir().mkpath(at("dwi")));
  QCOMPARE(runProgram({QStringLiteral("convert"), QStringLiteral("phantom:sphere:8"), QStringLiteral("-o"),
                       at("one/")})
               .status,
           0);
  const double directions[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  for (const QString& name : QDir(at("one")).entryList(QDir::Files))
    for (int n = 0; n < 3; ++n) {
      DcmFileFormat file;
      QVERIFY(file.loadFile(OFFilename(QDir(at("one")).filePath(name).toUtf8().constData())).good());
      DcmDataset& data = *file.getDataset();
      data.putAndInsertString(DCM_Modality, "MR");
      OFString uid;
      data.findAndGetOFString(DCM_SOPInstanceUID, uid);
      data.putAndInsertString(DCM_SOPInstanceUID, (uid.substr(0, 50) + "." + char('1' + n)).c_str());
      if (isOfGe) putGeDiffusion(data, 500 * n, directions[n]);
      if (!isOfGe) data.putAndInsertFloat64(DCM_DiffusionBValue, 500 * n);
      if (!isOfGe && n > 0) data.putAndInsertFloat64Array(DCM_DiffusionGradientOrientation, directions[n], 3);
      const QString to = at("dwi/") + QString::number(n) + name;
      QVERIFY(file.saveFile(OFFilename(to.toUtf8().constData()), EXS_LittleEndianExplicit).good());
    }
  const auto study = openStudy(at("dwi").toStdString());
  QVERIFY(study);
  QCOMPARE(study->volumes.size(), std::size_t(3));
  const Outcome a =
      run(QStringLiteral("convert"), at("dwi").toStdString(), study->volumes[0].seriesUid, at("dwi.nii.gz"));
  QVERIFY2(a.status == 0, a.err);
  QCOMPARE(contentsOf(at("dwi.bval")), QByteArray("0 500 1000\n"));
  // Left in DICOM is right in NIfTI. FSL flips the first axis again if the axes are right-handed.
  QCOMPARE(contentsOf(at("dwi.bvec")), QByteArray("0 -1 0\n0 0 0\n0 0 1\n"));
}

// Philips stores directions in private elements in patient space. The grid is rotated by 20 degrees about z.
void TestConvertVolumes::directionsOfPhilipsAreKnown() {
  const std::string from = dataPath("field-cases-2/di02b-philips-directions/mr");
  NEED_DATA(from);
  const auto study = openStudy(from);
  QVERIFY(study && study->volumes.size() == 6);
  const Outcome a = run(QStringLiteral("convert"), from, study->volumes[0].seriesUid, at("philips.nii.gz"));
  QVERIFY2(a.status == 0, a.err);
  const QList<QByteArray> weights = contentsOf(at("philips.bval")).trimmed().split(' ');
  QList<QList<QByteArray>> along;  // along voxel axes i (flipped), j and k
  for (const QByteArray& line : contentsOf(at("philips.bvec")).trimmed().split('\n'))
    along << line.split(' ');
  QVERIFY(weights.size() == 6 && along.size() == 3);
  const double turn = 20 * std::acos(-1.0) / 180;
  QStringList found;
  for (qsizetype n = 0; n < 6; ++n) {
    const double i = -along[0][n].toDouble(), j = along[1][n].toDouble(), k = along[2][n].toDouble();
    const double x = i * std::cos(turn) - j * std::sin(turn), y = i * std::sin(turn) + j * std::cos(turn);
    const auto text = [](double v) { return QString::number(std::round(1000 * v) / 1000 + 0.0); };
    found << QString::fromLatin1(weights[n]) + QStringLiteral(": %1,%2,%3").arg(text(x), text(y), text(k));
  }
  found.sort();
  QCOMPARE(
      found,
      QStringLiteral("0: 0,0,0|1000: -0.48,0.6,0.64|1000: 0,1,0|1000: 0.6,0,0.8|1000: 1,0,0|2000: 0,0.6,-0.8")
          .split(QLatin1Char('|')));
}

namespace {

// Counts how often any program opens a file.
class OpenCount {
 public:
  explicit OpenCount(const QString& path) {
    inotify_add_watch(events_, path.toLocal8Bit().constData(), IN_OPEN);
  }
  ~OpenCount() { close(events_); }
  int take() const {
    int opens = 0;
    alignas(inotify_event) std::array<char, 4096> part{};
    for (ssize_t got; (got = read(events_, part.data(), part.size())) > 0;)
      for (ssize_t at = 0; at < got; ++opens)
        at += ssize_t(sizeof(inotify_event)) +
              ssize_t(reinterpret_cast<const inotify_event*>(part.data() + at)->len);
    return opens;
  }

 private:
  const int events_ = inotify_init1(IN_NONBLOCK);
};

// Writes frames of two positions at each of `count` time points.
void writeTimePoints(const QString& path, int count) {
  DicomPicture picture{.orientation = "", .spacing = ""};
  picture.edit = [count](DcmDataset& data) {
    makeFrames(data, 2 * count);
    data.findAndDeleteElement(DCM_ImagePositionPatient);
    group(data, -1, DCM_PlaneOrientationSequence)
        .putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
    group(data, -1, DCM_PixelMeasuresSequence).putAndInsertString(DCM_PixelSpacing, "1\\1");
    for (int n = 0; n < 2 * count; ++n) {
      const char* place = n % 2 ? "0\\0\\3" : "0\\0\\0";
      group(data, n, DCM_PlanePositionSequence).putAndInsertString(DCM_ImagePositionPatient, place);
      group(data, n, DCM_FrameContentSequence)
          .putAndInsertUint32(DCM_TemporalPositionIndex, Uint32(1 + n / 2));
    }
  };
  writeDicom(path.toStdString(), picture);
}

}  // namespace

// Another volume opens the file once more, for its pixels. The program keeps no header otherwise, as the file
// has just been written.
void TestConvertVolumes::oneFileIsReadOnceForAllItsVolumes() {
  int opens[2];
  for (const int more : {0, 1}) {
    const QString path = at(more ? "thirty.dcm" : "ten.dcm");
    writeTimePoints(path, more ? 30 : 10);
    const OpenCount count(path);
    const Outcome a = run(QStringLiteral("convert"), path.toStdString(), "1.2.3.4.5", at("opened.nii.gz"));
    QVERIFY2(a.status == 0 && a.err.contains(more ? "30 volumes" : "10 volumes"), a.err);
    opens[more] = count.take();
  }
  QVERIFY2(opens[0] > 0 && opens[1] - opens[0] <= 20,
           qPrintable(QStringLiteral("%1 and %2").arg(opens[0]).arg(opens[1])));
}

VOLUMEN_TEST(TestConvertVolumes);
#include "tst_convert_volumes.moc"
