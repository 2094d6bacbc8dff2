// Guards import.md, "Safety": a header forged by a compromised worker is refused if it contradicts itself.
// tests/fuzz/fuzz_answer found the case of a slice's parts.
#include <functional>

#include "io/dicom/inspect_files.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using dicom::FileHeader;
using Lie = void (*)(FileHeader&);

constexpr std::pair<const char*, Lie> lies[] = {
    {"the truth", [](FileHeader&) {}},
    {"another path", [](FileHeader& h) { h.path += "x"; }},
    {"no columns", [](FileHeader& h) { h.format.columns = 0; }},
    {"more rows than DICOM can say", [](FileHeader& h) { h.format.rows = 70000; }},
    {"bits that do not fit", [](FileHeader& h) { h.format.bitsStored = 17; }},
    {"a bit of two", [](FileHeader& h) { h.format.bitsAllocated = 1; }},
    {"bits that are compressed",
     [](FileHeader& h) {
       h.format.bitsAllocated = h.format.bitsStored = 1;
       h.format.highBit = 0;
       h.syntax = dicom::transferSyntax("1.2.840.10008.1.2.5");
     }},
    {"two samples", [](FileHeader& h) { h.format.samples = 2; }},
    {"more frames than pieces of data", [](FileHeader& h) { h.format.frames = 2; }},
    {"more frames than any picture has", [](FileHeader& h) { h.format.frames = 0x7fffffff; }},
    {"no slice", [](FileHeader& h) { h.slices.clear(); }},
    {"three slices of one frame", [](FileHeader& h) { h.slices.assign(3, h.slices.front()); }},
    {"a slice of no frame", [](FileHeader& h) { h.slices.front().frame = 1; }},
    {"a slice before the first frame", [](FileHeader& h) { h.slices.front().frame = -1; }},
    {"values of separators that are missing", [](FileHeader& h) { h.slices.front().separators.clear(); }},
    {"values of separators that nobody knows",
     [](FileHeader& h) { h.slices.front().separators.emplace_back(); }},
    {"a mosaic without tiles",
     [](FileHeader& h) {
       h.mosaic = dicom::Mosaic{4, 3, 0};
     }},
    {"a mosaic smaller than its tiles",
     [](FileHeader& h) {
       h.mosaic = dicom::Mosaic{3, 3, 1};
     }},
};

}  // namespace

class TestHeaderCheck : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void liesAreRefused_data();
  void liesAreRefused();
};

void TestHeaderCheck::liesAreRefused_data() {
  QTest::addColumn<int>("lie");
  for (int n = 0; n < int(std::size(lies)); ++n) QTest::newRow(lies[n].first) << n;
}

void TestHeaderCheck::liesAreRefused() {
  QFETCH(int, lie);
  const DicomFolder folder;
  folder.add("a", sliceAt(0, 1));
  dicom::Inspection said = dicom::inspect(folder.path("a"));
  QVERIFY(said.kind == dicom::Inspection::Kind::picture);
  lies[lie].second(said.header);
  dicom::checkInspection(folder.path("a"), said);
  QVERIFY((said.kind == dicom::Inspection::Kind::picture) == (lie == 0));
}

VOLUMEN_TEST(TestHeaderCheck);
#include "tst_header_check.moc"
