// Guards io/dicom/packed_headers.h: headers come back as they were, and those of a series take little memory.
#include <filesystem>
#include <limits>

#include "io/dicom/packed_headers.h"
#include "io/worker/dicom_fields.h"
#include "io/worker/worker.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestPackedHeaders : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyComeBackAsTheyWere_data();
  void theyComeBackAsTheyWere();
  void aSeriesTakesLittle();
  void whatIsNotFiniteStays();
};

namespace {

std::vector<std::uint8_t> bytesOf(const dicom::FileHeader& header) {
  worker::MemoryWriter writer;
  writer.write(header);
  return std::move(writer).take();
}

// Headers of slices that were written, in one series and beside it.
std::vector<dicom::FileHeader> headersOf(int count) {
  const DicomFolder folder;
  std::vector<dicom::FileHeader> all;
  for (int n = 0; n < count; ++n) {
    DicomPicture slice = sliceAt(1.5 * n, n);
    if (n % 7 == 3) slice.seriesUid = "1.2.3";
    folder.add(numbered("slice", n), slice);
    all.push_back(dicom::inspect(folder.path(numbered("slice", n))).header);
  }
  return all;
}

}  // namespace

void TestPackedHeaders::theyComeBackAsTheyWere_data() {
  QTest::addColumn<QString>("folder");
  QTest::newRow("written slices") << QString();
  for (const char* name : {"ct-chest-lidc0314-138", "dicom-pydicom", "pet-ct", "field-cases"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

void TestPackedHeaders::theyComeBackAsTheyWere() {
  QFETCH(QString, folder);
  std::vector<dicom::FileHeader> headers = headersOf(folder.isEmpty() ? 120 : 0);
  if (!folder.isEmpty()) {
    const std::string path = dataPath(folder.toStdString());
    NEED_DATA(path);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
      if (!entry.is_regular_file()) continue;
      const dicom::Inspection found = dicom::inspect(entry.path().string());
      if (found.kind == dicom::Inspection::Kind::picture) headers.push_back(found.header);
    }
  }
  QVERIFY(headers.size() > 5);
  dicom::PackedHeaders packed;
  for (const dicom::FileHeader& header : headers) packed.add(header);
  QCOMPARE(packed.size(), headers.size());
  for (std::size_t n = 0; n < headers.size(); ++n)
    QVERIFY2(bytesOf(packed.at(n)) == bytesOf(headers[n]), headers[n].path.c_str());
}

// Each file of a series takes a few hundred bytes in place of thousands.
void TestPackedHeaders::aSeriesTakesLittle() {
  const std::vector<dicom::FileHeader> headers = headersOf(300);
  dicom::PackedHeaders packed;
  for (const dicom::FileHeader& header : headers) packed.add(header);
  QVERIFY2(packed.bytes() / headers.size() <= 400,
           qPrintable(QString::number(packed.bytes() / headers.size())));
}

// Workers hand over finite numbers alone.
void TestPackedHeaders::whatIsNotFiniteStays() {
  worker::stop();
  dicom::FileHeader header = headersOf(1)[0];
  header.slices[0].slope = std::numeric_limits<double>::infinity();
  dicom::PackedHeaders packed;
  packed.add(header);
  QCOMPARE(packed.at(0).slices[0].slope, header.slices[0].slope);
  QCOMPARE(packed.at(0).path, header.path);
}

VOLUMEN_TEST(TestPackedHeaders);
#include "tst_packed_headers.moc"
