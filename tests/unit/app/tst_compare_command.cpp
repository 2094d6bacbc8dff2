// Guards segment.md, "Read the numbers": segments of two files are compared by name on the grid of the first.
// The numbers of `segment --csv` equal those of its JSON.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <cmath>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestCompareCommand : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void planesAreCompared_data();
  void planesAreCompared();
  void textForPeople();
  void whatCannotBeComparedIsSaid_data();
  void whatCannotBeComparedIsSaid();
  void anotherFrameOfReferenceIsRefused_data();
  void anotherFrameOfReferenceIsRefused();
  void anotherGridIsToldByTheNamesOfTheFiles();
  void csvIsTheJson();

 private:
  QString at(const QString& name) const { return folder_.filePath(name); }
  QTemporaryDir folder_;
};

namespace {

QStringList wordsOf(const QString& text) { return text.split(QLatin1Char(' ')); }

}  // namespace

// The phantom `ramp` has the value i, so ranges are slabs of 8 x 8 voxels of 1 mm.
void TestCompareCommand::initTestCase() {
  for (const auto& [name, range] :
       {std::pair("a.seg.nrrd", "2:5"), {"b.seg.nrrd", "4:7"}, {"b.nii.gz", "4:7"}, {"b.mha", "4:7"}})
    QCOMPARE(runProgram(wordsOf(QStringLiteral("segment phantom:ramp:8 --range"))
                        << QLatin1String(range) << QStringLiteral("-o") << at(QLatin1String(name)))
                 .status,
             0);
  QVERIFY(QFile::copy(at(QStringLiteral("b.seg.nrrd")), at(QStringLiteral("b"))));
}

void TestCompareCommand::planesAreCompared_data() {
  QTest::addColumn<QString>("second");
  QTest::addColumn<double>("dice");
  QTest::newRow("itself") << QStringLiteral("a.seg.nrrd") << 1.0;
  QTest::newRow("half of it") << QStringLiteral("b.seg.nrrd") << 0.5;
  QTest::newRow("half of it, an image of labels") << QStringLiteral("b.nii.gz") << 0.5;
  QTest::newRow("half of it, another one") << QStringLiteral("b.mha") << 0.5;
  QTest::newRow("half of it, a file without an ending") << QStringLiteral("b") << 0.5;
}

void TestCompareCommand::planesAreCompared() {
  QFETCH(QString, second);
  QFETCH(double, dice);
  const Outcome done = runProgram(
      {QStringLiteral("compare"), at(QStringLiteral("a.seg.nrrd")), at(second), QStringLiteral("--json")});
  QVERIFY2(done.status == 0, done.err);
  const QJsonArray pairs = QJsonDocument::fromJson(done.out).object()[QStringLiteral("pairs")].toArray();
  QCOMPARE(pairs.size(), 1);
  const QJsonObject pair = pairs[0].toObject();
  QCOMPARE(pair[QStringLiteral("first")].toString(), QStringLiteral("Range 2:5"));
  QCOMPARE(pair[QStringLiteral("dice")].toDouble(), dice);
  QCOMPARE(pair[QStringLiteral("differenceMl")].toDouble(-1), 0.0);
  const double apart = dice < 1 ? 2 : 0;
  QVERIFY(std::abs(pair[QStringLiteral("hausdorffMm")].toDouble(-1) - apart) <= 0.05 * apart);
  QVERIFY(pair[QStringLiteral("meanDistanceMm")].toDouble(-1) <=
          pair[QStringLiteral("hausdorff95Mm")].toDouble() + 1e-9);
}

void TestCompareCommand::textForPeople() {
  const Outcome done = runProgram(
      {QStringLiteral("compare"), at(QStringLiteral("a.seg.nrrd")), at(QStringLiteral("b.seg.nrrd"))});
  const QStringList lines = QString::fromUtf8(done.out).split(QLatin1Char('\n'));
  QCOMPARE(lines.size(), 3);
  QVERIFY2(lines[1].simplified().startsWith(QStringLiteral("Range 2:5 Range 4:7 0.5 0 ")),
           qPrintable(lines[1]));
  QCOMPARE(done.err, QByteArray());
}

void TestCompareCommand::whatCannotBeComparedIsSaid_data() {
  QTest::addColumn<QString>("second");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("no file") << QStringLiteral("none.seg.nrrd") << QStringLiteral("none.seg.nrrd");
  QTest::newRow("no DICOM file") << QStringLiteral("none.dcm") << QStringLiteral("none.dcm");
  QTest::newRow("no file of labels") << QStringLiteral("none.nii.gz") << QStringLiteral("none.nii.gz");
}

void TestCompareCommand::whatCannotBeComparedIsSaid() {
  QFETCH(QString, second);
  QFETCH(QString, sentence);
  const Outcome done = runProgram({QStringLiteral("compare"), at(QStringLiteral("a.seg.nrrd")), at(second)});
  QCOMPARE(done.status, 1);
  QCOMPARE(done.out, QByteArray());
  QVERIFY2(QString::fromUtf8(done.err).contains(sentence), done.err);
}

void TestCompareCommand::anotherFrameOfReferenceIsRefused_data() {
  QTest::addColumn<QByteArray>("frame");
  QTest::addColumn<bool>("ofItsPictures");
  QTest::addColumn<int>("status");
  QTest::newRow("the same one") << QByteArray("1.2.3") << false << 0;
  QTest::newRow("another one") << QByteArray("1.2.4") << false << 1;
  QTest::newRow("another one of the same pictures") << QByteArray("1.2.4") << true << 0;
  QTest::newRow("none") << QByteArray() << false << 0;
}

// Compares a DICOM segmentation on the slices of the ramp with the same in another frame of reference or on
// other pictures.
void TestCompareCommand::anotherFrameOfReferenceIsRefused() {
  QFETCH(QByteArray, frame);
  QFETCH(bool, ofItsPictures);
  QFETCH(int, status);
  const QString slices = at(QStringLiteral("slices/")), own = at(QStringLiteral("own.dcm")),
                other = at(QStringLiteral("other.dcm"));
  if (!QDir(slices).exists())
    QCOMPARE(runProgram(wordsOf(QStringLiteral("convert phantom:ramp:8 -o")) << slices).status, 0);
  QCOMPARE(runProgram({QStringLiteral("segment"), slices, QStringLiteral("--range"), QStringLiteral("2:5"),
                       QStringLiteral("-o"), own})
               .status,
           0);
  DcmFileFormat file;
  QVERIFY(file.loadFile(OFFilename(own.toUtf8().constData())).good());
  DcmDataset& data = *file.getDataset();
  data.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.3");
  QVERIFY(file.saveFile(OFFilename(own.toUtf8().constData()), EXS_LittleEndianExplicit).good());
  data.putAndInsertString(DCM_FrameOfReferenceUID, frame.constData());
  if (!ofItsPictures) {
    data.findAndDeleteElement(DCM_ReferencedSeriesSequence);
    DcmItem* shared = nullptr;
    for (long n = 0; data.findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, shared, n).good(); ++n)
      shared->findAndDeleteElement(DCM_DerivationImageSequence);
  }
  QVERIFY(file.saveFile(OFFilename(other.toUtf8().constData()), EXS_LittleEndianExplicit).good());
  for (const auto& [first, second] : {std::pair(own, other), {other, own}}) {
    const Outcome done = runProgram({QStringLiteral("compare"), first, second});
    QVERIFY2(done.status == status, done.err.constData());
    const QString refused =
        second + QStringLiteral(" is of another frame of reference than ") + first + QLatin1Char(',');
    QCOMPARE(QString::fromUtf8(done.err).contains(refused), status != 0);
  }
}

// The small grid has 8 of 16 voxels along each axis.
void TestCompareCommand::anotherGridIsToldByTheNamesOfTheFiles() {
  const QString large = at(QStringLiteral("large.seg.nrrd")), small = at(QStringLiteral("a.seg.nrrd"));
  QCOMPARE(runProgram(wordsOf(QStringLiteral("segment phantom:ramp:16 --range 6:7 -o")) << large).status, 0);
  const Outcome done = runProgram({QStringLiteral("compare"), small, large});
  QCOMPARE(done.status, 0);
  QVERIFY2(
      !done.err.contains("the series") &&
          QString::fromUtf8(done.err).contains(
              large +
              QStringLiteral(": The segments lie on another grid (16 x 16 x 16 voxels): each voxel of ") +
              small),
      done.err.constData());
}

void TestCompareCommand::csvIsTheJson() {
  const QString csv = at(QStringLiteral("a.csv"));
  const Outcome done = runProgram(wordsOf(QStringLiteral("segment phantom:ramp:8 --json --range 2:5 -o"))
                                  << at(QStringLiteral("c.seg.nrrd")) << QStringLiteral("--csv") << csv);
  QCOMPARE(done.status, 0);
  const QJsonObject all = QJsonDocument::fromJson(done.out).object();
  QVERIFY(all[QStringLiteral("files")].toArray().contains(csv));
  const QJsonObject segment = all[QStringLiteral("segments")].toArray()[0].toObject();
  const QStringList lines = QString::fromUtf8(contentsOf(csv)).split(QStringLiteral("\r\n"));
  QCOMPARE(lines.size(), 3);
  const QStringList heads = lines[0].split(QLatin1Char(',')), row = lines[1].split(QLatin1Char(','));
  QCOMPARE(row.size(), heads.size());
  QCOMPARE(row[0], QStringLiteral("Range 2:5"));
  for (const auto& [head, key] : {std::pair("Voxels", "voxels"),
                                  {"Surface area (mm^2)", "areaMm2"},
                                  {"Longest diameter (mm)", "longestMm"}}) {
    const qsizetype place = heads.indexOf(QLatin1String(head));
    QVERIFY2(place > 0, head);
    const double exact = segment[QLatin1String(key)].toDouble();
    QVERIFY2(std::abs(row[place].toDouble() - exact) <= 5.1e-7 * exact, head);
  }
  const Outcome failed = runProgram(wordsOf(QStringLiteral("segment phantom:ramp:8 --range 2:5 -o"))
                                    << at(QStringLiteral("d.seg.nrrd")) << QStringLiteral("--csv")
                                    << at(QStringLiteral("no/folder.csv")));
  QCOMPARE(failed.status, 1);
  QVERIFY(!QFile::exists(at(QStringLiteral("d.seg.nrrd"))));
}

VOLUMEN_TEST(TestCompareCommand);
#include "tst_compare_command.moc"
