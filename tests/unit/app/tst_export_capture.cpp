// Guards export.md: `volumen export --as sc` holds the pictures of `volumen render` and `volumen slice`
// pixel for pixel and says how they were made. `--as pdf` holds the bytes of a document. Both lie in the
// source's study.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QCryptographicHash>
#include <QDir>
#include <QDirIterator>
#include <QImage>
#include <QTemporaryDir>
#include <cstring>
#include <set>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestExportCapture : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void renderingsAreThoseOfRender_data();
  void renderingsAreThoseOfRender();
  void turnsAreThoseOfRender();
  void slicesAreThoseOfSlice();
  void identityIsLeftOut();
  void documentsComeBack();
  void wrongWordsAreUsage_data();
  void wrongWordsAreUsage();
  void anEmptyOutputIsUsage();
  void whatCannotBeIsSaid_data();
  void whatCannotBeIsSaid();

 private:
  QString at(const QString& name) const { return folder_.filePath(name); }
  QTemporaryDir folder_;
};

namespace {

Outcome pictureBy(const QString& command, const QString& path, const QString& options,
                  const QString& output) {
  QStringList words = {command, path, QStringLiteral("-o"), output};
  return runProgram(words + options.split(QLatin1Char(' '), Qt::SkipEmptyParts));
}

// Returns the pixels of a PNG as RGB, 3 bytes each.
std::vector<std::uint8_t> rgbOfPng(const QString& png) {
  const QImage image = QImage(png).convertToFormat(QImage::Format_RGB888);
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < image.height(); ++y)
    bytes.insert(bytes.end(), image.constScanLine(y), image.constScanLine(y) + 3 * image.width());
  return bytes;
}

QString hashOf(const QString& text) {
  return QString::fromLatin1(QCryptographicHash::hash(text.toUtf8(), QCryptographicHash::Sha256).toHex());
}

}  // namespace

void TestExportCapture::renderingsAreThoseOfRender_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("options");
  QTest::addColumn<QString>("face");
  const auto row = [](const char* name, const char* path, const char* options, const char* face) {
    QTest::newRow(name) << QString::fromLatin1(path) << QString::fromLatin1(options)
                        << QString::fromLatin1(face);
  };
  row("CT", "ct-chest-lidc0314-138", "--preset CT-Bone --size 61x47", "NO");
  row("without the table", "ct-chest-lidc0314-138", "--remove-table --size 40x40 --view left", "NO");
  row("MR of a head shows a face", "mr-head-ge-mprage-130", "--view left --size 64x64 --quality high", "YES");
  row("a scene of its own", "mr-head-ge-mprage-130", "--projection perspective --size 33x64", "YES");
  row("PET, a projection", "pet-ct/sts019-pet", "--mode mip --size 40x40", "NO");
}

void TestExportCapture::renderingsAreThoseOfRender() {
  NEED_DATA(dataPath());
  QFETCH(QString, path);
  QFETCH(QString, options);
  QFETCH(QString, face);
  const QString source = QString::fromStdString(dataPath(path.toStdString()));
  const QString name = QLatin1String(QTest::currentDataTag()), png = at(name + QStringLiteral(".png"));
  const Outcome drawn = pictureBy(QStringLiteral("render"), source, options, png);
  QVERIFY2(drawn.status == 0, drawn.err);
  for (const QString& rle : {QString(), QStringLiteral(" --rle")}) {
    const QString dcm = at(name + rle + QStringLiteral(".dcm"));
    const Outcome done =
        pictureBy(QStringLiteral("export"), source, options + QStringLiteral(" --as sc") + rle, dcm);
    QVERIFY2(done.status == 0, done.err);
    QCOMPARE(done.err.contains("A face may be recognised"), face == QLatin1String("YES"));
    const auto frame = frameOf(dcm.toStdString(), 0);
    QVERIFY2(frame, frame ? "" : frame.message().c_str());
    QVERIFY(frame->rgb == rgbOfPng(png));
    DcmFileFormat file;
    QVERIFY(file.loadFile(dcm.toStdString().c_str()).good());
    DcmDataset& data = *file.getDataset();
    QCOMPARE(textIn(data, DCM_BurnedInAnnotation), std::string("NO"));
    QCOMPARE(textIn(data, DCM_RecognizableVisualFeatures), face.toStdString());
    const QString how = QString::fromStdString(textIn(data, DCM_DerivationDescription));
    const QImage picture(png);
    QVERIFY2(how.contains(hashOf(picture.text(QStringLiteral("volumen-scene")))), qPrintable(how));
    QVERIFY2(how.contains(QStringLiteral("level: ") + picture.text(QStringLiteral("volumen-level"))),
             qPrintable(how));
    QVERIFY(how.contains(QStringLiteral("Not for clinical use")));
    NEED_DCIODVFY();
    const QDir folder(source);
    const QString first = folder.filePath(folder.entryList(QDir::Files).value(0));
    QCOMPARE(newErrors(dcm, first.toStdString()), QStringList());
  }
}

void TestExportCapture::turnsAreThoseOfRender() {
  NEED_DATA(dataPath());
  const QString source = QString::fromStdString(dataPath("ct-chest-lidc0314-138"));
  const QString options = QStringLiteral("--preset CT-Bone --size 40x32 --turntable 4");
  const Outcome drawn = pictureBy(QStringLiteral("render"), source, options, at(QStringLiteral("turn.png")));
  QVERIFY2(drawn.status == 0, drawn.err);
  const QString dcm = at(QStringLiteral("turn.dcm"));
  const Outcome done =
      pictureBy(QStringLiteral("export"), source, options + QStringLiteral(" --as sc --frame-ms 40"), dcm);
  QVERIFY2(done.status == 0, done.err);
  for (int n = 0; n < 4; ++n) {
    const auto frame = frameOf(dcm.toStdString(), n);
    QVERIFY2(frame, frame ? "" : frame.message().c_str());
    QVERIFY(frame->rgb == rgbOfPng(at(QStringLiteral("turn-00%1.png").arg(n))));
  }
  DcmFileFormat file;
  QVERIFY(file.loadFile(dcm.toStdString().c_str()).good());
  DcmDataset& data = *file.getDataset();
  QCOMPARE(textIn(data, DCM_NumberOfFrames), std::string("4"));
  QCOMPARE(textIn(data, DCM_FrameTime), std::string("40"));
  const QString how = QString::fromStdString(textIn(data, DCM_DerivationDescription));
  QVERIFY2(how.startsWith(QStringLiteral("4 pictures; ")) && !how.contains(QStringLiteral("error estimated")),
           qPrintable(how));
}

void TestExportCapture::slicesAreThoseOfSlice() {
  NEED_DATA(dataPath());
  const QString source = QString::fromStdString(dataPath("ct-chest-lidc0314-138"));
  const QString options = QStringLiteral("--plane coronal --slab 10 --window 40,400 --size 91x83");
  const QString png = at(QStringLiteral("slice.png")), dcm = at(QStringLiteral("slice.dcm"));
  const Outcome drawn = pictureBy(QStringLiteral("slice"), source, options, png);
  QVERIFY2(drawn.status == 0, drawn.err);
  const Outcome done = pictureBy(QStringLiteral("export"), source, options + QStringLiteral(" --as sc"), dcm);
  QVERIFY2(done.status == 0, done.err);
  const auto frame = frameOf(dcm.toStdString(), 0);
  QVERIFY2(frame, frame ? "" : frame.message().c_str());
  QVERIFY(frame->rgb == rgbOfPng(png));
}

// Exports a rendering, slices and a measured shape, which must stay in one study.
void TestExportCapture::identityIsLeftOut() {
  NEED_DATA(dataPath());
  const QString source = QString::fromStdString(dataPath("ct-chest-lidc0314-138"));
  QFile shapes(at(QStringLiteral("shapes.json")));
  QVERIFY(shapes.open(QIODevice::WriteOnly));
  shapes.write(
      R"([{"kind": "length", "name": "LIDC-IDRI-0314", "points": [[-20, 100, -599.8], [15, 130, -599.8]]}])");
  shapes.close();
  const QString folder = at(QStringLiteral("without"));
  for (const QString& format : {QStringLiteral("sc --size 16x16"),
                                QStringLiteral("series --plane coronal --mm-per-pixel 8 --spacing 80"),
                                QStringLiteral("sr --roi ") + shapes.fileName()}) {
    const Outcome done =
        pictureBy(QStringLiteral("export"), source, QStringLiteral("--deidentify --as ") + format, folder);
    QVERIFY2(done.status == 0, done.err);
  }
  std::set<std::string> studies, classes;
  QDirIterator all(folder, QDir::Files, QDirIterator::Subdirectories);
  while (all.hasNext()) {
    const QString path = all.next();
    QVERIFY2(!contentsOf(path).contains("LIDC-IDRI"), qPrintable(path));
    DcmFileFormat file;
    QVERIFY(file.loadFile(path.toStdString().c_str()).good());
    QCOMPARE(textIn(*file.getDataset(), DCM_PatientIdentityRemoved), std::string("YES"));
    studies.insert(textIn(*file.getDataset(), DCM_StudyInstanceUID));
    classes.insert(textIn(*file.getDataset(), DCM_SOPClassUID));
  }
  QCOMPARE(studies.size(), std::size_t(1));
  QCOMPARE(classes.size(), std::size_t(3));
}

void TestExportCapture::documentsComeBack() {
  NEED_DATA(dataPath());
  const QByteArray bytes = "%PDF-1.4\nof a report\n%%EOF\n";
  QFile pdf(at(QStringLiteral("report.pdf")));
  QVERIFY(pdf.open(QIODevice::WriteOnly) && pdf.write(bytes) == bytes.size());
  pdf.close();
  for (const char* path : {"ct-chest-lidc0314-138", clip}) {
    const QString source = QString::fromStdString(dataPath(path));
    const QString dcm = at(QStringLiteral("pdf%1.dcm").arg(source.size()));
    const Outcome done = pictureBy(QStringLiteral("export"), source,
                                   QStringLiteral("--as pdf --title Findings --pdf ") + pdf.fileName(), dcm);
    QVERIFY2(done.status == 0, done.err);
    DcmFileFormat file;
    QVERIFY(file.loadFile(dcm.toStdString().c_str()).good());
    DcmDataset& data = *file.getDataset();
    const Uint8* document = nullptr;
    unsigned long count = 0;
    QVERIFY(data.findAndGetUint8Array(DCM_EncapsulatedDocument, document, &count).good());
    QVERIFY(count >= std::size_t(bytes.size()) &&
            std::memcmp(document, bytes, std::size_t(bytes.size())) == 0);
    QCOMPARE(textIn(data, DCM_DocumentTitle), std::string("Findings"));
  }
}

void TestExportCapture::wrongWordsAreUsage_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const char* options, const char* says) {
    QTest::newRow(name) << QString::fromLatin1(options) << QByteArray(says);
  };
  row("a window of a rendering", "--as sc --window 40,400", "--window is for slices");
  row("a preset of a slice", "--as sc --plane axial --preset CT-Bone", "--preset is for 3D pictures");
  row("a turn of a slice", "--as sc --plane axial --turntable 3", "--turntable is for 3D pictures");
  row("a slice has its table", "--as sc --plane axial --remove-table", "--remove-table is for 3D pictures");
  row("no size", "--as sc --size 0x7", "size");
  row("a window without width", "--as sc --plane axial --window 40,0", "width must be above 0");
  row("another format's option", "--as sc --roi x.json", "--roi does not go with --as sc");
  row("a rendering's option elsewhere", "--as ko --images 1.2 --rle", "--rle does not go with --as ko");
  row("surfaces are no DICOM", "--as stl --segments x.seg.nrrd --deidentify", "leave --deidentify out");
  row("a document without identity", "--as pdf --pdf x.pdf --deidentify", "leave --deidentify out");
  row("a turn beyond 4 GB", "--as sc --size 10000x10000 --turntable 999", "more than the 4 GB");
  row("a slice beyond 4 GB", "--as sc --plane axial --size 60000x60000", "more than the 4 GB");
  row("no pdf", "--as pdf", "--as pdf needs --pdf FILE");
  row("a format's option without one", "--deidentify --turntable 3", "--turntable goes with --as");
}

void TestExportCapture::wrongWordsAreUsage() {
  QFETCH(QString, options);
  QFETCH(QByteArray, says);
  const Outcome a = pictureBy(QStringLiteral("export"), QStringLiteral("phantom:ct-head:8"), options,
                              at(QStringLiteral("x.dcm")));
  QCOMPARE(a.status, 2);
  QVERIFY2(a.err.contains(says), a.err);
  QVERIFY(!QFile::exists(at(QStringLiteral("x.dcm"))));
}

void TestExportCapture::anEmptyOutputIsUsage() {
  const Outcome a =
      runProgram({QStringLiteral("export"), QStringLiteral("phantom:ct-head:8"), QStringLiteral("--as"),
                  QStringLiteral("sc"), QStringLiteral("-o"), QStringLiteral("")});
  QCOMPARE(a.status, 2);
  QVERIFY2(a.err.contains("-o is empty"), a.err);
}

void TestExportCapture::whatCannotBeIsSaid_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("output");
  QTest::addColumn<QString>("options");
  QTest::addColumn<QByteArray>("says");
  const QString phantom = QStringLiteral("phantom:ct-head:8");
  const QString real = QString::fromStdString(dataPath("mr-head-ge-mprage-130"));
  QTest::newRow("a source without DICOM files")
      << phantom << at(QStringLiteral("y.dcm")) << QStringLiteral("--as sc --size 8x8")
      << QByteArray("DICOM");
  QTest::newRow("a folder that is not there")
      << real << at(QStringLiteral("none/y.dcm")) << QStringLiteral("--as sc --size 8x8")
      << QByteArray("none/y.dcm");
  QTest::newRow("a file that is no PDF")
      << real << at(QStringLiteral("y.dcm")) << QStringLiteral("--as pdf --pdf /etc/hostname")
      << QByteArray("/etc/hostname is no PDF");
  QTest::newRow("no such file") << real << at(QStringLiteral("y.dcm"))
                                << QStringLiteral("--as pdf --pdf /none.pdf") << QByteArray("/none.pdf");
}

void TestExportCapture::whatCannotBeIsSaid() {
  QFETCH(QString, path);
  QFETCH(QString, output);
  QFETCH(QString, options);
  QFETCH(QByteArray, says);
  if (!path.startsWith(QLatin1String("phantom"))) NEED_DATA(dataPath());
  const QStringList before = QDir(folder_.path()).entryList(QDir::Files);
  const Outcome a = pictureBy(QStringLiteral("export"), path, options, output);
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains(says), a.err);
  QCOMPARE(QDir(folder_.path()).entryList(QDir::Files), before);
}

VOLUMEN_TEST(TestExportCapture);
#include "tst_export_capture.moc"
