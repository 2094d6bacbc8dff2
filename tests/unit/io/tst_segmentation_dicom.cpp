// Guards export/segmentation_dicom.h: what is marked comes out of a DICOM SEG voxel by voxel, overlapping or
// not, whatever the number of its pixels; DCMTK and pydicom read the same; dciodvfy finds no error; it names
// the pictures that it lies on.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QElapsedTimer>
#include <QFile>
#include <QProcess>
#include <QStandardPaths>
#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "io/export/segmentation_dicom.h"
#include "io/load.h"
#include "io/open.h"
#include "io/segmentation.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"
#include "viewer/segment/tissue_codes.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentationDicom : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void masksComeBackAsTheyWent();
  void labelMapsComeBackAsTheyWent();
  void pydicomReadsTheSame();
  void coloursComeBackAsTheyWent();
  void whatIsNotSaidIsFilledIn();
  void itNamesItsPictures();
  void sameContentsGiveTheSameFile();
  void slicesBetweenPicturesAreLeftOutAndTold();
  void labelsOfAnotherGridAreThoseOfTheNearestVoxel();
  void framesOfOneFileAreNamed();
  void whatCannotBeWrittenIsRefused();
  void cancelledWritingLeavesNothing();
  void realSeriesAreValid_data();
  void realSeriesAreValid();
};

namespace {

/// A series of slices of a random place and direction, `z` mm along its normal; and the grid that is drawn.
struct Slices {
  DicomFolder folder;
  Series series;
  VoxelGeometry grid;

  Slices(glm::ivec2 size, const std::vector<double>& z, Chance& chance) {
    const glm::dvec3 row = glm::normalize(chance.vector()),
                     column = glm::normalize(glm::cross(row, chance.vector()));
    const auto number = [](double x) { return QString::number(x, 'f', 9).toStdString(); };
    DicomPicture picture;
    picture.columns = size.x;
    picture.rows = size.y;
    picture.pixels = {7};
    picture.spacing = number(chance.between(0.3, 2)) + "\\" + number(chance.between(0.3, 2));
    picture.orientation.clear();
    for (const glm::dvec3 v : {row, column})
      for (int a = 0; a < 3; ++a)
        picture.orientation += (picture.orientation.empty() ? "" : "\\") + number(v[a]);
    const glm::dvec3 corner = 100.0 * chance.vector();
    for (std::size_t n = 0; n < z.size(); ++n) {
      picture.position = corner + z[n] * glm::cross(row, column);
      picture.instance = int(n) + 1;
      picture.edit = [](DcmDataset& data) {
        data.putAndInsertString(DCM_PatientID, "P1");
        data.putAndInsertString(DCM_StudyDescription, "Head");
        data.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.3.7");
        data.putAndInsertString(DCM_ReferringPhysicianName, "Doctor^A");
      };
      folder.add(numbered("s", int(n)), picture);
    }
    const Study study = folder.open();
    if (study.volumes.size() != 1) return;
    series = study.volumes[0];
    grid = series.regular ? series.regular->geometry : series.acquired;
  }
  bool isThere() const { return !series.files.empty(); }
  std::string seg() const { return folder.path("out.seg.dcm"); }
};

std::vector<double> even(int count, double step) {
  std::vector<double> z;
  for (int n = 0; n < count; ++n) z.push_back(n * step);
  return z;
}

BitMask randomMask(const VoxelGeometry& grid, Chance& chance) {
  BitMask mask(grid);
  const double share = chance.oneIn(4) ? 1 : chance.share();
  for (int k = 0; k < grid.size.z; ++k) {
    if (chance.oneIn(4)) continue;  // empty slices
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i)
        if (chance.share() < share) mask.set({i, j, k});
  }
  return mask;
}

Segment randomSegment(int number, Chance& chance) {
  const TissueCode& tissue = tissueCodes()[std::size_t(chance.below(int(tissueCodes().size())))];
  static const char* const names[] = {"Liver", "Knochen, größer", "心臓", "a 'b' \"c\"", "3"};
  Segment segment{.number = number, .label = names[chance.below(5)]};
  segment.category = tissue.category;
  segment.type = tissue.type;
  if (chance.oneIn(2)) segment.modifier = chance.oneIn(2) ? rightSide() : leftSide();
  segment.colour = glm::u8vec3(chance.below(256), chance.below(256), chance.below(256));
  if (chance.oneIn(2)) segment.algorithm = "Threshold";
  return segment;
}

bool sameSaid(const Segment& a, const Segment& b) {
  return a.label == b.label && a.category == b.category && a.type == b.type && a.modifier == b.modifier &&
         a.colour == b.colour && a.algorithm == b.algorithm;
}

/// Whether each of these is in one of the maps, of which there are several only where segments overlap.
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

std::string textOf(DcmItem& item, const DcmTagKey& tag) {
  OFString text;
  return item.findAndGetOFStringArray(tag, text).good() ? text.c_str() : "";
}

/// The first item of a sequence.
DcmItem* itemOf(DcmItem* in, const DcmTagKey& tag, long n = 0) {
  DcmItem* item = nullptr;
  if (in) in->findAndGetSequenceItem(tag, item, n);
  return item;
}

/// Voxels of a segment as DCMTK alone reads them: bit by bit, each frame placed by its position.
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

QStringList errorsOf(const std::string& path) {
  QProcess check;
  check.start(QStringLiteral("dciodvfy"), {QString::fromStdString(path)});
  check.waitForFinished(60000);
  QStringList errors;
  for (const QByteArray& line : (check.readAllStandardError() + check.readAllStandardOutput()).split('\n'))
    if (line.startsWith("Error")) errors << QString::fromUtf8(line);
  return errors;
}

bool isSaid(const std::vector<std::string>& notes, const char* words) {
  return std::ranges::any_of(notes, [&](const std::string& n) { return n.find(words) != std::string::npos; });
}

/// A python with pydicom and numpy; empty: there is none.
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

void TestSegmentationDicom::masksComeBackAsTheyWent() {
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

void TestSegmentationDicom::labelMapsComeBackAsTheyWent() {
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

// Frames of its pixel_array, summed up by x + 1, y + 1 and their product, so that no pixel is another's.
void TestSegmentationDicom::pydicomReadsTheSame() {
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

// The words of CIELab are fine enough for all of sRGB: 255 colours of one file, thousands over all.
void TestSegmentationDicom::coloursComeBackAsTheyWent() {
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

void TestSegmentationDicom::whatIsNotSaidIsFilledIn() {
  Chance chance(3);
  const Slices slices({9, 7}, even(4, 2.5), chance);
  BitMask mask(slices.grid);
  mask.set({1, 2, 3});
  const std::string longName(70, 'x');
  std::vector<SegmentVoxels> in;
  for (const std::string& name : {std::string("bone"), std::string(), longName, std::string("a\\b\nc")})
    in.push_back({{.number = 9, .label = name}, mask});
  in[0].segment.range = ValueRange{150, 3000};
  in[0].segment.trackingId = "lesion 1";
  in[1].segment.type = tissueNamed("Liver")->type;  // without a category or a colour
  const auto notes = writeSegmentationDicom(in, slices.series, {}, slices.seg());
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  QVERIFY(isSaid(*notes, "Written as Tissue, for there is no code of them: bone, "));
  QVERIFY(isSaid(*notes, "at most 64 characters"));
  const auto out = loadSegmentation(slices.seg());
  QVERIFY(out.ok());
  const std::vector<Segment>& said = out->segments;
  QCOMPARE(said[0].type.meaning, std::string("Tissue"));
  QCOMPARE(said[0].algorithm, std::string("Values from 150 to 3000"));
  QCOMPARE(said[0].trackingId, std::string("lesion 1"));
  QCOMPARE(said[1].label, std::string("Segment 2"));
  QCOMPARE(said[1].category.meaning, std::string("Anatomical Structure"));
  QVERIFY(said[1].colour == tissueNamed("Liver")->colour);
  QCOMPARE(said[2].label, longName.substr(0, 64));
  QCOMPARE(said[3].label, std::string("a b c"));
  QVERIFY(said[0].number == 1 && said[3].number == 4);
}

void TestSegmentationDicom::itNamesItsPictures() {
  Chance chance(3);
  const Slices slices({9, 7}, even(4, 2.5), chance);
  BitMask mask(slices.grid);
  mask.set({1, 2, 3});
  const std::vector<SegmentVoxels> in{{randomSegment(1, chance), mask}, {randomSegment(2, chance), mask}};
  const SegmentationTags tags{.description = "Bones", .date = "20260102", .time = "030405"};
  QVERIFY(writeSegmentationDicom(in, slices.series, tags, slices.seg()).ok());
  DcmFileFormat file;
  QVERIFY(file.loadFile(OFFilename(slices.seg().c_str())).good());
  DcmDataset& data = *file.getDataset();
  QCOMPARE(textOf(data, DCM_PatientID), std::string("P1"));
  QCOMPARE(textOf(data, DCM_StudyInstanceUID), std::string("1.2.3.4"));
  QCOMPARE(textOf(data, DCM_ReferringPhysicianName), std::string("Doctor^A"));
  QCOMPARE(textOf(data, DCM_FrameOfReferenceUID), std::string("1.2.3.7"));
  QCOMPARE(textOf(data, DCM_SeriesDescription), std::string("Bones"));
  QCOMPARE(textOf(data, DCM_ContentDate), std::string("20260102"));
  QCOMPARE(textOf(data, DCM_SegmentsOverlap), std::string("YES"));
  QVERIFY(textOf(data, DCM_SeriesInstanceUID) != "1.2.3.4.5");
  DcmItem* measures = itemOf(itemOf(&data, DCM_SharedFunctionalGroupsSequence), DCM_PixelMeasuresSequence);
  for (const DcmTagKey& tag : {DCM_SliceThickness, DCM_SpacingBetweenSlices})  // positions have 12 digits
    QVERIFY(std::abs(QString::fromStdString(textOf(*measures, tag)).toDouble() - 2.5) < 1e-6);
  // Every source instance, and of the frame the one that it lies on.
  DcmItem* series = itemOf(&data, DCM_ReferencedSeriesSequence);
  QCOMPARE(textOf(*series, DCM_SeriesInstanceUID), std::string("1.2.3.4.5"));
  std::set<std::string> instances;
  for (long n = 0; DcmItem* instance = itemOf(series, DCM_ReferencedInstanceSequence, n); ++n)
    instances.insert(textOf(*instance, DCM_ReferencedSOPInstanceUID));
  const auto& uids = slices.series.sopInstanceUids;
  QVERIFY(instances == std::set<std::string>(uids.begin(), uids.end()));
  DcmItem* source =
      itemOf(itemOf(itemOf(&data, DCM_PerFrameFunctionalGroupsSequence), DCM_DerivationImageSequence),
             DCM_SourceImageSequence);
  QCOMPARE(textOf(*source, DCM_ReferencedSOPInstanceUID), uids[3]);
  QCOMPARE(textOf(*source, DCM_SpatialLocationsPreserved), std::string("YES"));
}

void TestSegmentationDicom::sameContentsGiveTheSameFile() {
  Chance chance(4);
  const Slices slices({9, 7}, even(4, 2.5), chance);
  const std::vector<SegmentVoxels> in{{randomSegment(1, chance), inverted(BitMask(slices.grid))}};
  const auto written = [&](const SegmentationTags& tags) {
    QFile file(QString::fromStdString(slices.seg()));
    const bool done = writeSegmentationDicom(in, slices.series, tags, slices.seg()).ok();
    return done && file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  };
  const auto instanceOf = [&] {
    DcmFileFormat file;
    return file.loadFile(OFFilename(slices.seg().c_str())).good()
               ? textOf(*file.getDataset(), DCM_SOPInstanceUID)
               : std::string();
  };
  const QByteArray first = written({.date = "20260102", .time = "030405"});
  const std::string instance = instanceOf();
  QVERIFY(!first.isEmpty() && written({.date = "20260102", .time = "030405"}) == first);
  QVERIFY(written({.date = "20260102", .time = "030406"}) != first && instanceOf() != instance);
}

void TestSegmentationDicom::slicesBetweenPicturesAreLeftOutAndTold() {
  Chance chance(11);
  const Slices slices({8, 8}, {0, 2, 4, 8, 10, 12}, chance);  // that at 6 is missing
  QVERIFY(slices.series.regular.has_value());
  QCOMPARE(slices.grid.size.z, 7);
  std::vector<SegmentVoxels> in{{randomSegment(1, chance), inverted(BitMask(slices.grid))}};
  const auto notes = writeSegmentationDicom(in, slices.series, {}, slices.seg());
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  QCOMPARE(notes->size(), std::size_t(1));
  QVERIFY2(isSaid(*notes, "no picture of the series: 1;"), notes->front().c_str());
  const auto out = loadSegmentation(slices.seg());
  QVERIFY(out.ok());
  QCOMPARE(out->frames.size(), std::size_t(6));
  QCOMPARE(pixelsOf(*out, 0), std::int64_t(6 * 64));
  // Nothing marked there, nothing told.
  BitMask last(slices.grid);
  last.set({0, 0, 6});
  in[0].mask = last;
  const auto silent = writeSegmentationDicom(in, slices.series, {}, slices.seg());
  QVERIFY(silent && silent->empty());
  QVERIFY(maskOf(*loadSegmentation(slices.seg()), 0, slices.grid) == last);
}

void TestSegmentationDicom::labelsOfAnotherGridAreThoseOfTheNearestVoxel() {
  const Seeds seeds = seedsOf(40, 400);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const Slices slices({1 + chance.below(20), 1 + chance.below(20)}, even(1 + chance.below(5), 1.5), chance);
    VoxelGeometry grid;
    grid.size = {1 + chance.below(20), 1 + chance.below(20), 1 + chance.below(9)};
    grid.patientFromVoxelStep = slices.grid.patientFromVoxelStep * chance.between(0.4, 1.7) +
                                0.1 * glm::dmat3(chance.vector(), chance.vector(), chance.vector());
    grid.origin = slices.grid.origin + chance.vector();
    std::vector<SegmentVoxels> in{{randomSegment(1, chance), inverted(randomMask(grid, chance))}};
    BitMask expected(slices.grid);
    for (int k = 0; k < slices.grid.size.z; ++k)
      for (int j = 0; j < slices.grid.size.y; ++j)
        for (int i = 0; i < slices.grid.size.x; ++i) {
          const glm::dvec3 p = glm::round(grid.voxelFromPatient(slices.grid.patientFromVoxel({i, j, k})));
          const bool inside =
              p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < grid.size.x && p.y < grid.size.y && p.z < grid.size.z;
          expected.set({i, j, k}, inside && in[0].mask.at(glm::ivec3(p)));
        }
    const auto notes = writeSegmentationDicom(in, slices.series, {}, slices.seg());
    QCOMPARE(notes.ok(), !expected.empty());
    if (!notes) continue;
    QVERIFY2(isSaid(*notes, "another grid"), qPrintable(QString::number(seed)));
    QVERIFY2(maskOf(*loadSegmentation(slices.seg()), 0, slices.grid) == expected,
             qPrintable(QString::number(seed)));
  }
}

void TestSegmentationDicom::framesOfOneFileAreNamed() {
  NEED_DATA(dataPath());
  const auto study = openStudy(dataPath("dicom-geometry/mr-enh-siemens-xa10"));
  QVERIFY(study && !study->volumes.empty());
  const Series& series = study->volumes[0];
  BitMask mask(series.acquired);
  mask.set({5, 6, series.acquired.size.z - 1});
  const DicomFolder folder;
  const std::string path = folder.path("a.dcm");
  const std::vector<SegmentVoxels> in{{{.number = 1, .label = "a"}, mask}};
  const auto notes = writeSegmentationDicom(in, series, {}, path);
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  DcmFileFormat file;
  QVERIFY(file.loadFile(OFFilename(path.c_str())).good());
  DcmItem* source = itemOf(
      itemOf(itemOf(file.getDataset(), DCM_PerFrameFunctionalGroupsSequence), DCM_DerivationImageSequence),
      DCM_SourceImageSequence);
  QCOMPARE(textOf(*source, DCM_ReferencedFrameNumber), std::to_string(series.frames.back() + 1));
  QVERIFY(maskOf(*loadSegmentation(path), 0, series.acquired) == mask);
}

void TestSegmentationDicom::whatCannotBeWrittenIsRefused() {
  Chance chance(1);
  const Slices slices({4, 4}, even(3, 1), chance);
  std::vector<SegmentVoxels> in{{{.number = 1, .label = "a"}, BitMask(slices.grid)}};
  const auto refused = [&](const Series& series, const std::string& path, const char* words) {
    const auto notes = writeSegmentationDicom(in, series, {}, path);
    return !notes && notes.message().find(words) != std::string::npos &&
           !QFile::exists(QString::fromStdString(path));
  };
  QVERIFY(refused(slices.series, slices.seg(), "Nothing is marked"));
  QVERIFY(!writeSegmentationDicom(std::span<const Segmented>(), slices.series, {}, slices.seg()).ok());
  in[0].mask.set({0, 0, 0});
  const auto phantom = openStudy("phantom:ct-head:32");
  QVERIFY(phantom.ok());
  QVERIFY(refused(phantom->volumes[0], slices.seg(), "comes from no DICOM files"));
  QVERIFY(refused(slices.series, slices.folder.path("none/a.dcm"), "no such folder"));
  Series gone = slices.series;
  gone.files[1] = slices.folder.path("gone");
  QVERIFY(refused(gone, slices.seg(), "gone"));
}

void TestSegmentationDicom::cancelledWritingLeavesNothing() {
  Chance chance(1);
  const Slices slices({4, 4}, even(3, 1), chance);
  const std::vector<SegmentVoxels> in{{{.number = 1}, inverted(BitMask(slices.grid))}};
  const CancelToken cancel;
  cancel.cancel();
  QVERIFY(!writeSegmentationDicom(in, slices.series, {}, slices.seg(), {}, cancel).ok());
  QVERIFY(!QFile::exists(QString::fromStdString(slices.seg())));
}

void TestSegmentationDicom::realSeriesAreValid_data() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"ct-chest-lidc0314-138", "mr-head-ge-mprage-130", "mr-head-siemens-gap-175",
                           "dicom-geometry/ct-head-slicer-93"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

// Two segments by thresholds, of all slices; VOLUMEN_FIGURES prints how long each step takes.
void TestSegmentationDicom::realSeriesAreValid() {
  QFETCH(QString, name);
  NEED_DATA(dataPath(name.toStdString()));
  const auto study = openStudy(dataPath(name.toStdString()));
  QVERIFY(study && !study->volumes.empty());
  const Series& series = study->volumes[0];
  const auto loaded = loadSeries(series);
  QVERIFY(loaded.ok());
  const Volume& volume = *loaded->drawn;
  const VoxelGeometry& grid = volume.geometry();
  DenseLabels dense{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()))};
  for (std::size_t n = 0; n < dense.labels.size(); ++n)
    dense.labels[n] = volume.valueAt(n) > 200 ? 2 : volume.valueAt(n) > 20;
  Segmented in{{{.number = 1, .label = "Muscle"}, {.number = 2, .label = "Bone"}}, LabelMap(dense)};
  for (Segment& segment : in.segments) {
    segment.category = tissueNamed(segment.label)->category;
    segment.type = tissueNamed(segment.label)->type;
  }
  const DicomFolder folder;
  const std::string path = folder.path("a.dcm");
  QElapsedTimer timer;
  timer.start();
  const auto notes = writeSegmentationDicom({&in, 1}, series, {}, path);
  const qint64 writing = timer.restart();
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  const auto out = loadSegmentation(path);
  QVERIFY2(out, out ? "" : out.message().c_str());
  const qint64 reading = timer.restart();
  const std::vector<Segmented> maps = segmentedOf(*out, grid);
  if (qEnvironmentVariableIsSet("VOLUMEN_FIGURES"))
    qInfo("%s: %d x %d x %d: written %lld ms, read %lld ms, on the grid %lld ms", qPrintable(name),
          grid.size.x, grid.size.y, grid.size.z, static_cast<long long>(writing),
          static_cast<long long>(reading), static_cast<long long>(timer.elapsed()));
  QCOMPARE(maps.size(), std::size_t(1));
  if (!series.regular) QVERIFY(maps[0].labels == in.labels);
  QCOMPARE(isSaid(*notes, "138 frames of reference"), name.startsWith(QStringLiteral("ct-chest")));
  if (QStandardPaths::findExecutable(QStringLiteral("dciodvfy")).isEmpty())
    QSKIP("dciodvfy (package dicom3tools) is not installed");
  const QStringList errors = errorsOf(path);
  QVERIFY2(errors.isEmpty(), qPrintable(errors.join(QLatin1Char('\n'))));
}

VOLUMEN_TEST(TestSegmentationDicom);
#include "tst_segmentation_dicom.moc"
