// Guards import.md: SEG objects that are damaged or hold wrong values give a sentence that names the error.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <functional>

#include "io/segmentation.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_objects.h"
#include "tests/unit/io/made_segmentation.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentationHostile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void damagedOnesAreRefused_data();
  void damagedOnesAreRefused();
  void wrongValuesAreNamed_data();
  void wrongValuesAreNamed();
};

namespace {

using Edit = std::function<void(DcmItem&)>;

/// Returns the pixel measures shared by all frames.
DcmItem& measuresOf(DcmItem& data) {
  DcmItem *shared = nullptr, *measures = nullptr;
  data.findAndGetSequenceItem(DCM_SharedFunctionalGroupsSequence, shared);
  shared->findAndGetSequenceItem(DCM_PixelMeasuresSequence, measures);
  return *measures;
}

}  // namespace

void TestSegmentationHostile::damagedOnesAreRefused_data() {
  QTest::addColumn<int>("what");
  QTest::addColumn<QString>("says");
  QTest::newRow("too few bits") << 0 << QStringLiteral("cut off: 2 of 3 bytes");
  QTest::newRow("frames without groups") << 1 << QStringLiteral("functional groups for 2");
  QTest::newRow("a million frames") << 2 << QStringLiteral("functional groups for 2");
  QTest::newRow("no frames") << 3 << QStringLiteral("NumberOfFrames");
  QTest::newRow("a segment that is not there") << 4 << QStringLiteral("frame 1: its segment");
  QTest::newRow("a segment twice") << 5 << QStringLiteral("two of its segments have the number 1");
  QTest::newRow("eight bits of one") << 6 << QStringLiteral("BitsAllocated");
  QTest::newRow("an unknown type") << 7 << QStringLiteral("SegmentationType is \"LABELMAP\"");
  QTest::newRow("no place") << 8 << QStringLiteral("frame 3: its ImagePositionPatient is missing");
  QTest::newRow("no pixels") << 9 << QStringLiteral("no pixel data");
  QTest::newRow("directions that are none") << 10 << QStringLiteral("right angles");
}

void TestSegmentationHostile::damagedOnesAreRefused() {
  QFETCH(int, what);
  QFETCH(QString, says);
  const DicomFolder folder;
  MadeSegmentation made;
  if (what == 0) made.bytes.resize(2);
  if (what == 6) made.bitsAllocated = 8;
  if (what == 7) made.type = "LABELMAP";
  made.edit = [&](DcmItem& data) {
    if (what >= 1 && what <= 3) put(data, 0x0028, 0x0008, what == 1 ? "3" : what == 2 ? "1000000" : "0");
    if (what == 4 || what == 5) putWord(addItem(data, 0x0062, 0x0002), 0x0062, 0x0004, 1);
    DcmItem* first = nullptr;
    data.findAndGetSequenceItem(DCM_SegmentSequence, first);
    if (what == 4) putWord(*first, 0x0062, 0x0004, 9), data.findAndDeleteSequenceItem(DCM_SegmentSequence, 1);
    if (what == 8) addItem(data, 0x5200, 0x9230), put(data, 0x0028, 0x0008, "3");
    if (what == 8) {
      DcmItem* frame = nullptr;
      data.findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, frame, 2);
      putWord(addItem(*frame, 0x0062, 0x000a), 0x0062, 0x000b, 1);
    }
    if (what == 9) data.findAndDeleteElement(DCM_PixelData);
    if (what == 10) {
      DcmItem* shared = nullptr;
      data.findAndGetSequenceItem(DCM_SharedFunctionalGroupsSequence, shared);
      DcmItem* plane = nullptr;
      shared->findAndGetSequenceItem(DCM_PlaneOrientationSequence, plane);
      put(*plane, 0x0020, 0x0037, "1\\0\\0\\1\\0\\0");
    }
  };
  writeSegmentation(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(!s, "loaded");
  QVERIFY2(s.message().find(says.toStdString()) != std::string::npos && s.message().ends_with("."),
           s.message().c_str());
}

void TestSegmentationHostile::wrongValuesAreNamed_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<bool>("fractional");
  QTest::addColumn<QByteArray>("says");
  const auto add = [](const char* name, const Edit& edit, const char* says, bool fractional = false) {
    QTest::newRow(name) << edit << fractional << QByteArray(says);
  };
  const auto word = [](unsigned group, unsigned element, unsigned value) -> Edit {
    return [=](DcmItem& data) { putWord(data, group, element, value); };
  };
  const auto spacing = [](const char* value) -> Edit {
    return [=](DcmItem& data) { put(measuresOf(data), 0x0028, 0x0030, value); };
  };
  const auto bytes = [](std::size_t count) -> Edit {
    return [=](DcmItem& data) {
      const std::vector<Uint8> zeros(count);
      data.putAndInsertUint8Array(DCM_PixelData, zeros.data(), zeros.size());
    };
  };
  const char* const longer = "longer than Rows x Columns x NumberOfFrames";
  add("too few rows", word(0x0028, 0x0010, 2), "NumberOfFrames (2 x 3 x 2): 4 of 2 bytes");
  add("one row", word(0x0028, 0x0010, 1), longer);
  add("too few columns", word(0x0028, 0x0011, 1), "NumberOfFrames (3 x 1 x 2): 4 of 1 bytes");
  add("too many columns", word(0x0028, 0x0011, 9), "cut off: 4 of 7 bytes");
  add("bytes behind the bits", bytes(6), longer);
  add("bytes behind the fractions", bytes(12), "NumberOfFrames (2 x 2 x 2): 12 of 8 bytes", true);
  add("no row", word(0x0028, 0x0010, 0), "its Rows is 0");
  add("no column", word(0x0028, 0x0011, 0), "its Columns is 0");
  add(
      "Rows missing", [](DcmItem& data) { data.findAndDeleteElement(DCM_Rows); }, "its Rows is missing");
  add(
      "NumberOfFrames missing", [](DcmItem& data) { data.findAndDeleteElement(DCM_NumberOfFrames); },
      "its NumberOfFrames is missing, but it has functional groups for 2 frames");
  add("a negative spacing", spacing("-1\\-1"), R"(PixelSpacing is "-1\-1", not two lengths above 0)");
  add("one spacing", spacing("0.5"), R"(PixelSpacing is "0.5", not)");
  add("no spacing", spacing(""), "frame 1: its PixelSpacing is missing");
  add("three samples a pixel", word(0x0028, 0x0002, 3), "its SamplesPerPixel is 3");
  add("fractions of 0", word(0x0062, 0x000e, 0), "its MaximumFractionalValue is 0", true);
  add("fractions of 16 bits", word(0x0062, 0x000e, 65535), "its MaximumFractionalValue is 65535", true);
}

void TestSegmentationHostile::wrongValuesAreNamed() {
  QFETCH(Edit, edit);
  QFETCH(bool, fractional);
  QFETCH(QByteArray, says);
  const DicomFolder folder;
  MadeSegmentation made;
  if (fractional) made = {2, 2, 2, 8, "FRACTIONAL", {0, 49, 50, 100, 0, 0, 0, 0}};
  writeSegmentation(folder.path("seg"), made);
  QVERIFY(loadSegmentation(folder.path("seg")).ok());
  made.edit = edit;
  writeSegmentation(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(!s, "loaded");
  QVERIFY2(s.message().find(says) != std::string::npos && s.message().starts_with(folder.path("seg")) &&
               s.message().ends_with("."),
           s.message().c_str());
}

VOLUMEN_TEST(TestSegmentationHostile);
#include "tst_segmentation_hostile.moc"
