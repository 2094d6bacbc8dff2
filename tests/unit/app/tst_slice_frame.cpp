// Guards slices.md 2 and 5: `volumen slice --plane frame` writes values, colours and grey of pictures as
// acquired.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QImage>
#include <QTemporaryDir>
#include <cstring>

#include "io/frames.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/real_volume.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSliceFrame : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void picturesAreWrittenAsAcquired_data();
  void picturesAreWrittenAsAcquired();
  void aSliceOfASeriesIsItsFrame();
  void largePicturesTakeTwiceTheirPixels_data();
  void largePicturesTakeTwiceTheirPixels();
  void wrongUsageIsRefused_data();
  void wrongUsageIsRefused();

 private:
  QTemporaryDir folder_;
};

namespace {

// Returns a frame of a file's only picture as `io` loads it.
Result<Frame> frameOf(const std::string& path, int index) {
  const Result<Study> study = openStudy(path);
  if (!study) return study.error();
  return study->images.empty() ? loadFrame(study->volumes.at(0), index)
                               : loadFrame(study->images.front(), index);
}

QByteArray bytesBehindHeader(const QString& path) {
  const QByteArray all = contentsOf(path);
  return all.mid(all.indexOf("\n\n") + 2);
}

// Writes a radiograph in a process of its own: programs that are started count the memory of this one as
// theirs.
bool writeApart(const std::string& path, int edge) {
  const pid_t pid = fork();
  if (pid == 0) {
    DicomPicture picture{.columns = edge, .rows = edge, .orientation = ""};
    picture.pixels.resize(std::size_t(edge) * std::size_t(edge));
    for (std::size_t n = 0; n < picture.pixels.size(); ++n) picture.pixels[n] = std::uint16_t(n / 100 % 4096);
    picture.edit = [](DcmDataset& data) { data.findAndDeleteElement(DCM_ImagePositionPatient); };
    writeDicom(path, picture);
    _exit(0);
  }
  int status = -1;
  return pid > 0 && waitpid(pid, &status, 0) == pid && status == 0;
}

template <class T>
QByteArray bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), qsizetype(values.size() * sizeof(T))};
}

}  // namespace

void TestSliceFrame::picturesAreWrittenAsAcquired_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<int>("index");
  QTest::newRow("a chest, white on black") << QStringLiteral("cr-chest-mono1-jpeg8.dcm") << 0;
  QTest::newRow("teeth with a modality LUT") << QStringLiteral("cr-dental-mono1-modalitylut.dcm") << 0;
  QTest::newRow("a breast with a VOI LUT") << QStringLiteral("mg-sigmoid-voilut3.dcm") << 0;
  QTest::newRow("colours of a secondary capture") << QStringLiteral("sc-rgb-41.dcm") << 0;
  QTest::newRow("the last frame of a clip") << QStringLiteral("us-cine-aspect-regions.dcm") << 33;
  QTest::newRow("a clip with a palette") << QStringLiteral("us-palette-cine-10.dcm") << 4;
}

void TestSliceFrame::picturesAreWrittenAsAcquired() {
  QFETCH(QString, file);
  QFETCH(int, index);
  const std::string data = dataPath("dicom-2d/" + file.toStdString());
  NEED_DATA(data);
  const Result<Frame> frame = frameOf(data, index);
  QVERIFY2(frame, frame ? "" : frame.message().c_str());
  for (const char* name : {"frame.nrrd", "frame.png"}) {
    const QString out = folder_.filePath(QLatin1String(name));
    const Outcome done =
        runProgram({QStringLiteral("slice"), QString::fromStdString(data), QStringLiteral("--plane"),
                    QStringLiteral("frame"), QStringLiteral("--index"), QString::number(index),
                    QStringLiteral("-o"), out});
    QVERIFY2(done.status == 0, done.err.constData());
  }
  const QByteArray written = bytesBehindHeader(folder_.filePath(QStringLiteral("frame.nrrd")));
  QVERIFY(written == (frame->colour() ? bytesOf(frame->rgb) : bytesOf(frame->values.floats())));
  const QImage picture(folder_.filePath(QStringLiteral("frame.png")));
  QCOMPARE(picture.size(), QSize(frame->size.x, frame->size.y));
  const std::vector<std::uint8_t> grey =
      frame->colour() ? std::vector<std::uint8_t>()
                      : greyBytes(frame->values.floats(), frame->greys.front().mapping);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const std::size_t n = std::size_t(y) * std::size_t(picture.width()) + std::size_t(x);
      const QRgb expected = frame->colour()
                                ? qRgb(frame->rgb[3 * n], frame->rgb[3 * n + 1], frame->rgb[3 * n + 2])
                                : qRgb(grey[n], grey[n], grey[n]);
      if (picture.pixel(x, y) != expected) QFAIL(qPrintable(QStringLiteral("pixel %1, %2").arg(x).arg(y)));
    }
}

void TestSliceFrame::aSliceOfASeriesIsItsFrame() {
  const std::string data = dataPath("ct-chest-lidc0314-138");
  NEED_DATA(data);
  const VolumePtr chest = realVolume("ct-chest-lidc0314-138");
  const QString out = folder_.filePath(QStringLiteral("slice.nrrd"));
  const Outcome done = runProgram(
      {QStringLiteral("slice"), QString::fromStdString(data), QStringLiteral("--plane"),
       QStringLiteral("frame"), QStringLiteral("--index"), QStringLiteral("7"), QStringLiteral("-o"), out});
  QVERIFY2(done.status == 0, done.err.constData());
  std::vector<float> expected;
  const glm::ivec3 n = chest->size();
  for (int j = 0; j < n.y; ++j)
    for (int i = 0; i < n.x; ++i) expected.push_back(chest->value(i, j, 7));
  QVERIFY(bytesBehindHeader(out) == bytesOf(expected));
}

void TestSliceFrame::largePicturesTakeTwiceTheirPixels_data() {
  QTest::addColumn<QString>("plane");
  QTest::addColumn<QString>("name");
  for (const char* plane : {"frame", "axial"})
    for (const char* name : {"out.nrrd", "out.png"})
      QTest::addRow("%s, %s", plane, name) << QString::fromLatin1(plane) << QString::fromLatin1(name);
}

// Beside what a small picture takes.
void TestSliceFrame::largePicturesTakeTwiceTheirPixels() {
#ifdef __SANITIZE_ADDRESS__
  QSKIP("AddressSanitizer keeps freed memory");
#endif
  QFETCH(QString, plane);
  QFETCH(QString, name);
  constexpr int edge = 7000;
  const auto peakOf = [&](int size) {
    const std::string path = folder_.filePath(QString::number(size)).toStdString();
    if (!writeApart(path, size)) return -1.;
    const MeasuredOutcome run = runMeasured(
        {"slice", path, "--plane", plane.toStdString(), "-o", folder_.filePath(name).toStdString()});
    return run.status == 0 ? run.peakMebibytes : -1.;
  };
  const double small = peakOf(100), large = peakOf(edge);
  QVERIFY(small > 0 && large > 0);
  const double pixels = 2. * edge * edge / (1 << 20);
  QVERIFY2(large - small < 2 * pixels, qPrintable(QString::number((large - small) / pixels)));
}

void TestSliceFrame::wrongUsageIsRefused_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QString>("says");
  QTest::newRow("a slab of a frame") << QStringLiteral("--slab 5") << 2 << QStringLiteral("--plane frame");
  QTest::newRow("a frame's plane") << QStringLiteral("--print-plane") << 2 << QStringLiteral("--plane frame");
  QTest::newRow("no such frame") << QStringLiteral("--index 34") << 1 << QStringLiteral("34");
  QTest::newRow("no such picture") << QStringLiteral("--series 9") << 1 << QStringLiteral("9");
}

void TestSliceFrame::wrongUsageIsRefused() {
  QFETCH(QString, options);
  QFETCH(int, status);
  QFETCH(QString, says);
  const std::string data = dataPath("dicom-2d/us-cine-aspect-regions.dcm");
  NEED_DATA(data);
  const QString out = folder_.filePath(QStringLiteral("refused.png"));
  const Outcome done = runProgram(
      QStringLiteral("slice %1 --plane frame -o %2 %3").arg(QString::fromStdString(data), out, options));
  QCOMPARE(done.status, status);
  QVERIFY2(done.err.contains(says.toUtf8()), done.err.constData());
  QVERIFY(!QFile::exists(out));
}

VOLUMEN_TEST(TestSliceFrame);
#include "tst_slice_frame.moc"
