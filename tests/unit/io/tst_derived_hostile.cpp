// Guards import.md ("Safety") for objects that refer to pictures: whatever they hold, they are read or
// refused with a sentence, in bounded time.
#include <QTemporaryDir>
#include <cmath>
#include <functional>
#include <random>

#include "io/contours.h"
#include "io/frames.h"
#include "io/open.h"
#include "io/report.h"
#include "io/segmentation.h"
#include "tests/fixtures/cpu_timer.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_bytes.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/io/read_derived.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestDerivedHostile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void mutatedOnesAreReadOrRefused_data();
  void mutatedOnesAreReadOrRefused();
  void cutOffOnesAreReadOrRefused_data() { mutatedOnesAreReadOrRefused_data(); }
  void cutOffOnesAreReadOrRefused();
  void manyItemsTakeLittleTime_data();
  void manyItemsTakeLittleTime();
  void wrongKindsAreRefused();
  void valuesOfAnotherKindAreNotTaken();
};

namespace {

const char* const objects[] = {"dicom-2d/made-here/pr-on-CT_small.dcm",
                               "dicom-2d/made-here/ko-on-CT_small.dcm",
                               "dicom-2d/pr-without-pixels/pr.dcm",
                               "dicom-2d/sr-tid1500-on-CT_small.dcm",
                               "dicom-2d/sr-tid1500-groups-on-CT_small.dcm",
                               "dicom-2d/seg-on-CT_small.dcm",
                               "dicom-2d/seg-overlap-on-CT2.dcm",
                               "dicom-pydicom/test_files/rtstruct.dcm"};

/// Returns `items` items of a sequence, nested or side by side.
Buffer manyItems(std::uint32_t sequence, const char* sopClass, int items,
                 const std::function<void(Builder&)>& inside) {
  Builder b = Builder::file();
  b.shortElement(0x00080016, "UI", sopClass);
  b.longElement(sequence, "SQ", 0xffffffff);
  for (int n = 0; n < items; ++n) {
    b.tag(0xfffee000);
    b.dword(0xffffffff);
    inside(b);
    b.tag(0xfffee00d);
    b.dword(0);
  }
  b.tag(0xfffee0dd);
  b.dword(0);
  return b.bytes;
}

}  // namespace

void TestDerivedHostile::mutatedOnesAreReadOrRefused_data() {
  QTest::addColumn<QString>("file");
  for (const char* file : objects) QTest::newRow(file) << QString::fromLatin1(file);
}

void TestDerivedHostile::mutatedOnesAreReadOrRefused() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  const std::vector<std::uint8_t> whole = readAll(dataPath(file.toStdString()));
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("mutant")).toStdString();
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 chance(seed);
    std::vector<std::uint8_t> bytes = whole;
    // Changes one to eight bytes after the preamble and the meta header. Odd seeds use critical values.
    constexpr std::uint8_t telling[] = {0, 1, 0x7f, 0x80, 0xff, '\\', 'U', 'S'};
    for (unsigned n = 0; n <= seed % 8; ++n)
      bytes[300 + chance() % (bytes.size() - 300)] =
          seed % 2 ? telling[chance() % 8] : std::uint8_t(chance());
    writeAll(path, bytes);
    const CpuTimer timer;
    QVERIFY2(survives(path), qPrintable(QStringLiteral("seed %1").arg(seed)));
    QVERIFY2(timer.elapsed() < 5000, qPrintable(QStringLiteral("slow: seed %1").arg(seed)));
  }
}

void TestDerivedHostile::cutOffOnesAreReadOrRefused() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  const std::vector<std::uint8_t> whole = readAll(dataPath(file.toStdString()));
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("cut")).toStdString();
  const std::size_t step = whole.size() / 50;
  for (std::size_t size = step; size < whole.size(); size += step) {
    writeAll(path, {whole.begin(), whole.begin() + std::ptrdiff_t(size)});
    QVERIFY2(survives(path), qPrintable(QString::number(size)));
  }
}

void TestDerivedHostile::manyItemsTakeLittleTime_data() {
  QTest::addColumn<QByteArray>("bytes");
  const auto row = [](const char* name, const Buffer& bytes) {
    QTest::newRow(name) << QByteArray(reinterpret_cast<const char*>(bytes.data()), qsizetype(bytes.size()));
  };
  constexpr int many = 150000;
  const auto uid = [](Builder& b) { b.shortElement(0x00081155, "UI", std::to_string(b.bytes.size())); };
  row("references to nothing", manyItems(0x00081115, "1.2.840.10008.5.1.4.1.1.11.1", many, uid));
  row("empty annotations", manyItems(0x00700001, "1.2.840.10008.5.1.4.1.1.11.1", many, [](Builder&) {}));
  row("content items", manyItems(0x0040a730, "1.2.840.10008.5.1.4.1.1.88.33", many,
                                 [](Builder& b) { b.shortElement(0x0040a040, "CS", "CONTAINER"); }));
  row("regions", manyItems(0x30060020, "1.2.840.10008.5.1.4.1.1.481.3", many, [](Builder& b) {
        b.shortElement(0x30060022, "IS", std::to_string(b.bytes.size()));
      }));
  row("text in no character set",
      manyItems(0x30060020, "1.2.840.10008.5.1.4.1.1.481.3", many, [](Builder& b) {
        b.shortElement(0x30060022, "IS", std::to_string(b.bytes.size()));
        b.shortElement(0x30060026, "LO", "\xe4\xf6");
      }));
  Builder deep = Builder::file();
  deep.shortElement(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.88.33");
  for (int level = 0; level < 100000; ++level) {
    deep.longElement(0x0040a730, "SQ", 0xffffffff);
    deep.tag(0xfffee000);
    deep.dword(0xffffffff);
  }
  row("a tree of 100000 levels", deep.bytes);
}

void TestDerivedHostile::manyItemsTakeLittleTime() {
  QFETCH(QByteArray, bytes);
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("many")).toStdString();
  writeAll(path, Buffer(bytes.begin(), bytes.end()));
  const CpuTimer timer;
  QVERIFY(survives(path));
  QVERIFY2(timer.elapsed() < 15000, "slow");  // a quadratic algorithm would take minutes
}

void TestDerivedHostile::wrongKindsAreRefused() {
  NEED_DATA(dataPath());
  const std::string picture = dataPath("dicom-pydicom/test_files/CT_small.dcm");
  const std::string withoutPixels = dataPath("dicom-2d/pr-without-pixels/cr.dcm");
  for (const std::string& path : {picture, withoutPixels, std::string("/nowhere/at/all")}) {
    for (const std::string& said :
         {loadPresentation(path).message(), loadReport(path).message(), loadKeyObjects(path).message(),
          loadContours(path).message(), loadSegmentation(path).message()})
      QVERIFY2(said.starts_with(path + ": ") && said.ends_with("."), said.c_str());
  }
}

// Points are text, a rescale is letters, and a title is no sequence.
void TestDerivedHostile::valuesOfAnotherKindAreNotTaken() {
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("state")).toStdString();
  Builder b = Builder::file();
  b.shortElement(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.11.1");
  b.shortElement(0x00281053, "DS", "two");
  writeAll(path, b.bytes);
  const Result<Presentation> state = loadPresentation(path);
  QVERIFY(!state.ok() && state.message().find("(0028,1053) is no number") != std::string::npos);
  b = Builder::file();
  b.shortElement(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.88.33");
  b.shortElement(0x0040a043, "LO", "Title");
  b.shortElement(0x0040a730, "FL", std::string(64, '\x7f'));
  writeAll(path, b.bytes);
  const Result<Report> report = loadReport(path);
  QVERIFY(report.ok() && report->title.value.empty() && report->groups.empty());
}

VOLUMEN_TEST(TestDerivedHostile);
#include "tst_derived_hostile.moc"
