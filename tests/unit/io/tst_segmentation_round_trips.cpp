// Guards export/segmentation_dicom.h: segments survive a DICOM SEG voxel by voxel, overlapping or not, for
// any number of pixels. DCMTK and pydicom read the same.
#include <QProcess>
#include <algorithm>
#include <memory>

#include "io/export/segmentation_dicom.h"
#include "io/segmentation.h"
#include "tests/fixtures/dciodvfy.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/segmentation_slices.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentationRoundTrips : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void masksComeBackAsTheyWent();
  void labelMapsComeBackAsTheyWent();
  void pydicomReadsTheSame();
  void dciodvfyFindsNoError();
  void coloursComeBackAsTheyWent();
};

namespace {

bool sameSaid(const Segment& a, const Segment& b) {
  return a.label == b.label && a.category == b.category && a.type == b.type && a.modifier == b.modifier &&
         a.region == b.region && a.regionModifier == b.regionModifier && a.colour == b.colour &&
         a.structures == b.structures && a.algorithms == b.algorithms && a.algorithm == b.algorithm &&
         a.trackingId == b.trackingId && a.trackingUid == b.trackingUid &&
         std::max(a.algorithmType, SegmentAlgorithm::manual) ==
             std::max(b.algorithmType, SegmentAlgorithm::manual);
}

/// Returns whether each segment is in one of the maps, and there are several maps only if segments overlap.
bool areHeldBy(const std::vector<Segmented>& maps, const std::vector<SegmentVoxels>& in) {
  bool overlap = false;
  for (std::size_t a = 0; a < in.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) overlap = overlap || !intersected(in[a].mask, in[b].mask).empty();
    bool held = false;
    for (const Segmented& map : maps)
      for (const Segment& segment : map.segments)
        held = held || (sameSaid(segment, in[a].segment) &&
                        maskOf(map.labels, std::uint8_t(segment.number)) == in[a].mask);
    if (!held) return false;
  }
  return (maps.size() > 1) == overlap;
}

/// Returns the voxels of segments as read by DCMTK alone: bit by bit, each frame placed by its position.
std::vector<BitMask> readByDcmtk(const std::string& path, const VoxelGeometry& grid, std::size_t segments) {
  std::vector<BitMask> masks(segments, BitMask(grid));
  DcmFileFormat file;
  if (file.loadFile(OFFilename(path.c_str())).bad()) return masks;
  DcmDataset& data = *file.getDataset();
  Sint32 frames = 0;
  const Uint8* bytes = nullptr;
  Uint16 rows = 0, columns = 0;
  data.findAndGetSint32(DCM_NumberOfFrames, frames);
  data.findAndGetUint16(DCM_Rows, rows);
  data.findAndGetUint16(DCM_Columns, columns);
  data.findAndGetUint8Array(DCM_PixelData, bytes);
  for (long n = 0; n < frames; ++n) {
    DcmItem* groups = itemOf(&data, DCM_PerFrameFunctionalGroupsSequence, n);
    Uint16 segment = 0;
    glm::dvec3 at(0);
    itemOf(groups, DCM_SegmentIdentificationSequence)->findAndGetUint16(DCM_ReferencedSegmentNumber, segment);
    for (int a = 0; a < 3; ++a)
      itemOf(groups, DCM_PlanePositionSequence)
          ->findAndGetFloat64(DCM_ImagePositionPatient, at[a], static_cast<unsigned long>(a));
    const int k = int(std::lround(grid.voxelFromPatient(at).z));
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const long bit = (n * rows + y) * columns + x;
        if (bytes[bit / 8] >> bit % 8 & 1) masks[std::size_t(segment) - 1].set({x, y, k});
      }
  }
  return masks;
}

/// Returns a python with pydicom and numpy; empty if there is none.
QString pythonWithPydicom() {
  for (const char* python : {"/usr/bin/python3", "python3"}) {
    QProcess probe;
    probe.start(QString::fromLatin1(python), {QStringLiteral("-c"), QStringLiteral("import pydicom, numpy")});
    if (probe.waitForFinished(60000) && probe.exitCode() == 0 && probe.exitStatus() == QProcess::NormalExit)
      return QString::fromLatin1(python);
  }
  return {};
}

}  // namespace

void TestSegmentationRoundTrips::masksComeBackAsTheyWent() {
  const Seeds seeds = seedsOf(250, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    const QByteArray where = "seed " + QByteArray::number(seed);
    Chance chance{std::uint64_t(seed)};
    const Slices slices({1 + chance.below(40), 1 + chance.below(40)},
                        even(1 + chance.below(9), chance.between(0.3, 4)), chance);
    QVERIFY2(slices.isThere(), where);
    std::vector<SegmentVoxels> in;
    for (int n = 0; n <= chance.below(4); ++n)
      in.push_back({randomSegment(n + 1, chance), randomMask(slices.grid, chance)});
    if (std::ranges::all_of(in, [](const SegmentVoxels& s) { return s.mask.empty(); }))
      in.front().mask.set({0, 0, 0});
    const auto notes = writeSegmentationDicom(in, slices.series, {}, slices.seg());
    QVERIFY2(notes, notes ? "" : (where + notes.message().c_str()));
    QVERIFY2(notes->empty(), notes->empty() ? "" : notes->front().c_str());
    const auto out = loadSegmentation(slices.seg());
    QVERIFY2(out, out ? "" : (where + out.message().c_str()));
    QCOMPARE(out->segments.size(), in.size());
    const std::vector<BitMask> byDcmtk = readByDcmtk(slices.seg(), slices.grid, in.size());
    for (std::size_t n = 0; n < in.size(); ++n) {
      QVERIFY2(sameSaid(out->segments[n], in[n].segment), where);
      QVERIFY2(maskOf(*out, n, slices.grid) == in[n].mask, where);
      QVERIFY2(byDcmtk[n] == in[n].mask, where);
    }
    QVERIFY2(areHeldBy(segmentedOf(*out, slices.grid), in), where);
  }
}

void TestSegmentationRoundTrips::labelMapsComeBackAsTheyWent() {
  const Seeds seeds = seedsOf(100, 1000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed) + 100000};
    const Slices slices({1 + chance.below(40), 1 + chance.below(40)}, even(1 + chance.below(9), 1), chance);
    QVERIFY(slices.isThere());
    Segmented in{{}, LabelMap(slices.grid)};
    const int labels = 1 + chance.below(20);
    for (int n = 1; n <= labels; ++n) in.segments.push_back(randomSegment(n, chance));
    LabelEdit edit(in.labels);
    for (int n = 0; n < 1 + chance.below(4000); ++n)
      edit.set({chance.below(slices.grid.size.x), chance.below(slices.grid.size.y),
                chance.below(slices.grid.size.z)},
               std::uint8_t(1 + chance.below(labels)));
    in.labels = edit.done();
    const auto notes = writeSegmentationDicom({&in, 1}, slices.series, {}, slices.seg());
    QVERIFY2(notes, notes ? "" : notes.message().c_str());
    const auto out = loadSegmentation(slices.seg());
    QVERIFY2(out, out ? "" : out.message().c_str());
    const std::vector<Segmented> maps = segmentedOf(*out, slices.grid);
    QCOMPARE(maps.size(), std::size_t(1));
    QVERIFY2(maps[0].labels == in.labels, qPrintable(QString::number(seed)));
    for (std::size_t n = 0; n < in.segments.size(); ++n) {
      QVERIFY(sameSaid(maps[0].segments[n], in.segments[n]));
      QCOMPARE(maps[0].segments[n].number, in.segments[n].number);
    }
  }
}

// Compares sums of each frame of pixel_array, so that a moved pixel is noticed. They are plain or weighted by
// x, y and x^2 y, counted from 1.
void TestSegmentationRoundTrips::pydicomReadsTheSame() {
  const QString python = pythonWithPydicom();
  if (python.isEmpty()) QSKIP("pydicom and numpy (python3-pydicom) are not installed");
  const QString script = QStringLiteral(
      "import sys, pydicom, numpy as np\n"
      "for path in sys.argv[1:]:\n"
      " d = pydicom.dcmread(path); a = d.pixel_array.reshape(-1, d.Rows, d.Columns).astype('int64')\n"
      " y, x = np.mgrid[1:d.Rows+1, 1:d.Columns+1]\n"
      " for n, f in enumerate(a): "
      "print(d.PerFrameFunctionalGroupsSequence[n].SegmentIdentificationSequence[0]"
      ".ReferencedSegmentNumber, f.sum(), (f*x).sum(), (f*y).sum(), (f*x*y*x).sum())\n");
  QStringList arguments{QStringLiteral("-c"), script};
  std::vector<std::unique_ptr<Slices>> all;
  QStringList expected;
  for (int seed = 1; seed <= 40; ++seed) {
    Chance chance{std::uint64_t(seed)};
    all.push_back(std::make_unique<Slices>(glm::ivec2(1 + chance.below(40), 1 + chance.below(40)),
                                           even(1 + chance.below(9), 2), chance));
    const Slices& slices = *all.back();
    std::vector<SegmentVoxels> in;
    for (int n = 0; n < 2; ++n) in.push_back({randomSegment(n + 1, chance), randomMask(slices.grid, chance)});
    in.front().mask.set({0, 0, 0});
    QVERIFY(writeSegmentationDicom(in, slices.series, {}, slices.seg()).ok());
    arguments << QString::fromStdString(slices.seg());
    for (std::size_t n = 0; n < in.size(); ++n)
      for (int k = 0; k < slices.grid.size.z; ++k) {
        qint64 sums[4] = {};
        for (int y = 0; y < slices.grid.size.y; ++y)
          for (int x = 0; x < slices.grid.size.x; ++x)
            if (in[n].mask.at({x, y, k}))
              sums[0] += 1, sums[1] += x + 1, sums[2] += y + 1, sums[3] += qint64(x + 1) * (x + 1) * (y + 1);
        if (sums[0])
          expected << QStringLiteral("%1 %2 %3 %4 %5")
                          .arg(n + 1)
                          .arg(sums[0])
                          .arg(sums[1])
                          .arg(sums[2])
                          .arg(sums[3]);
      }
  }
  QProcess reader;
  reader.start(python, arguments);
  QVERIFY(reader.waitForFinished(120000));
  const QStringList read =
      QString::fromUtf8(reader.readAllStandardOutput()).split(QLatin1Char('\n'), Qt::SkipEmptyParts);
  QVERIFY2(reader.exitCode() == 0, reader.readAllStandardError());
  QCOMPARE(read, expected);
}

// Covers rare contents of real series: one pixel a frame, one slice, overlapping segments, hundreds of
// segments.
void TestSegmentationRoundTrips::dciodvfyFindsNoError() {
  NEED_DCIODVFY();
  const Seeds seeds = seedsOf(8, 200);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const glm::ivec2 size =
        chance.oneIn(4) ? glm::ivec2(1) : glm::ivec2(1 + chance.below(40), 1 + chance.below(40));
    const Slices slices(size, even(1 + chance.below(9), chance.between(0.3, 4)), chance);
    std::vector<SegmentVoxels> in;
    for (int n = chance.oneIn(8) ? 255 : 1 + chance.below(4); n > 0; --n)
      in.push_back({randomSegment(n, chance), randomMask(slices.grid, chance)});
    in.front().mask.set({0, 0, 0});
    const auto notes = writeSegmentationDicom(in, slices.series, {}, slices.seg());
    QVERIFY2(notes, notes ? "" : notes.message().c_str());
    const QStringList errors = dciodvfyErrors(QString::fromStdString(slices.seg()));
    QVERIFY2(errors.isEmpty(),
             qPrintable(QStringLiteral("seed %1: %2").arg(seed).arg(errors.join(QLatin1Char('\n')))));
  }
}

// The words of CIELab resolve all of sRGB. Tests 255 colours a file, thousands in all.
void TestSegmentationRoundTrips::coloursComeBackAsTheyWent() {
  Chance chance(5);
  const Slices slices({16, 16}, even(1, 1), chance);
  for (int round = 0; round < 12; ++round) {
    std::vector<SegmentVoxels> in;
    for (int n = 0; n < 255; ++n) {
      in.push_back({randomSegment(n + 1, chance), BitMask(slices.grid)});
      in.back().mask.set({n % 16, n / 16, 0});
    }
    in[0].segment.colour = glm::u8vec3(0);
    in[1].segment.colour = glm::u8vec3(255);
    in[2].segment.colour = glm::u8vec3(0, 0, 255);
    QVERIFY(writeSegmentationDicom(in, slices.series, {}, slices.seg()).ok());
    const auto out = loadSegmentation(slices.seg());
    QVERIFY(out.ok());
    for (std::size_t n = 0; n < in.size(); ++n) QVERIFY(out->segments[n].colour == in[n].segment.colour);
  }
}

VOLUMEN_TEST(TestSegmentationRoundTrips);
#include "tst_segmentation_round_trips.moc"
