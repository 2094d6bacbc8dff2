// Guards design.md 7: a DICOMDIR opens its folder. The files it lists are counted, but never followed out of
// the folder.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>

#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Writes a DICOMDIR whose records name these files.
void writeDirectory(const std::string& path, const QByteArrayList& fileIds) {
  DcmFileFormat file;
  DcmDataset& data = *file.getDataset();
  data.putAndInsertString(DCM_SOPClassUID, UID_MediaStorageDirectoryStorage);
  data.putAndInsertString(DCM_SOPInstanceUID, "1.2.3.4.99");
  data.insertEmptyElement(DCM_DirectoryRecordSequence);
  for (int n = 0; n < fileIds.size(); ++n) {
    DcmItem* record = nullptr;
    data.findOrCreateSequenceItem(DCM_DirectoryRecordSequence, record, n);
    record->putAndInsertString(DCM_DirectoryRecordType, "IMAGE");
    record->putAndInsertOFStringArray(DCM_ReferencedFileID, fileIds[n].constData());
  }
  if (file.saveFile(path.c_str(), EXS_LittleEndianExplicit).bad()) qFatal("no DICOMDIR");
}

}  // namespace

class TestDirectory : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void listedFilesAreCounted_data();
  void listedFilesAreCounted();
  void copiesMissNothing_data();
  void copiesMissNothing();
  void aCopyInLowerCaseMissesNothing();
  void unlistedFilesAreFound();
  void linksOutAreNotFollowed();
  void realOnesOpenTheirFolder_data();
  void realOnesOpenTheirFolder();
};

void TestDirectory::listedFilesAreCounted_data() {
  QTest::addColumn<QByteArrayList>("ids");
  QTest::addColumn<QString>("kind");
  const auto row = [](const char* title, const QByteArrayList& ids, const char* kind) {
    QTest::newRow(title) << ids << QString::fromLatin1(kind);
  };
  row("all here", {"s1", "s2"}, "DICOMDIR of 2 files");
  row("in capitals, as on a CD", {"S1", "S2"}, "DICOMDIR of 2 files");
  row("nothing listed", {}, "DICOMDIR of 0 files");
  row("one dangles", {"s1", "s2", "SUB\\S3"}, "DICOMDIR of 3 files, 1 is not here");
  row("two dangle", {"a", "b"}, "DICOMDIR of 2 files, 2 are not here");
  row("parent folder", {"s1", "..\\secret"}, "DICOMDIR of 2 files, 1 leads out of its folder");
  row("absolute", {"/etc/passwd"}, "DICOMDIR of 1 file, 1 leads out of its folder");
  row("device", {"\\dev\\zero"}, "DICOMDIR of 1 file, 1 is not here");
  row("parent folder further in", {"sub\\..\\..\\x", "s1\\.\\s2"},
      "DICOMDIR of 2 files, 2 lead out of its folder");
}

void TestDirectory::listedFilesAreCounted() {
  QFETCH(QByteArrayList, ids);
  QFETCH(QString, kind);
  const DicomFolder folder;
  folder.add("s1", sliceAt(0, 1));
  folder.add("s2", sliceAt(1, 2));
  writeDirectory(folder.path("DICOMDIR"), ids);
  for (const std::string& path : {folder.path("DICOMDIR"), folder.path()}) {
    const Result<Study> study = openStudy(path);
    QVERIFY2(study.ok(), study.ok() ? "" : study.message().c_str());
    QCOMPARE(study->volumes.size(), std::size_t(1));
    QCOMPARE(study->volumes[0].acquired.size.z, 2);
    QCOMPARE(study->other.size(), std::size_t(1));
    QCOMPARE(QString::fromStdString(study->other[0].kind), kind);
  }
}

void TestDirectory::copiesMissNothing_data() {
  QTest::addColumn<QString>("name");
  for (const char* name :
       {"IM0", "im0", "im0.dcm", "IM0.DCM", "im0.ima", "im0;1", "IM0.;1", "im0.dcm;1", "im0."})
    QTest::newRow(name) << QString::fromLatin1(name);
}

// Covers the names that copying programs make of the file ID IM0.
void TestDirectory::copiesMissNothing() {
  QFETCH(QString, name);
  const DicomFolder folder;
  folder.add(name.toStdString(), sliceAt(0, 1));
  writeDirectory(folder.path("dicomdir"), {"IM0"});
  QCOMPARE(folder.open().other.at(0).kind, std::string("DICOMDIR of 1 file"));
}

void TestDirectory::aCopyInLowerCaseMissesNothing() {
  NEED_DATA(dataPath());
  const Result<Study> study = openStudy(dataPath("field-cases/c34-dicomdir-lower-case/dicomdir"));
  QVERIFY(study.ok());
  QCOMPARE(study->volumes.size(), std::size_t(1));
  QCOMPARE(study->other.at(0).kind, std::string("DICOMDIR of 5 files"));
  const auto loaded = loadSeries(study->volumes[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{0, 1, 2, 3, 4}));
}

void TestDirectory::unlistedFilesAreFound() {
  const DicomFolder folder;
  for (int n = 0; n < 3; ++n) folder.add(numbered("s", n), sliceAt(n, n));
  writeDirectory(folder.path("INDEX"), {"s1"});
  const Result<Study> study = openStudy(folder.path("INDEX"));
  QVERIFY(study.ok());
  QCOMPARE(study->volumes.at(0).acquired.size.z, 3);
}

void TestDirectory::linksOutAreNotFollowed() {
  const DicomFolder outside, folder;
  outside.add("secret", sliceAt(0, 1));
  folder.add("s", sliceAt(0, 1));
  writeDirectory(folder.path("DICOMDIR"), {"s", "link"});
  QVERIFY(QFile::link(QString::fromStdString(outside.path("secret")),
                      QString::fromStdString(folder.path("link"))));
  const Result<Study> study = openStudy(folder.path("DICOMDIR"));
  QVERIFY(study.ok());
  QCOMPARE(study->volumes.size(), std::size_t(1));
  QCOMPARE(study->volumes[0].files.size(), std::size_t(1));
  QCOMPARE(study->other.at(0).kind, std::string("DICOMDIR of 2 files, 1 is not here"));
  QCOMPARE(study->refused.at(0).reason, std::string("it is a link out of the folder and is not followed."));
}

void TestDirectory::realOnesOpenTheirFolder_data() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"DICOMDIR", "DICOMDIR-bigEnd", "DICOMDIR-empty.dcm", "DICOMDIR-implicit",
                           "DICOMDIR-nooffset", "DICOMDIR-nopatient", "DICOMDIR-reordered"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

// There are 31 pictures in 24 volumes (the manifest). DICOMDIR-nooffset is itself damaged.
void TestDirectory::realOnesOpenTheirFolder() {
  NEED_DATA(dataPath());
  QFETCH(QString, name);
  const Result<Study> study =
      openStudy(dataPath("dicom-pydicom/test_files/dicomdirtests/" + name.toStdString()));
  QVERIFY(study.ok());
  std::size_t files = 0;
  for (const Series& s : study->volumes) files += s.files.size();
  QCOMPARE(files, std::size_t(31));
  QVERIFY(std::ranges::any_of(study->other, [](const Other& o) { return o.kind == "DICOMDIR of 31 files"; }));
}

VOLUMEN_TEST(TestDirectory);
#include "tst_directory.moc"
