// Guards slices.md 5 (`volumen slice`): planes by options, written values and grey, and messages about them.
#include <QFile>
#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <cmath>
#include <cstring>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestSliceCommand : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void printsThePlane_data();
  void printsThePlane();
  void writesTheValues();
  void writesGrey_data();
  void writesGrey();
  void thePictureSaysWhatItShows();
  void theFilesWindowCounts();
  void warningsStandInThePicture();
  void wrongUsageIsRefused_data();
  void wrongUsageIsRefused();
  void whatTheVolumeRefuses_data();
  void whatTheVolumeRefuses();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  QTemporaryDir folder_;
};

namespace {

Outcome runSlice(const QString& line) { return runProgram(QStringLiteral("slice ") + line); }

// Returns the values of a .nrrd of W x H floats.
std::vector<float> floatsOf(const QString& path) {
  const QByteArray all = contentsOf(path);
  const qsizetype begin = all.indexOf("\n\n") + 2;
  std::vector<float> values(std::size_t(all.size() - begin) / 4);
  std::memcpy(values.data(), all.constData() + begin, values.size() * 4);
  return values;
}

}  // namespace

// Writes a volume of 4 x 3 x 2 bytes 0 to 23 with voxels of 2 x 1 x 5 mm. i points to the left, j to the
// back, k to the head.
void TestSliceCommand::initTestCase() {
  QFile file(at("small.nrrd"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(
      "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 3 2\n"
      "space directions: (2,0,0) (0,1,0) (0,0,5)\nspace origin: (100,200,300)\nencoding: raw\n\n");
  for (char n = 0; n < 24; ++n) file.putChar(n);
}

void TestSliceCommand::printsThePlane_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<QString>("plane");
  const auto row = [](const char* name, const char* options, const char* plane) {
    QTest::newRow(name) << QString::fromLatin1(options) << QString::fromLatin1(plane);
  };
  // The centre is (103, 201, 302.5), the box 8 x 3 x 10 mm.
  row("default", "",
      R"({"centre": [103, 201, 302.5], "right": [1, 0, 0], "down": [0, 1, 0], "mmPerPixel": 1, "size": [8, 3],
          "slabMm": 0, "slabMode": "max", "interpolation": "linear", "average": false})");
  row("coronal", "--plane coronal", R"({"right": [1, 0, 0], "down": [0, 0, -1], "size": [8, 10]})");
  row("sagittal", "--plane sagittal", R"({"right": [0, 1, 0], "down": [0, 0, -1], "size": [3, 10]})");
  row("at z", "--at 299.5", R"({"centre": [103, 201, 299.5]})");
  row("at y", "--plane coronal --at 200", R"({"centre": [103, 200, 302.5]})");
  row("at x", "--plane sagittal --at 1e2", R"({"centre": [100, 201, 302.5]})");
  row("slice 0", "--index 0", R"({"centre": [103, 201, 300]})");
  row("slice 1", "--index 1", R"({"centre": [103, 201, 305]})");
  row("a picture about another centre still covers the box", "--centre 1,-2,303.5",
      R"({"centre": [1, -2, 303.5], "size": [212, 409]})");
  row("directions are made unit vectors", "--right 0,3,0 --down 0,0,-0.1",
      R"({"right": [0, 1, 0], "down": [0, 0, -1], "size": [3, 10]})");
  row("larger pixels cover it, too", "--mm-per-pixel 2", R"({"mmPerPixel": 2, "size": [4, 2]})");
  row("size", "--size 17x9", R"({"mmPerPixel": 1, "size": [17, 9]})");
  row("slab", "--slab 4 --slab-mode mean --interpolation cubic --average",
      R"({"slabMm": 4, "slabMode": "mean", "interpolation": "cubic", "average": true})");
}

void TestSliceCommand::printsThePlane() {
  QFETCH(QString, options);
  QFETCH(QString, plane);
  const Outcome a = runSlice(at("small.nrrd") + QStringLiteral(" --print-plane ") + options);
  QVERIFY2(a.status == 0, a.err);
  QCOMPARE(a.err, QByteArray());
  const QJsonObject is = QJsonDocument::fromJson(a.out).object(),
                    should = QJsonDocument::fromJson(plane.toUtf8()).object();
  QCOMPARE(is.size(), 9);
  QVERIFY(!should.isEmpty());
  for (const QString& key : should.keys()) QCOMPARE(is[key], should[key]);
}

void TestSliceCommand::writesTheValues() {
  const QString file = at("values.nrrd");
  const Outcome a = runSlice(
      QStringLiteral("%1 --mm-per-pixel 2 --size 6x2 --centre 103,201,305 --interpolation nearest -o %2")
          .arg(at("small.nrrd"), file));
  QVERIFY2(a.status == 0, a.err);
  QCOMPARE(a.out, file.toUtf8() + '\n');
  QVERIFY(contentsOf(file).contains("\nsizes: 6 2\n"));
  // Position in the patient: the centre of the first pixel and the steps to the next ones.
  QVERIFY(contentsOf(file).contains("\nspace: left-posterior-superior\n"));
  QVERIFY(contentsOf(file).contains("\nspace directions: (2,0,0) (0,2,0)\n"));
  QVERIFY(contentsOf(file).contains("\nspace origin: (98,200,305)\n"));
  // Two pixels of six lie outside. The rows are at j = 0 and j = 2.
  const std::vector<float> values = floatsOf(file);
  QCOMPARE(values.size(), std::size_t(12));
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 6; ++x) {
      const float value = values[std::size_t(y * 6 + x)];
      if (x == 0 || x == 5)
        QVERIFY(std::isnan(value));
      else
        QCOMPARE(value, float(12 + y * 8 + x - 1));
    }
}

void TestSliceCommand::writesGrey_data() {
  QTest::addColumn<QString>("window");
  QTest::addColumn<QList<int>>("greys");  // greys of the values 0, 1, 2, 3
  QTest::newRow("from 1 to 3: exact, for no DICOM") << QStringLiteral("2,2") << QList<int>{0, 0, 128, 255};
  QTest::newRow("narrow") << QStringLiteral("1.5,0.01") << QList<int>{0, 0, 255, 255};
  QTest::newRow("below 0") << QStringLiteral("-1,10") << QList<int>{153, 179, 204, 230};
}

void TestSliceCommand::writesGrey() {
  QFETCH(QString, window);
  QFETCH(QList<int>, greys);
  const Outcome a =
      runSlice(QStringLiteral("%1 --mm-per-pixel 2 --size 6x1 --centre 103,200,300 --window %2 -o %3")
                   .arg(at("small.nrrd"), window, at("grey.png")));
  QVERIFY2(a.status == 0, a.err);
  const QImage image(at("grey.png"));
  QCOMPARE(image.size(), QSize(6, 1));
  QVERIFY(image.isGrayscale());
  QList<int> is;
  for (int x = 0; x < 6; ++x) is << qGray(image.pixel(x, 0));
  QCOMPARE(is, QList<int>{0} + greys + QList<int>{0});
}

void TestSliceCommand::thePictureSaysWhatItShows() {
  const Outcome a = runSlice(QStringLiteral("%1 --plane coronal --window 10,20 --print-plane -o %2")
                                 .arg(at("small.nrrd"), at("said.png")));
  QVERIFY2(a.status == 0, a.err);
  QCOMPARE(a.err, at("said.png").toUtf8() + '\n');
  const QImage image(at("said.png"));
  QVERIFY(image.text(QStringLiteral("Software")).startsWith(QLatin1String("volumen ")));
  QCOMPARE(QJsonDocument::fromJson(image.text(QStringLiteral("volumen-plane")).toUtf8()),
           QJsonDocument::fromJson(a.out));
  QCOMPARE(image.text(QStringLiteral("volumen-window")), QStringLiteral("LINEAR_EXACT 10.0,20.0"));
  QVERIFY(image.text(QStringLiteral("volumen-warnings")).isEmpty());
}

// Uses the window that convert writes into DICOM. Integers from it use LINEAR.
void TestSliceCommand::theFilesWindowCounts() {
  QCOMPARE(runProgram(QStringLiteral("convert phantom:ct-head:32 -o %1/").arg(at("dicom"))).status, 0);
  QVERIFY(runSlice(QStringLiteral("%1 -o %2").arg(at("dicom"), at("first.png"))).status == 0);
  const QString text = QImage(at("first.png")).text(QStringLiteral("volumen-window"));
  QVERIFY2(text.startsWith(QLatin1String("LINEAR ")), qPrintable(text));
  QVERIFY(runSlice(QStringLiteral("%1 --window 40,0.5 -o %2").arg(at("dicom"), at("narrow.png"))).status ==
          0);
  QCOMPARE(QImage(at("narrow.png")).text(QStringLiteral("volumen-window")),
           QStringLiteral("LINEAR_EXACT 40.0,0.5"));
}

void TestSliceCommand::warningsStandInThePicture() {
  QFile file(at("bare.nrrd"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" + QByteArray(64, '\x7f'));
  file.close();
  const QString line = at("bare.nrrd") + QStringLiteral(" --size 300x200 %1 -o %2");
  QCOMPARE(runSlice(line.arg(QString(), at("with.png"))).status, 0);
  QCOMPARE(runSlice(line.arg(QStringLiteral("--no-warning-line"), at("without.png"))).status, 0);
  const QImage with(at("with.png")), without(at("without.png"));
  QVERIFY(with.convertToFormat(QImage::Format_RGB32) != without.convertToFormat(QImage::Format_RGB32));
  for (const QImage& image : {with, without})
    QVERIFY(image.text(QStringLiteral("volumen-warnings")).startsWith(QStringLiteral("notCalibrated: ")));
}

void TestSliceCommand::wrongUsageIsRefused_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* options, const char* sentence) {
    QTest::newRow(options) << QString::fromLatin1(options) << QString::fromLatin1(sentence);
  };
  row("", "Missing output file");
  row("-o a.jpg", "written as .png");
  row("-o a.png --plane axail", "is not one of axial, coronal, sagittal");
  row("-o a.png --slabmode max", "Did you mean --slab-mode?");
  row("-o a.png --slab-mode max", "--slab-mode requires --slab.");
  row("-o a.png --slab -1", "--slab");
  row("-o a.png --interpolation spline", "linear, nearest, cubic");
  row("-o a.png --at 1 --index 2", "does not go with");
  row("-o a.png --at 1 --centre 1,2,3", "does not go with");
  row("-o a.png --index 1 --centre 1,2,3", "does not go with");
  row("-o a.png --index -1", "--index");
  row("-o a.png --right 1,0,0", "--right requires --down");
  row("-o a.png --down 1,0,0", "--down requires --right");
  row("-o a.png --plane axial --right 1,0,0 --down 0,1,0", "does not go with");
  row("-o a.png --right 1,0,0 --down 0.01,1,0", "right angle");
  row("-o a.png --right 0,0,0 --down 0,1,0", "directions");
  row("-o a.png --centre 1,2", "3 numbers");
  row("-o a.png --centre 1,2,3,4", "3 numbers");
  row("-o a.png --centre 1,nan,3", "3 numbers");
  row("-o a.png --window 40", "2 numbers");
  row("-o a.png --window 40,0", "width must be above 0");
  row("-o a.png --size 12", "WIDTHxHEIGHT");
  row("-o a.png --size 99999x99999", "99999 x 99999 pixels");
  row("-o a.png --mm-per-pixel 0", "--mm-per-pixel");
}

// Refuses at once, before it looks for the volume, which does not exist.
void TestSliceCommand::wrongUsageIsRefused() {
  QFETCH(QString, options);
  QFETCH(QString, sentence);
  const Outcome a = runSlice(QStringLiteral("/no/such/volume.nrrd ") + options);
  QCOMPARE(a.status, 2);
  QVERIFY2(a.err.contains(sentence.toUtf8()), a.err);
  QVERIFY(a.out.isEmpty());
}

void TestSliceCommand::whatTheVolumeRefuses_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* options, const char* sentence) {
    QTest::newRow(options) << QString::fromLatin1(options) << QString::fromLatin1(sentence);
  };
  row("--index 2", "the slices are 0 to 1");
  row("--plane coronal --index 0", "not parallel to the slices");
  row("--mm-per-pixel 1e-6", "cannot be drawn");
  row("--series 9", "9");
}

void TestSliceCommand::whatTheVolumeRefuses() {
  QFETCH(QString, options);
  QFETCH(QString, sentence);
  const QString file = at("none.png");
  const Outcome a = runSlice(QStringLiteral("%1 %2 -o %3").arg(at("small.nrrd"), options, file));
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains(sentence.toUtf8()), a.err);
  QVERIFY(!QFile::exists(file));
}

VOLUMEN_TEST(TestSliceCommand);
#include "tst_slice_command.moc"
