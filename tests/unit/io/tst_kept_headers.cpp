// Guards io/dicom/kept_headers.h: a header is read once, and never used if the file may have changed since.
#include <filesystem>
#include <fstream>

#include "io/dicom/kept_headers.h"
#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestKeptHeaders : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void slicesAreLookedAtOnce();
  void aChangedFileIsReadAgain_data();
  void aChangedFileIsReadAgain();
  void whatMayChangeUnseenIsNotKept();
  void whileHeldFreshFilesAreKept();
};

void TestKeptHeaders::slicesAreLookedAtOnce() {
  const std::string folder = dataPath("ct-chest-lidc0314-138");
  NEED_DATA(folder);
  const auto study = openStudy(folder);
  QVERIFY(study && study->volumes.size() == 1);
  for (const std::string& file : study->volumes[0].files) QVERIFY(dicom::keptHeader(file));
}

void TestKeptHeaders::aChangedFileIsReadAgain_data() {
  QTest::addColumn<int>("device");
  QTest::addColumn<int>("inode");
  QTest::addColumn<int>("size");
  QTest::addColumn<qint64>("modified");
  QTest::addColumn<qint64>("changed");
  QTest::addColumn<bool>("isKept");
  const qint64 hour = 3'600'000'000'000;
  QTest::addRow("as it was") << 0 << 0 << 0 << qint64(0) << qint64(0) << true;
  QTest::addRow("on another disk") << 1 << 0 << 0 << qint64(0) << qint64(0) << false;
  QTest::addRow("another file in its place") << 0 << 1 << 0 << qint64(0) << qint64(0) << false;
  QTest::addRow("longer") << 0 << 0 << 1 << qint64(0) << qint64(0) << false;
  QTest::addRow("written to by a nanosecond") << 0 << 0 << 0 << qint64(1) << qint64(1) << false;
  QTest::addRow("written to, its time put back") << 0 << 0 << 0 << qint64(0) << hour << false;
}

void TestKeptHeaders::aChangedFileIsReadAgain() {
  QFETCH(int, device);
  QFETCH(int, inode);
  QFETCH(int, size);
  QFETCH(qint64, modified);
  QFETCH(qint64, changed);
  QFETCH(bool, isKept);
  // Any old file will do, as only its state is used.
  const std::string folder = dataPath("ct-chest-lidc0314-138");
  NEED_DATA(folder);
  const std::string path = std::filesystem::directory_iterator(folder)->path().string();
  const auto now = fileState(path);
  QVERIFY(now);
  FileState before = *now;
  before.device += device, before.inode += inode, before.size += size;
  before.modifiedNs -= modified, before.changedNs -= changed;
  dicom::FileHeader header;
  header.patientName = "kept";
  dicom::keepHeader(path, before, header);
  const auto kept = dicom::keptHeader(path);
  QCOMPARE(bool(kept), isKept);
  if (kept) QCOMPARE(kept->patientName, std::string("kept"));
  dicom::keepHeader(path, *now, dicom::inspect(path).header);  // restores it for other tests
}

// A slice is overwritten immediately by one of equal length at another position. The times of some file
// systems would not reveal that.
void TestKeptHeaders::whatMayChangeUnseenIsNotKept() {
  const DicomFolder folder;
  const double z[] = {0, 1, 2};
  for (int n = 0; n < 3; ++n) folder.add(numbered("s", n), sliceAt(z[n], n));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  for (const std::string& file : study.volumes[0].files) QVERIFY(!dicom::keptHeader(file));
  folder.add("s2", sliceAt(5, 2));
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded);
  QVERIFY(warns(loaded->warnings, "missing") || warns(loaded->warnings, "uneven"));
}

void TestKeptHeaders::whileHeldFreshFilesAreKept() {
  const DicomFolder folder;
  for (int n = 0; n < 3; ++n) folder.add(numbered("s", n), sliceAt(n, n));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  {
    const dicom::HeldHeaders held;
    QVERIFY(loadSeries(study.volumes[0]));
    for (const std::string& file : study.volumes[0].files) QVERIFY(dicom::keptHeader(file));
  }
  for (const std::string& file : study.volumes[0].files) QVERIFY(!dicom::keptHeader(file));
}

VOLUMEN_TEST(TestKeptHeaders);
#include "tst_kept_headers.moc"
