// Guards import.md: segments of SEG objects come out bit by bit, placed by their geometry, overlapping ones
// apart.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <array>
#include <bit>

#include "io/open.h"
#include "io/segmentation.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_objects.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentationObject : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aBoneLiesOnItsCt();
  void overlappingSegmentsAreKeptApart();
  void ownGridHoldsEmptyPlanes();
  void bitsRunOnFromFrameToFrame_data();
  void bitsRunOnFromFrameToFrame();
  void fractionsAreSetFromOneHalfOn();
  void coloursAreThoseOfCieLab_data();
  void coloursAreThoseOfCieLab();
  void byteOrderDoesNotMatter();
  void damagedOnesAreRefused_data();
  void damagedOnesAreRefused();
  void wrongValuesAreNamed_data();
  void wrongValuesAreNamed();
  void repeatedFramesAreUnited();
};

namespace {

/// What a made-up object has; one segment in every frame, the frames 2 mm apart along z.
struct Made {
  int columns = 3, rows = 3, frames = 2, bitsAllocated = 1;
  std::string type = "BINARY";
  std::vector<std::uint8_t> bytes = {0xff, 0xff, 0x03};
  std::function<void(DcmItem&)> edit = {};
};

void addFrame(DcmItem& data, int n) {
  DcmItem& groups = addItem(data, 0x5200, 0x9230);
  putWord(addItem(groups, 0x0062, 0x000a), 0x0062, 0x000b, 1);
  put(addItem(groups, 0x0020, 0x9113), 0x0020, 0x0032, "10\\20\\" + std::to_string(2 * n));
}

void write(const std::string& path, const Made& made) {
  writeObject(path, segmentationClass, [&](DcmItem& data) {
    put(data, 0x0062, 0x0001, made.type);
    put(data, 0x0028, 0x0004, "MONOCHROME2");
    put(data, 0x0028, 0x0008, std::to_string(made.frames));
    const unsigned words[][2] = {{0x0002, 1},
                                 {0x0010, unsigned(made.rows)},
                                 {0x0011, unsigned(made.columns)},
                                 {0x0100, unsigned(made.bitsAllocated)},
                                 {0x0101, unsigned(made.bitsAllocated)},
                                 {0x0102, unsigned(made.bitsAllocated - 1)},
                                 {0x0103, 0}};
    for (const auto& [element, value] : words) putWord(data, 0x0028, element, value);
    putWord(data, 0x0062, 0x000e, 100);
    putWord(addItem(data, 0x0062, 0x0002), 0x0062, 0x0004, 1);
    DcmItem& shared = addItem(data, 0x5200, 0x9229);
    put(addItem(shared, 0x0020, 0x9116), 0x0020, 0x0037, "1\\0\\0\\0\\1\\0");
    DcmItem& measures = addItem(shared, 0x0028, 0x9110);
    put(measures, 0x0028, 0x0030, "0.5\\0.7");
    put(measures, 0x0018, 0x0050, "2");
    for (int n = 0; n < made.frames; ++n) addFrame(data, n);
    data.putAndInsertUint8Array(DCM_PixelData, made.bytes.data(), made.bytes.size());
    if (made.edit) made.edit(data);
  });
}

using Edit = std::function<void(DcmItem&)>;

/// The measures of all frames.
DcmItem& measuresOf(DcmItem& data) {
  DcmItem *shared = nullptr, *measures = nullptr;
  data.findAndGetSequenceItem(DCM_SharedFunctionalGroupsSequence, shared);
  shared->findAndGetSequenceItem(DCM_PixelMeasuresSequence, measures);
  return *measures;
}

/// The smallest box that holds a mask.
VoxelBox boxOf(const BitMask& mask) { return *mask.box(); }

}  // namespace

void TestSegmentationObject::aBoneLiesOnItsCt() {
  NEED_DATA(dataPath());
  const Result<Segmentation> s = loadSegmentation(dataPath("dicom-2d/seg-on-CT_small.dcm"));
  QVERIFY2(s, s ? "" : s.message().c_str());
  QCOMPARE(s->segments.size(), std::size_t(1));
  QCOMPARE(s->segments[0].label, std::string("first segment"));
  QCOMPARE(s->segments[0].category.meaning, std::string("Tissue"));
  QCOMPARE(s->segments[0].type.meaning, std::string("Bone"));
  QCOMPARE(pixelsOf(*s, 0), std::int64_t(1832));
  const Result<Study> ct = openStudy(dataPath("dicom-pydicom/test_files/CT_small.dcm"));
  QVERIFY(ct.ok());
  const BitMask mask = maskOf(*s, 0, ct->volumes.at(0).acquired);
  QCOMPARE(mask.count(), std::int64_t(1832));
  QCOMPARE(boxOf(mask), (VoxelBox{{5, 6, 0}, {101, 94, 0}}));
}

void TestSegmentationObject::overlappingSegmentsAreKeptApart() {
  NEED_DATA(dataPath());
  const Result<Segmentation> s = loadSegmentation(dataPath("dicom-2d/seg-overlap-on-CT2.dcm"));
  const Result<Study> ct = openStudy(dataPath("dicom-pydicom/test_files/dicomdirtests/77654033/CT2"));
  QVERIFY2(s, s ? "" : s.message().c_str());
  QVERIFY(ct.ok());
  QCOMPARE(s->segments.size(), std::size_t(2));
  QCOMPARE(s->frames.size(), std::size_t(8));
  std::int64_t slices = 0;
  for (const Series& series : ct->volumes) {
    const BitMask bone = maskOf(*s, 0, series.acquired), spine = maskOf(*s, 1, series.acquired);
    const int last = series.acquired.size.z - 1;
    QCOMPARE(bone.count(), std::int64_t(16 * (last + 1)));
    QCOMPARE(spine.count(), std::int64_t(4 * (last + 1)));
    QCOMPARE(boxOf(bone), (VoxelBox{{4, 4, 0}, {7, 7, last}}));
    QCOMPARE(boxOf(spine), (VoxelBox{{6, 6, 0}, {7, 7, last}}));  // inside the bone
    slices += last + 1;
  }
  QCOMPARE(slices, std::int64_t(4));
}

void TestSegmentationObject::ownGridHoldsEmptyPlanes() {
  NEED_DATA(dataPath());
  const Result<Segmentation> s = loadSegmentation(dataPath("dicom-2d/seg-overlap-on-CT2.dcm"));
  QVERIFY(s.ok());
  const Result<VoxelGeometry> grid = gridOf(*s);
  QVERIFY2(grid, grid ? "" : grid.message().c_str());
  QCOMPARE(grid->size, glm::ivec3(16, 16, 165));  // -99.48 .. 105.52 in steps of 1.25
  QCOMPARE(maskOf(*s, 0, *grid).count(), std::int64_t(64));
  QCOMPARE(maskOf(*s, 1, *grid).count(), std::int64_t(16));
}

void TestSegmentationObject::bitsRunOnFromFrameToFrame_data() {
  QTest::addColumn<int>("columns");
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("frames");
  for (const auto& [x, y, n] : {std::array{3, 3, 2}, {1, 1, 9}, {5, 3, 7}, {8, 2, 3}, {13, 11, 5}})
    QTest::addRow("%d x %d, %d frames", x, y, n) << x << y << n;
}

void TestSegmentationObject::bitsRunOnFromFrameToFrame() {
  QFETCH(int, columns);
  QFETCH(int, rows);
  QFETCH(int, frames);
  // Set is every pixel whose number, through all frames, has an odd number of ones.
  const auto isSet = [](std::size_t n) { return std::popcount(n) % 2 == 1; };
  Made made{columns, rows, frames};
  const std::size_t bits = std::size_t(columns * rows * frames);
  made.bytes.assign((bits + 15) / 16 * 2, 0);
  for (std::size_t n = 0; n < bits; ++n)
    if (isSet(n)) made.bytes[n / 8] |= std::uint8_t(1 << n % 8);
  const DicomFolder folder;
  write(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(s, s ? "" : s.message().c_str());
  const Result<VoxelGeometry> grid = gridOf(*s);
  QVERIFY2(grid, grid ? "" : grid.message().c_str());
  QCOMPARE(grid->spacing(), glm::dvec3(0.7, 0.5, 2));
  const DenseLabels map = withLabel(LabelMap(*grid), 1, maskOf(*s, 0, *grid)).dense();
  for (std::size_t n = 0; n < bits; ++n) QCOMPARE(map.labels[n] == 1, isSet(n));
}

void TestSegmentationObject::fractionsAreSetFromOneHalfOn() {
  const DicomFolder folder;
  Made made{2, 2, 1, 8, "FRACTIONAL", {0, 49, 50, 100}};
  write(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(s, s ? "" : s.message().c_str());
  QVERIFY(s->fractional && !s->isSet(0, 0, 0) && !s->isSet(0, 1, 0) && s->isSet(0, 0, 1) &&
          s->isSet(0, 1, 1));
}

void TestSegmentationObject::coloursAreThoseOfCieLab_data() {
  QTest::addColumn<QList<int>>("words");
  QTest::addColumn<QList<int>>("rgb");
  // CIELab of D50, (L 655.35, (a + 128) 257, (b + 128) 257), of well-known colours; +- 2 for the words'
  // rounding.
  QTest::newRow("white") << QList<int>{65535, 32896, 32896} << QList<int>{255, 255, 255};
  QTest::newRow("black") << QList<int>{0, 32896, 32896} << QList<int>{0, 0, 0};
  QTest::newRow("middle grey, L 53.39") << QList<int>{34988, 32896, 32896} << QList<int>{127, 127, 127};
  QTest::newRow("red, L 54.29, a 80.81, b 69.89") << QList<int>{35579, 53664, 50858} << QList<int>{255, 0, 0};
}

void TestSegmentationObject::coloursAreThoseOfCieLab() {
  QFETCH(QList<int>, words);
  QFETCH(QList<int>, rgb);
  const DicomFolder folder;
  Made made;
  made.edit = [&](DcmItem& data) {
    DcmItem* segment = nullptr;
    data.findAndGetSequenceItem(DCM_SegmentSequence, segment);
    const Uint16 lab[] = {Uint16(words[0]), Uint16(words[1]), Uint16(words[2])};
    segment->putAndInsertUint16Array(DCM_RecommendedDisplayCIELabValue, lab, 3);
  };
  write(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY(s.ok() && s->segments.at(0).colour);
  for (int c = 0; c < 3; ++c)
    QVERIFY2(std::abs(int((*s->segments[0].colour)[c]) - rgb[c]) <= 2,
             qPrintable(QString::number((*s->segments[0].colour)[c])));
}

void TestSegmentationObject::byteOrderDoesNotMatter() {
  NEED_DATA(dataPath());
  const Result<Segmentation> little = loadSegmentation(dataPath("dicom-pydicom/data_store/liver.dcm"));
  const Result<Segmentation> big = loadSegmentation(dataPath("dicom-pydicom/data_store/liver_expb.dcm"));
  QVERIFY2(little, little ? "" : little.message().c_str());
  QVERIFY2(big, big ? "" : big.message().c_str());
  QCOMPARE(little->segments.at(0).label, std::string("Liver"));
  QVERIFY(pixelsOf(*little, 0) > 1000 && little->bits == big->bits);
}

void TestSegmentationObject::damagedOnesAreRefused_data() {
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

void TestSegmentationObject::damagedOnesAreRefused() {
  QFETCH(int, what);
  QFETCH(QString, says);
  const DicomFolder folder;
  Made made;
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
  write(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(!s, "loaded");
  QVERIFY2(s.message().find(says.toStdString()) != std::string::npos && s.message().ends_with("."),
           s.message().c_str());
}

void TestSegmentationObject::wrongValuesAreNamed_data() {
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

void TestSegmentationObject::wrongValuesAreNamed() {
  QFETCH(Edit, edit);
  QFETCH(bool, fractional);
  QFETCH(QByteArray, says);
  const DicomFolder folder;
  Made made;
  if (fractional) made = {2, 2, 2, 8, "FRACTIONAL", {0, 49, 50, 100, 0, 0, 0, 0}};
  write(folder.path("seg"), made);
  QVERIFY(loadSegmentation(folder.path("seg")).ok());
  made.edit = edit;
  write(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(!s, "loaded");
  QVERIFY2(s.message().find(says) != std::string::npos && s.message().starts_with(folder.path("seg")) &&
               s.message().ends_with("."),
           s.message().c_str());
}

// Three frames of 9 bits, the last where the first is, of the same segment.
void TestSegmentationObject::repeatedFramesAreUnited() {
  const DicomFolder folder;
  Made made{.frames = 3, .bytes = {0x03, 0x02, 0x18, 0x00}};  // pixels 0 1; 0; 1 2
  made.edit = [](DcmItem& data) {
    DcmItem *frame = nullptr, *plane = nullptr;
    data.findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, frame, 2);
    frame->findAndGetSequenceItem(DCM_PlanePositionSequence, plane);
    put(*plane, 0x0020, 0x0032, "10\\20\\0.0");
  };
  write(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(s, s ? "" : s.message().c_str());
  QCOMPARE(s->frames.size(), std::size_t(2));
  QCOMPARE(s->frames[1].origin, glm::dvec3(10, 20, 2));
  std::string set;
  for (std::size_t frame = 0; frame < 2; ++frame)
    for (int n = 0; n < 9; ++n) set += s->isSet(frame, n % 3, n / 3) ? '1' : '0';
  QCOMPARE(set, std::string("111000000100000000"));
  QCOMPARE(s->notes.size(), std::size_t(1));
  QVERIFY2(s->notes[0].find("repeat a place of their segment (1)") != std::string::npos, s->notes[0].c_str());
}

VOLUMEN_TEST(TestSegmentationObject);
#include "tst_segmentation_object.moc"
