// Guards import.md: segments of SEG objects are read bit by bit and placed by their geometry, overlapping
// ones separately.
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
#include "tests/unit/io/made_segmentation.h"
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
  void framesMayBeginOnWholeBytes_data();
  void framesMayBeginOnWholeBytes();
  void fractionsAreSetFromOneHalfOn();
  void pixelsOfLabelMapsAreNumbers_data();
  void pixelsOfLabelMapsAreNumbers();
  void labelMapsMayHaveAPalette();
  void coloursAreThoseOfCieLab_data();
  void coloursAreThoseOfCieLab();
  void byteOrderDoesNotMatter();
  void repeatedFramesAreUnited();
};

namespace {

/// Returns the smallest box that holds a mask.
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
  // A pixel is set if its number, counted over all frames, has an odd number of one bits.
  const auto isSet = [](std::size_t n) { return std::popcount(n) % 2 == 1; };
  MadeSegmentation made{columns, rows, frames};
  const std::size_t bits = std::size_t(columns * rows * frames);
  made.bytes.assign((bits + 15) / 16 * 2, 0);
  for (std::size_t n = 0; n < bits; ++n)
    if (isSet(n)) made.bytes[n / 8] |= std::uint8_t(1 << n % 8);
  const DicomFolder folder;
  writeSegmentation(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(s, s ? "" : s.message().c_str());
  const Result<VoxelGeometry> grid = gridOf(*s);
  QVERIFY2(grid, grid ? "" : grid.message().c_str());
  QCOMPARE(grid->spacing(), glm::dvec3(0.7, 0.5, 2));
  const DenseLabels map = withLabel(LabelMap(*grid), 1, maskOf(*s, 0, *grid)).dense();
  for (std::size_t n = 0; n < bits; ++n) QCOMPARE(map.labels[n] == 1, isSet(n));
}

void TestSegmentationObject::framesMayBeginOnWholeBytes_data() {
  QTest::addColumn<int>("columns");
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("frames");
  QTest::addColumn<bool>("isTold");
  // Frames of 9 and of 15 bits take 2 bytes each, so that the layouts differ in length. If both have the same
  // length, bits run on from frame to frame.
  QTest::newRow("3 x 3, 8 frames") << 3 << 3 << 8 << true;
  QTest::newRow("5 x 3, 31 frames") << 5 << 3 << 31 << true;
  QTest::newRow("1 x 1, 5 frames") << 1 << 1 << 5 << true;
  QTest::newRow("4 x 2, 3 frames") << 4 << 2 << 3 << false;
}

void TestSegmentationObject::framesMayBeginOnWholeBytes() {
  QFETCH(int, columns);
  QFETCH(int, rows);
  QFETCH(int, frames);
  QFETCH(bool, isTold);
  const auto isSet = [](std::size_t n) { return std::popcount(n) % 2 == 1; };
  MadeSegmentation made{columns, rows, frames};
  const std::size_t perFrame = std::size_t(columns * rows), stride = (perFrame + 7) / 8 * 8;
  made.bytes.assign(stride / 8 * std::size_t(frames), 0);
  for (std::size_t n = 0; n < perFrame * std::size_t(frames); ++n)
    if (isSet(n)) {
      const std::size_t bit = n / perFrame * stride + n % perFrame;
      made.bytes[bit / 8] |= std::uint8_t(1 << bit % 8);
    }
  const DicomFolder folder;
  writeSegmentation(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(s, s ? "" : s.message().c_str());
  for (std::size_t n = 0; n < perFrame * std::size_t(frames); ++n)
    QCOMPARE(s->isSet(n / perFrame, int(n % perFrame) % columns, int(n % perFrame) / columns), isSet(n));
  QCOMPARE(s->notes.size(), std::size_t(isTold));
  if (isTold) QVERIFY2(s->notes[0].find("begin on whole bytes") != std::string::npos, s->notes[0].c_str());
}

void TestSegmentationObject::fractionsAreSetFromOneHalfOn() {
  const DicomFolder folder;
  MadeSegmentation made{2, 2, 1, 8, "FRACTIONAL", {0, 49, 50, 100}};
  writeSegmentation(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(s, s ? "" : s.message().c_str());
  QVERIFY(s->fractional && !s->isSet(0, 0, 0) && !s->isSet(0, 1, 0) && s->isSet(0, 0, 1) &&
          s->isSet(0, 1, 1));
}

void TestSegmentationObject::pixelsOfLabelMapsAreNumbers_data() {
  QTest::addColumn<int>("bits");
  QTest::addColumn<int>("padding");  // PixelPaddingValue; negative for none
  QTest::addColumn<QList<int>>("segments");
  QTest::addColumn<QList<int>>("pixels");  // two frames of two pixels each
  QTest::addColumn<QStringList>("found");
  QTest::addColumn<QByteArray>("told");
  const auto row = [](const char* name, int bits, int padding, const QList<int>& segments,
                      const QList<int>& pixels, const QStringList& found, const char* told = "") {
    QTest::newRow(name) << bits << padding << segments << pixels << found << QByteArray(told);
  };
  const QStringList oneAndTwo{QStringLiteral("1: 2"), QStringLiteral("2: 1")};
  row("8 bits", 8, 0, {1, 2}, {0, 1, 2, 1}, oneAndTwo);
  row("16 bits", 16, 0, {1, 2}, {0, 1, 2, 1}, oneAndTwo);
  row("no padding value", 8, -1, {1, 2}, {0, 1, 2, 1}, oneAndTwo);
  row("a background that is described", 8, 0, {0, 1, 2}, {0, 1, 2, 1}, oneAndTwo);
  row("gaps in the numbers", 16, 0, {2035, 11}, {2035, 0, 11, 11},
      {QStringLiteral("2035: 1"), QStringLiteral("11: 2")});
  row("another background", 8, 255, {0, 3}, {255, 0, 3, 255},
      {QStringLiteral("0: 1"), QStringLiteral("3: 1")});
  row("another background, described", 8, 7, {7, 1}, {7, 7, 7, 1}, {QStringLiteral("1: 1")});
  row("numbers that nothing describes", 8, 0, {1, 2}, {9, 1, 2, 8},
      {QStringLiteral("1: 1"), QStringLiteral("2: 1")}, "segments that it does not describe (8, 9)");
}

void TestSegmentationObject::pixelsOfLabelMapsAreNumbers() {
  QFETCH(int, bits);
  QFETCH(int, padding);
  QFETCH(QList<int>, segments);
  QFETCH(QList<int>, pixels);
  QFETCH(QStringList, found);
  QFETCH(QByteArray, told);
  MadeSegmentation made{2, 1, 2, bits, "LABELMAP", {}};
  for (const int pixel : pixels)
    for (int shift = 0; shift < bits; shift += 8) made.bytes.push_back(std::uint8_t(pixel >> shift));
  made.edit = [&](DcmItem& data) {
    if (padding >= 0) putWord(data, 0x0028, 0x0120, unsigned(padding));
    data.findAndDeleteElement(DCM_SegmentSequence);
    for (const int number : segments)
      putWord(addItem(data, 0x0062, 0x0002), 0x0062, 0x0004, unsigned(number));
  };
  const DicomFolder folder;
  writeSegmentation(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(s, s ? "" : s.message().c_str());
  QStringList counts;
  for (std::size_t n = 0; n < s->segments.size(); ++n)
    counts << QStringLiteral("%1: %2").arg(s->segments[n].number).arg(pixelsOf(*s, n));
  QCOMPARE(counts, found);
  QCOMPARE(s->notes.size(), std::size_t(!told.isEmpty()));
  if (!told.isEmpty()) QVERIFY2(s->notes[0].find(told) != std::string::npos, s->notes[0].c_str());
}

void TestSegmentationObject::labelMapsMayHaveAPalette() {
  MadeSegmentation made{2, 1, 2, 8, "LABELMAP", {0, 1, 1, 0}};
  made.edit = [](DcmItem& data) {
    put(data, 0x0028, 0x0004, "PALETTE COLOR");
    const Uint16 descriptor[] = {2, 0, 16}, red[] = {0, 200 * 257}, green[] = {0, 100 * 257},
                 blue[] = {0, 50 * 257};
    for (const auto& [tag, entries] : {std::pair(DCM_RedPaletteColorLookupTableData, red),
                                       {DCM_GreenPaletteColorLookupTableData, green},
                                       {DCM_BluePaletteColorLookupTableData, blue}})
      data.putAndInsertUint16Array(tag, entries, 2);
    for (const DcmTagKey& tag :
         {DCM_RedPaletteColorLookupTableDescriptor, DCM_GreenPaletteColorLookupTableDescriptor,
          DCM_BluePaletteColorLookupTableDescriptor})
      data.putAndInsertUint16Array(tag, descriptor, 3);
  };
  const DicomFolder folder;
  writeSegmentation(folder.path("seg"), made);
  const Result<Segmentation> s = loadSegmentation(folder.path("seg"));
  QVERIFY2(s, s ? "" : s.message().c_str());
  QCOMPARE(pixelsOf(*s, 0), std::int64_t(2));
  QVERIFY(s->segments.at(0).colour == glm::u8vec3(200, 100, 50));
}

void TestSegmentationObject::coloursAreThoseOfCieLab_data() {
  QTest::addColumn<QList<int>>("words");
  QTest::addColumn<QList<int>>("rgb");
  // CIELab for D50, (L 655.35, (a + 128) 257, (b + 128) 257), of well-known colours; +- 2 for rounding of the
  // words.
  QTest::newRow("white") << QList<int>{65535, 32896, 32896} << QList<int>{255, 255, 255};
  QTest::newRow("black") << QList<int>{0, 32896, 32896} << QList<int>{0, 0, 0};
  QTest::newRow("middle grey, L 53.39") << QList<int>{34988, 32896, 32896} << QList<int>{127, 127, 127};
  QTest::newRow("red, L 54.29, a 80.81, b 69.89") << QList<int>{35579, 53664, 50858} << QList<int>{255, 0, 0};
}

void TestSegmentationObject::coloursAreThoseOfCieLab() {
  QFETCH(QList<int>, words);
  QFETCH(QList<int>, rgb);
  const DicomFolder folder;
  MadeSegmentation made;
  made.edit = [&](DcmItem& data) {
    DcmItem* segment = nullptr;
    data.findAndGetSequenceItem(DCM_SegmentSequence, segment);
    const Uint16 lab[] = {Uint16(words[0]), Uint16(words[1]), Uint16(words[2])};
    segment->putAndInsertUint16Array(DCM_RecommendedDisplayCIELabValue, lab, 3);
  };
  writeSegmentation(folder.path("seg"), made);
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

// Three frames of 9 bits belong to one segment. The last has the position of the first.
void TestSegmentationObject::repeatedFramesAreUnited() {
  const DicomFolder folder;
  MadeSegmentation made{.frames = 3, .bytes = {0x03, 0x02, 0x18, 0x00}};  // pixels 0 1; 0; 1 2
  made.edit = [](DcmItem& data) {
    DcmItem *frame = nullptr, *plane = nullptr;
    data.findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, frame, 2);
    frame->findAndGetSequenceItem(DCM_PlanePositionSequence, plane);
    put(*plane, 0x0020, 0x0032, "10\\20\\0.0");
  };
  writeSegmentation(folder.path("seg"), made);
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
