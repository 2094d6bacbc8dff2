// Guards export.md: exported objects reference pictures by UIDs of their own or not at all. They have the
// elements that their class needs, and no others.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDir>
#include <QFile>
#include <QImage>
#include <QTemporaryDir>
#include <memory>
#include <set>

#include "io/presentation.h"
#include "io/report.h"
#include "io/study/study.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/app/series_case.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestExportValid : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatHasNoNameIsRefused_data();
  void whatHasNoNameIsRefused();
  void copiesOfAnImageAreOne_data();
  void copiesOfAnImageAreOne();
  void picturesWithoutNameAreNotNamed_data();
  void picturesWithoutNameAreNotNamed();
  void elementsFitTheClass_data();
  void elementsFitTheClass();
  void narrowWindowsAreExact_data();
  void narrowWindowsAreExact();

 private:
  // Runs `export PATH -o out.dcm --as OPTIONS`. Words in capitals in the options stand for files of the
  // test.
  Outcome exported(const QString& path, const QString& options) const;
  // Writes three slices. `lack` says which UIDs they lack: "series", "instance", or "own" ones, so that all
  // share one.
  void writeScans(const DicomFolder& scans, const QString& lack) const;
  QString at(const char* name) const { return folder_->filePath(QString::fromLatin1(name)); }

  std::unique_ptr<QTemporaryDir> folder_;
};

namespace {

// Returns the bytes of the picture of `slice PATH --plane frame --index N OPTIONS`, or its error message.
QByteArray framePicture(const QString& path, int index, const QStringList& options) {
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("picture.png"));
  const Outcome done = runProgram(QStringList{QStringLiteral("slice"), path, QStringLiteral("--plane"),
                                              QStringLiteral("frame"), QStringLiteral("--index"),
                                              QString::number(index), QStringLiteral("-o"), file} +
                                  options);
  return done.status == 0 ? contentsOf(file) : done.err;
}

std::set<int> greysOf(const QByteArray& png) {
  const QImage image = QImage::fromData(png);
  std::set<int> greys;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) greys.insert(qGray(image.pixel(x, y)));
  return greys;
}

}  // namespace

void TestExportValid::writeScans(const DicomFolder& scans, const QString& lack) const {
  for (int n = 0; n < 3; ++n) {
    DicomPicture picture = sliceAt(2.0 * n, 100 * (n + 1));
    picture.columns = picture.rows = 8;
    picture.edit = [&](DcmDataset& data) {
      const std::string own = lack == QLatin1String("own") ? "1.2.3.9" : numbered("1.2.3.9.", n);
      data.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.3.7");
      data.putAndInsertString(DCM_SOPInstanceUID, lack == QLatin1String("instance") ? "" : own.c_str());
      if (lack == QLatin1String("series")) data.putAndInsertString(DCM_SeriesInstanceUID, "");
    };
    scans.add(numbered("s", n), picture);
  }
}

Outcome TestExportValid::exported(const QString& path, const QString& options) const {
  const QString given = QString(options)
                            .replace(QLatin1String("SHAPES"), at("shapes.json"))
                            .replace(QLatin1String("SEGMENTS"), at("segments.seg.nrrd"))
                            .replace(QLatin1String("DOCUMENT"), at("document.pdf"))
                            .replace(QLatin1String("SELF"), path);
  return runProgram(QStringList{QStringLiteral("export"), path, QStringLiteral("-o"), at("out.dcm"),
                                QStringLiteral("--as")} +
                    given.split(QLatin1Char(' ')));
}

void TestExportValid::whatHasNoNameIsRefused_data() {
  QTest::addColumn<QString>("lack");
  QTest::addColumn<QString>("options");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const char* lack, const char* options, const char* says) {
    QTest::newRow(name) << QString::fromLatin1(lack) << QString::fromLatin1(options) << QByteArray(says);
  };
  const char *const gsps = "gsps --window 100,200", *const seg = "seg --segments SEGMENTS",
                    *const rtstruct = "rtstruct --segments SEGMENTS", *const noSeries = "names no series",
                    *const noUid = "has no SOPInstanceUID", *const shared = "have the same SOPInstanceUID";
  row("a state of no series", "series", gsps, noSeries);
  row("a segmentation of no series", "series", seg, noSeries);
  row("a structure set of no series", "series", rtstruct, noSeries);
  row("key images of no series", "series", "ko --images 1.2.3.9.1", "does not say which study and series");
  row("a state of nameless pictures", "instance", gsps, noUid);
  row("a segmentation of nameless pictures", "instance", seg, noUid);
  row("a structure set of nameless pictures", "instance", rtstruct, noUid);
  row("a report on nameless pictures", "instance", "sr --roi SHAPES", noUid);
  row("a state of pictures with one name", "own", gsps, shared);
  row("a segmentation of pictures with one name", "own", seg, shared);
  row("a structure set of pictures with one name", "own", rtstruct, shared);
  row("key images with one name", "own", "ko --images 1.2.3.9", shared);
  row("a report on pictures with one name", "own", "sr --roi SHAPES", shared);
}

void TestExportValid::whatHasNoNameIsRefused() {
  QFETCH(QString, lack);
  QFETCH(QString, options);
  QFETCH(QByteArray, says);
  folder_ = std::make_unique<QTemporaryDir>();
  const DicomFolder scans;
  writeScans(scans, lack);
  const QString path = QString::fromStdString(scans.path());
  QFile shapes(at("shapes.json"));
  QVERIFY(shapes.open(QIODevice::WriteOnly) &&
          shapes.write(R"([{"kind": "length", "points": [[0, 0, 0], [1, 0, 0]]}])") > 0);
  shapes.close();
  const Outcome segments =
      runProgram({QStringLiteral("segment"), path, QStringLiteral("--range"), QStringLiteral("50:5000"),
                  QStringLiteral("-o"), at("segments.seg.nrrd")});
  QVERIFY2(segments.status == 0, segments.err);
  const Outcome done = exported(path, options);
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains(says), done.err);
  QVERIFY(!done.err.contains("mosaic") && !QFile::exists(at("out.dcm")));
}

void TestExportValid::copiesOfAnImageAreOne_data() {
  QTest::addColumn<QString>("options");
  QTest::newRow("key images") << QStringLiteral("ko --images UID");
  QTest::newRow("a state of a chosen image") << QStringLiteral("gsps --window 100,150 --images UID");
  QTest::newRow("a state of all images") << QStringLiteral("gsps --window 100,150");
}

// What is said of one of two equal files is as if the other were not there.
void TestExportValid::copiesOfAnImageAreOne() {
  QFETCH(QString, options);
  const std::string clipPath = dataPath("dicom-2d/xa-96frames.dcm");
  NEED_DATA(clipPath);
  folder_ = std::make_unique<QTemporaryDir>();
  const QTemporaryDir images;
  for (const char* name : {"a.dcm", "b.dcm"})
    QVERIFY(QFile::copy(QString::fromStdString(clipPath), images.filePath(QLatin1String(name))));
  const std::string uid = StoredFile(images.filePath(QStringLiteral("a.dcm"))).said(DCM_SOPInstanceUID);
  options.replace(QLatin1String("UID"), QString::fromStdString(uid));
  const Outcome done = exported(images.path(), options);
  QVERIFY2(done.status == 0, done.err);
  const std::string out = at("out.dcm").toStdString();
  std::vector<ReferencedPicture> pictures;
  if (options.startsWith(QLatin1String("ko"))) {
    const Result<KeyObjects> keys = loadKeyObjects(out);
    QVERIFY(keys);
    pictures = keys->pictures;
  } else {
    const Result<Presentation> state = loadPresentation(out);
    QVERIFY(state);
    pictures = state->pictures;
  }
  QCOMPARE(pictures.size(), std::size_t(1));
  QCOMPARE(pictures[0].sopInstanceUid, uid);
  const std::set<int> frames(pictures[0].frames.begin(), pictures[0].frames.end());
  QCOMPARE(frames.size(), pictures[0].frames.size());
}

void TestExportValid::picturesWithoutNameAreNotNamed_data() {
  QTest::addColumn<QString>("options");
  const auto row = [](const char* name, const char* options) {
    QTest::newRow(name) << QString::fromLatin1(options);
  };
  row("slices along a plane", "series --plane coronal");
  row("slices on another grid", "series --onto SELF");
  row("slices fused", "series --plane coronal --overlay SELF");
  row("a picture", "sc --plane axial");
  row("a document", "pdf --pdf DOCUMENT");
}

void TestExportValid::picturesWithoutNameAreNotNamed() {
  QFETCH(QString, options);
  folder_ = std::make_unique<QTemporaryDir>();
  const DicomFolder scans;
  writeScans(scans, QStringLiteral("instance"));
  QFile document(at("document.pdf"));
  QVERIFY(document.open(QIODevice::WriteOnly) && document.write("%PDF-1.4\n%%EOF\n") > 0);
  document.close();
  const Outcome done = exported(QString::fromStdString(scans.path()), options);
  QVERIFY2(done.status == 0, done.err);
  const QString out = at("out.dcm");
  StoredFile made(QFileInfo(out).isDir() ? storedFilesIn(out).value(0) : out);
  DcmDataset& data = *made.file.getDataset();
  QVERIFY(!made.said(DCM_SOPInstanceUID).empty());
  for (const DcmTagKey& tag :
       {DCM_ReferencedSOPInstanceUID, DCM_SourceImageSequence, DCM_SourceInstanceSequence})
    QVERIFY2(!data.tagExists(tag, OFTrue), DcmTag(tag).getTagName());
}

void TestExportValid::elementsFitTheClass_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<QByteArray>("element");
  QTest::addColumn<bool>("isThere");
  const auto row = [](const char* name, const char* source, const char* element, bool isThere) {
    QTest::newRow(name) << QString::fromLatin1(source) << QByteArray(element) << isThere;
  };
  const char *const breast = "field-cases/c03b-tomosynthesis", *const head =
                                                                   "dicom-geometry/mr-enh-philips-phmag";
  row("Secondary Capture has an orientation", breast, "PatientOrientation", true);
  row("an image with laterality has no second one", breast, "Laterality", false);
  row("no inversion, no inversion time", head, "InversionTime", false);
}

// Series are exported on their own grid. dciodvfy finds no error that the source does not have.
void TestExportValid::elementsFitTheClass() {
  QFETCH(QString, source);
  QFETCH(QByteArray, element);
  QFETCH(bool, isThere);
  NEED_DATA(dataPath(source.toStdString()));
  folder_ = std::make_unique<QTemporaryDir>();
  const QString path = QString::fromStdString(dataPath(source.toStdString()));
  const Outcome done = exported(path, QStringLiteral("series --onto SELF"));
  QVERIFY2(done.status == 0, done.err);
  DcmTag tag;
  QVERIFY(DcmTag::findTagFromName(element.constData(), tag).good());
  StoredFile made(storedFilesIn(at("out.dcm")).value(0));
  QVERIFY(!made.said(DCM_SOPInstanceUID).empty());
  QCOMPARE(bool(made.file.getDataset()->tagExists(tag)), isThere);
  NEED_DCIODVFY();
  QCOMPARE(newErrorsInMiddle(at("out.dcm"), path), QStringList());
}

void TestExportValid::narrowWindowsAreExact_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<int>("index");
  QTest::newRow("in HU") << QStringLiteral("ct-chest-lidc0314-138") << 70;
  QTest::newRow("a rescale a slice") << QStringLiteral("pet-ct/sts019-pet") << 30;
}

// Windows narrower than 1 follow LINEAR_EXACT (slices.md 3), in the picture and in the file.
void TestExportValid::narrowWindowsAreExact() {
  QFETCH(QString, source);
  QFETCH(int, index);
  NEED_DATA(dataPath(source.toStdString()));
  folder_ = std::make_unique<QTemporaryDir>();
  const QString path = QString::fromStdString(dataPath(source.toStdString()));
  const QString window = QStringLiteral("40,0.5");
  const Outcome done = exported(path, QStringLiteral("gsps --window ") + window);
  QVERIFY2(done.status == 0, done.err);
  StoredFile made(at("out.dcm"));
  QCOMPARE(textIn(*made.file.getDataset(), DCM_VOILUTFunction), std::string("LINEAR_EXACT"));
  const QByteArray wanted = framePicture(path, index, {QStringLiteral("--window"), window});
  const QByteArray shown = framePicture(
      path, index, {QStringLiteral("--no-graphics"), QStringLiteral("--presentation"), at("out.dcm")});
  QVERIFY2(!QImage::fromData(wanted).isNull(), wanted);
  QVERIFY2(QImage::fromData(shown) == QImage::fromData(wanted), shown.left(500));
  if (source.startsWith(QLatin1String("ct"))) QCOMPARE(greysOf(wanted), (std::set{0, 128, 255}));
  NEED_DCIODVFY();
  QStringList errors = newErrors(at("out.dcm"), storedFilesIn(path).value(0).toStdString());
  errors.removeIf([](const QString& error) { return error.contains(QLatin1String("(0x0008,0x1155)")); });
  QCOMPARE(errors, QStringList());
}

VOLUMEN_TEST(TestExportValid);
#include "tst_export_valid.moc"
