// Guards export.md: slices with another series over them in colour are those of `volumen slice --overlay`,
// which blends as slices.md says; `volumen export --as series` writes them with their places, in the study of
// the series below.
#include <QDir>
#include <QImage>
#include <QTemporaryDir>
#include <cmath>
#include <set>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/app/series_case.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"
#include "viewer/slice/colour_map.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

const QString overlaidBy =
    QStringLiteral("--window 40,400 --overlay-window 5,10 --overlay-colours pet --overlay-opacity 0.7");

QStringList wordsOfOptions(const QString& options) {
  return options.split(QLatin1Char(' '), Qt::SkipEmptyParts);
}

// Returns a channel of a blend by hand: colours fade in over the lowest quarter of their window.
int blended(int under, int over, double grey, double opacity) {
  const double part = opacity * std::min(1.0, std::floor(255 * grey + 0.5) / 64);
  return int(under + part * (over - under) + 0.5);
}

double greyIn(double value, double centre, double width) {
  return std::clamp((value - (centre - width / 2)) / width, 0.0, 1.0);
}

}  // namespace

class TestExportFused : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void picturesBlendBoth();
  void slicesAreThoseOfSlice_data();
  void slicesAreThoseOfSlice();
  void theyLieInTheStudyBelow();
  void seriesWithoutDescriptionAreNamed_data();
  void seriesWithoutDescriptionAreNamed();
  void oneIsASecondaryCapture();
  void facesOfBothCount_data();
  void facesOfBothCount();
  void wrongInputIsRefused_data();
  void wrongInputIsRefused();

 private:
  QString at(const QString& name) const { return folder_.filePath(name); }
  // Runs a command on the CT with the PET over it.
  Outcome run(const QStringList& command, const QString& options) const {
    return runProgram(QStringList{command[0], ct_} + command.mid(1) +
                      QStringList{QStringLiteral("--overlay"), pet_} + wordsOfOptions(options));
  }

  QString ct_, pet_;
  QTemporaryDir folder_;
};

void TestExportFused::initTestCase() {
  ct_ = QString::fromStdString(dataPath("pet-ct/sts019-ct"));
  pet_ = QString::fromStdString(dataPath("pet-ct/sts019-pet"));
  NEED_DATA(ct_.toStdString());
}

// The values of both series at the same pixels, blended by hand, are the picture. Greys of DICOM's LINEAR
// function may round to the other byte.
void TestExportFused::picturesBlendBoth() {
  const QString placed = QStringLiteral("--plane axial --mm-per-pixel 3 --size 60x50 --centre 0,0,-150");
  const QString png = at(QStringLiteral("blend.png"));
  const Outcome a =
      run({QStringLiteral("slice"), QStringLiteral("-o"), png}, placed + QLatin1Char(' ') + overlaidBy);
  QVERIFY2(a.status == 0, a.err);
  const QImage picture = QImage(png).convertToFormat(QImage::Format_RGB32);
  const SliceFile under = runSlice(ct_, wordsOfOptions(placed)),
                  over = runSlice(pet_, wordsOfOptions(placed));
  QVERIFY2(under.failure.isEmpty() && over.failure.isEmpty(), qPrintable(under.failure + over.failure));
  QCOMPARE(picture.size(), QSize(60, 50));
  int coloured = 0;
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 60; ++x) {
      const auto n = std::size_t(y) * 60 + std::size_t(x);
      const double ct = double(under.values[n]), pet = double(over.values[n]);
      const int grey = std::isnan(ct) ? 0 : int(std::floor(255 * greyIn(ct, 40, 400) + 0.5));
      const double uptake = std::isnan(pet) ? 0 : greyIn(pet, 5, 10);
      const QRgb colour = colourTable(ColourMap::pet)[std::size_t(std::floor(255 * uptake + 0.5))];
      const QRgb pixel = picture.pixel(x, y);
      const int wanted[] = {blended(grey, qRed(colour), uptake, 0.7),
                            blended(grey, qGreen(colour), uptake, 0.7),
                            blended(grey, qBlue(colour), uptake, 0.7)};
      const int found[] = {qRed(pixel), qGreen(pixel), qBlue(pixel)};
      for (int channel = 0; channel < 3; ++channel)
        QVERIFY2(std::abs(found[channel] - wanted[channel]) <= 3,
                 qPrintable(QStringLiteral("pixel %1, %2: %3, not %4")
                                .arg(x)
                                .arg(y)
                                .arg(found[channel])
                                .arg(wanted[channel])));
      coloured += found[0] != found[1] || found[1] != found[2];
    }
  QVERIFY(coloured > 100);
}

void TestExportFused::slicesAreThoseOfSlice_data() {
  QTest::addColumn<QString>("options");
  QTest::newRow("one axial slice") << QStringLiteral("--at -150");
  QTest::newRow("coronal slabs") << QStringLiteral("--plane coronal --slab 50 --mm-per-pixel 2.5");
}

void TestExportFused::slicesAreThoseOfSlice() {
  QFETCH(QString, options);
  const QTemporaryDir folder;
  const QString out = folder.filePath(QStringLiteral("out")),
                png = folder.filePath(QStringLiteral("one.png"));
  const QString all = options + QLatin1Char(' ') + overlaidBy;
  const Outcome a = run(
      {QStringLiteral("export"), QStringLiteral("--as"), QStringLiteral("series"), QStringLiteral("-o"), out},
      all);
  QVERIFY2(a.status == 0, a.err);
  const QStringList files = storedFilesIn(out);
  QVERIFY(!files.isEmpty());
  for (const QString& file : files) {
    StoredFile made(file);
    const std::vector<double> first = made.numbers(DCM_ImagePositionPatient),
                              axes = made.numbers(DCM_ImageOrientationPatient);
    QCOMPARE(first.size(), std::size_t(3));
    QCOMPARE(axes.size(), std::size_t(6));
    const double mm = made.numbers(DCM_PixelSpacing).at(0), columns = made.number(DCM_Columns, 0),
                 rows = made.number(DCM_Rows, 0);
    QStringList vectors[3];  // the plane that the file itself says
    for (std::size_t n = 0; n < 3; ++n) {
      vectors[0] << exactText(first[n] + mm * (axes[n] * (columns - 1) + axes[n + 3] * (rows - 1)) / 2);
      vectors[1] << exactText(axes[n]);
      vectors[2] << exactText(axes[n + 3]);
    }
    const QString place = QStringLiteral(" --centre %1 --right %2 --down %3 --mm-per-pixel %4 --size %5x%6")
                              .arg(vectors[0].join(QLatin1Char(',')), vectors[1].join(QLatin1Char(',')),
                                   vectors[2].join(QLatin1Char(',')), exactText(mm))
                              .arg(int(columns))
                              .arg(int(rows));
    const QString slab = options.contains(QLatin1String("--slab")) ? QStringLiteral(" --slab 50") : QString();
    const Outcome b = run({QStringLiteral("slice"), QStringLiteral("-o"), png}, overlaidBy + place + slab);
    QVERIFY2(b.status == 0, b.err);
    const QImage picture = QImage(png).convertToFormat(QImage::Format_RGB888);
    const Uint8* rgb = nullptr;
    QVERIFY(made.file.getDataset()->findAndGetUint8Array(DCM_PixelData, rgb).good() && rgb);
    int differ = 0;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < 3 * picture.width(); ++x)
        differ += std::abs(int(picture.constScanLine(y)[x]) - int(rgb[y * 3 * picture.width() + x])) > 1;
    QCOMPARE(differ, 0);
  }
}

void TestExportFused::theyLieInTheStudyBelow() {
  const QString out = at(QStringLiteral("study"));
  const Outcome a = run(
      {QStringLiteral("export"), QStringLiteral("--as"), QStringLiteral("series"), QStringLiteral("-o"), out},
      QStringLiteral("--plane axial --spacing 30"));
  QVERIFY2(a.status == 0, a.err);
  const QString ctFile = storedFilesIn(ct_)[0];
  StoredFile source(ctFile);
  std::set<std::string> series, instances;
  const QStringList files = storedFilesIn(out);
  QVERIFY(files.size() > 3);
  for (int n = 0; n < files.size(); ++n) {
    StoredFile made(files[n]);
    series.insert(made.said(DCM_SeriesInstanceUID));
    instances.insert(made.said(DCM_SOPInstanceUID));
    for (const DcmTagKey& tag :
         {DCM_PatientName, DCM_PatientID, DCM_StudyInstanceUID, DCM_FrameOfReferenceUID})
      QCOMPARE(made.said(tag), source.said(tag));
    QCOMPARE(made.said(DCM_SOPClassUID), std::string(UID_SecondaryCaptureImageStorage));
    QCOMPARE(made.said(DCM_PhotometricInterpretation), std::string("RGB"));
    QCOMPARE(made.said(DCM_ImageType), std::string("DERIVED\\SECONDARY"));
    QCOMPARE(made.number(DCM_InstanceNumber, 0), n + 1.0);
    QCOMPARE(made.number(DCM_SpacingBetweenSlices, 0), 30.0);
    for (const DcmTagKey& tag : {DCM_WindowCenter, DCM_RescaleSlope})
      QVERIFY(!made.file.getDataset()->tagExists(tag));
  }
  QCOMPARE(series.size(), std::size_t(1));
  QCOMPARE(instances.size(), std::size_t(files.size()));
  StoredFile middle(files[files.size() / 2]);
  const QString how = QString::fromStdString(middle.said(DCM_DerivationDescription));
  QVERIFY2(how.contains(QLatin1String("Axial, every 30 mm of ")) &&
               how.contains(QLatin1String("; over it ")) &&
               how.contains(QLatin1String("hotIron, opacity 0.5")),
           qPrintable(how));
  const auto below = openStudy(ct_.toStdString()), above = openStudy(pet_.toStdString());
  QVERIFY(below && above);
  int ofBelow = 0, ofAbove = 0;
  for (const std::string& uid : middle.sources()) {
    ofBelow += std::ranges::count(below->volumes.at(0).sopInstanceUids, uid) > 0;
    ofAbove += std::ranges::count(above->volumes.at(0).sopInstanceUids, uid) > 0;
  }
  QVERIFY(ofBelow >= 1 && ofBelow <= 2 && ofAbove >= 1 && ofAbove <= 2);
  QCOMPARE(std::size_t(ofBelow + ofAbove), middle.sources().size());
  NEED_DCIODVFY();
  QCOMPARE(newErrors(files[files.size() / 2], ctFile.toStdString()), QStringList());
}

void TestExportFused::seriesWithoutDescriptionAreNamed_data() {
  QTest::addColumn<QByteArray>("described");  // the series above
  QTest::addColumn<QByteArray>("description");
  QTest::addColumn<QByteArray>("derivation");
  QTest::newRow("by modality and number")
      << QByteArray() << QByteArray("Axial, every 2 mm, fused with CT (3)") << QByteArray("over it CT (3) (");
  QTest::newRow("by its description")
      << QByteArray("Thin") << QByteArray("Axial, every 2 mm, fused with Thin")
      << QByteArray("over it Thin (");
  QTest::newRow("cut before a comma")
      << QByteArray("A description of some more words, and more")
      << QByteArray("Axial, every 2 mm, fused with A description of some more words")
      << QByteArray("over it A description of some more words, and more (");
}

void TestExportFused::seriesWithoutDescriptionAreNamed() {
  QFETCH(QByteArray, described);
  const QTemporaryDir folder;
  const auto write = [&](const char* name, const char* number, const QByteArray& description) {
    QDir(folder.path()).mkdir(QString::fromLatin1(name));
    DicomPicture picture;
    picture.seriesUid = std::string("1.2.3.4.5.") + number;
    picture.pixels = {0, 100, 200, 300, 400, 500, 600, 700, 800, 900, 1000, 1100};
    picture.edit = [&](DcmDataset& data) {
      data.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.3.9");
      data.putAndInsertString(DCM_SeriesNumber, number);
      if (!description.isEmpty()) data.putAndInsertString(DCM_SeriesDescription, description.constData());
    };
    for (int n = 0; n < 4; ++n) {
      picture.instance = n + 1;
      picture.position.z = 2 * n;
      writeDicom(folder.filePath(QStringLiteral("%1/%2.dcm").arg(QLatin1String(name)).arg(n)).toStdString(),
                 picture);
    }
  };
  write("under", "2", {});
  write("over", "3", described);
  const QString out = folder.filePath(QStringLiteral("out"));
  const Outcome a = runProgram({QStringLiteral("export"), folder.filePath(QStringLiteral("under")),
                                QStringLiteral("--as"), QStringLiteral("series"), QStringLiteral("--overlay"),
                                folder.filePath(QStringLiteral("over")), QStringLiteral("-o"), out});
  QVERIFY2(a.status == 0, a.err);
  StoredFile made(storedFilesIn(out)[0]);
  QTEST(QByteArray::fromStdString(made.said(DCM_SeriesDescription)), "description");
  const QByteArray how = QByteArray::fromStdString(made.said(DCM_DerivationDescription));
  QFETCH(QByteArray, derivation);
  QVERIFY2(how.contains("Axial, every 2 mm of CT (2), resampled") && how.contains(derivation), how);
}

void TestExportFused::oneIsASecondaryCapture() {
  const QString file = at(QStringLiteral("one.dcm")), png = at(QStringLiteral("one.png"));
  const QString options = QStringLiteral("--plane coronal ") + overlaidBy;
  const Outcome a = run(
      {QStringLiteral("export"), QStringLiteral("--as"), QStringLiteral("sc"), QStringLiteral("-o"), file},
      options);
  QVERIFY2(a.status == 0, a.err);
  const Outcome b =
      run({QStringLiteral("slice"), QStringLiteral("--no-warning-line"), QStringLiteral("-o"), png}, options);
  QVERIFY2(b.status == 0, b.err);
  StoredFile made(file);
  QVERIFY(made.said(DCM_DerivationDescription).find("overlay: ") != std::string::npos);
  QVERIFY(!made.file.getDataset()->tagExists(DCM_PixelSpacing));
  const QImage picture = QImage(png).convertToFormat(QImage::Format_RGB888);
  const Uint8* rgb = nullptr;
  QVERIFY(made.file.getDataset()->findAndGetUint8Array(DCM_PixelData, rgb).good() && rgb);
  for (int y = 0; y < picture.height(); ++y)
    QVERIFY(std::equal(picture.constScanLine(y), picture.constScanLine(y) + 3 * picture.width(),
                       rgb + y * 3 * picture.width()));
}

void TestExportFused::facesOfBothCount_data() {
  QTest::addColumn<QString>("under");
  QTest::addColumn<QString>("over");
  QTest::addColumn<QByteArray>("shown");  // empty: not known
  const QString head = QStringLiteral("phantom:ct-head:24"), ball = QStringLiteral("phantom:sphere:16");
  QTest::newRow("a head below") << head << ball << QByteArray("YES");
  QTest::newRow("a head above") << ball << head << QByteArray("YES");
  QTest::newRow("neither says what it shows") << ball << ball << QByteArray();
}

void TestExportFused::facesOfBothCount() {
  QFETCH(QString, under);
  QFETCH(QString, over);
  QFETCH(QByteArray, shown);
  const QTemporaryDir folder;
  const auto in = [&](const char* name) { return folder.filePath(QString::fromLatin1(name)); };
  const Outcome a = runProgram({QStringLiteral("convert"), under, QStringLiteral("-o"), in("under/")});
  QVERIFY2(a.status == 0, a.err);
  QFile key(in("key"));
  QVERIFY(key.open(QIODevice::WriteOnly) && key.write("a key of these tests") > 0);
  key.close();
  const QStringList fused{
      QStringLiteral("export"),    in("under"), QStringLiteral("--as"), QStringLiteral("series"),
      QStringLiteral("--overlay"), over,        QStringLiteral("--at"), QStringLiteral("0"),
      QStringLiteral("-o")};
  const Outcome b = runProgram(fused + QStringList{in("fused")});
  QVERIFY2(b.status == 0, b.err);
  StoredFile made(storedFilesIn(in("fused"))[0]);
  QCOMPARE(QByteArray::fromStdString(made.said(DCM_RecognizableVisualFeatures)), shown);
  QCOMPARE(b.err.contains("A face may be recognised in a rendering"), !shown.isEmpty());
  const Outcome c = runProgram(
      fused + QStringList{in("copies"), QStringLiteral("--deidentify"), QStringLiteral("--key"), in("key")});
  QVERIFY2(c.status == 0, c.err);
  QCOMPARE(c.err.contains("A face may be recognised in pictures of a head"), !shown.isEmpty());
}

void TestExportFused::wrongInputIsRefused_data() {
  QTest::addColumn<QString>("command");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const char* command, int status, const char* says) {
    QTest::newRow(name) << QString::fromLatin1(command) << status << QByteArray(says);
  };
  row("values in colour", "slice CT --overlay PET -o OUT.nrrd", 2, "--overlay draws colours");
  row("a frame", "slice CT --plane frame --overlay PET -o OUT.png", 2, "not for pictures as acquired");
  row("a relation of nothing", "slice CT --register -o OUT.png", 2, "go with --overlay");
  row("unknown colours", "slice CT --overlay PET --overlay-colours blue -o OUT.png", 2, "--overlay-colours");
  row("no window", "slice CT --overlay PET --overlay-window 1,0 -o OUT.png", 2, "--overlay-window");
  row("too opaque", "slice CT --overlay PET --overlay-opacity 2 -o OUT.png", 2, "--overlay-opacity");
  row("another frame of reference", "slice MR --overlay PET -o OUT.png", 1, "different frames of reference");
  row("a missing overlay", "export CT --as series --overlay nowhere -o OUT", 1, "nowhere");
  row("a window of kept values", "export CT --as series --window 1,2 -o OUT", 2, "--window does not go");
  row("colours of nothing", "export CT --as series --overlay-opacity 1 -o OUT", 2, "goes with --overlay");
  row("a rendering", "export CT --as sc --overlay PET -o OUT", 2, "give --plane too");
  row("the other's grid", "export CT --as series --onto PET --overlay PET -o OUT", 2,
      "does not go with --onto");
  row("no DICOM below", "export phantom:ct-head:24 --as series --overlay phantom:ct-head:32 -o OUT", 1,
      "comes from no DICOM files");
}

void TestExportFused::wrongInputIsRefused() {
  QFETCH(QString, command);
  QFETCH(QByteArray, says);
  const QTemporaryDir folder;
  command.replace(QLatin1String("CT "), ct_ + QLatin1Char(' '))
      .replace(QLatin1String("PET "), pet_ + QLatin1Char(' '))
      .replace(QLatin1String("MR "),
               QString::fromStdString(dataPath("mr-head-ge-mprage-130")) + QLatin1Char(' '))
      .replace(QLatin1String("OUT"), folder.filePath(QStringLiteral("out")));
  const Outcome a = runProgram(wordsOfOptions(command));
  QVERIFY2(a.err.contains(says), a.err);
  QTEST(a.status, "status");
  QVERIFY(QDir(folder.path()).isEmpty(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot));
}

VOLUMEN_TEST(TestExportFused);
#include "tst_export_fused.moc"
