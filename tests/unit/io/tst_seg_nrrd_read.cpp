// Guards export/seg_nrrd.h: segments in layers survive a round trip. Slicer's files are read, including old
// and cropped ones. A file that contradicts itself gives a sentence.
#include <QFile>
#include <QTemporaryDir>
#include <algorithm>

#include "io/export/seg_nrrd.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"
#include "viewer/segment/tissue_codes.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegNrrdRead : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void layersComeBackAsTheyWent();
  void slicersFieldsAreUnderstood();
  void aSegmentALayerAsOlderFilesHaveIt();
  void labelsWithoutFieldsAreNamedByNumber();
  void croppedFilesLieWhereTheyLay();
  void anEmptyFileHasItsSegments();
  void coloursThatAreNoneAreTold_data();
  void coloursThatAreNoneAreTold();
  void labelsOfNoSegmentAreToldAtOnce();
  void contradictionsAreRefused_data();
  void contradictionsAreRefused();
  void damagedFilesNeverCrash();
};

namespace {

/// Writes a NRRD file of raw bytes whose header has these lines after those of a grid of `sizes`.
std::string fileOf(const QTemporaryDir& folder, const std::string& sizes, const std::string& lines,
                   const std::vector<std::uint8_t>& bytes, const std::string& type = "uint8") {
  const std::string path = folder.filePath(QStringLiteral("a.seg.nrrd")).toStdString();
  const bool isList = std::count(sizes.begin(), sizes.end(), ' ') == 3;
  std::string text =
      "NRRD0004\ntype: " + type + "\ndimension: " + (isList ? "4" : "3") +
      "\nspace: left-posterior-superior\nsizes: " + sizes + "\nspace directions: " + (isList ? "none " : "") +
      "(1,0,0) (0,1,0) (0,0,2)\nkinds: " + (isList ? "list " : "") +
      "domain domain domain\nendian: little\nencoding: raw\nspace origin: (10,20,30)\n" + lines + "\n";
  std::vector<std::uint8_t> all(text.begin(), text.end());
  all.insert(all.end(), bytes.begin(), bytes.end());
  writeAll(path, all);
  return path;
}

VoxelGeometry row(int voxels) {
  VoxelGeometry grid;
  grid.size = {voxels, 1, 1};
  grid.patientFromVoxelStep[2][2] = 2;
  grid.origin = {10, 20, 30};
  return grid;
}

}  // namespace

void TestSegNrrdRead::layersComeBackAsTheyWent() {
  const Seeds seeds = seedsOf(400, 4000);
  const QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a.seg.nrrd")).toStdString();
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    const QByteArray where = "seed " + QByteArray::number(seed);
    Chance chance{std::uint64_t(seed)};
    VoxelGeometry grid;
    grid.size = {1 + chance.below(40), 1 + chance.below(40), 1 + chance.below(9)};
    grid.patientFromVoxelStep = chance.between(0.3, 3) * grids[chance.below(5)].patientFromVoxelStep;
    grid.origin = 100.0 * chance.vector();
    std::vector<Segmented> in;
    for (int layer = 0; layer < 1 + chance.below(3); ++layer) {
      DenseLabels dense{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()))};
      const int labels = 1 + chance.below(chance.oneIn(10) ? 255 : 9);
      for (std::uint8_t& label : dense.labels) label = std::uint8_t(chance.below(labels + 1));
      in.push_back({{}, LabelMap(dense)});
      for (int n = 1; n <= labels; ++n) {
        Segment segment{.number = n,
                        .label = "größer \\ " + std::to_string(n) + (chance.oneIn(3) ? "\nb:=c" : "")};
        segment.colour = glm::u8vec3(chance.below(256), chance.below(256), chance.below(256));
        if (chance.oneIn(2)) {
          const TissueCode& tissue = tissueCodes()[std::size_t(chance.below(int(tissueCodes().size())))];
          segment.category = tissue.category, segment.type = tissue.type;
          if (chance.oneIn(2)) segment.modifier = leftSide();
        }
        in.back().segments.push_back(segment);
      }
    }
    QVERIFY(writeSegNrrd(in, path).ok());
    const auto out = readSegNrrd(path);
    QVERIFY2(out, out ? "" : (where + out.message().c_str()));
    QVERIFY(out->notes.empty());
    QCOMPARE(out->maps.size(), in.size());
    for (std::size_t n = 0; n < in.size(); ++n) {
      QVERIFY2(out->maps[n].labels == in[n].labels, where);
      QVERIFY2(out->maps[n].segments == in[n].segments, where);
    }
  }
}

void TestSegNrrdRead::slicersFieldsAreUnderstood() {
  const QTemporaryDir folder;
  const std::string lines =
      "Segment0_ID:=Segment_1\nSegment0_Name:=left kidney\nSegment0_Color:=0.725490 0.4 0.325490\n"
      "Segment0_LabelValue:=300\nSegment0_Layer:=0\nSegment0_Extent:=0 0 0 0 0 0\n"
      "Segment0_Tags:=Segmentation.Status:completed|TerminologyEntry:Segmentation category and type - 3D "
      "Slicer "
      "General Anatomy list~SCT^123037004^Anatomical Structure~SCT^64033007^Kidney~SCT^7771000^Left~Anatomic "
      "codes "
      "- DICOM master list~SCT^818981001^Abdomen~SCT^24028007^Right|a:b:c|\n"
      "Segment1_ID:=no name\nSegment1_LabelValue:=1\nSegment1_Layer:=0\nSegment1_Color:=2 0 0\n"
      "Segmentation_MasterRepresentation:=Binary labelmap\nSegmentation_ConversionParameters:=a|b|c&\n";
  const std::string path = fileOf(folder, "4 1 1", lines, {0x2c, 1, 1, 0, 7, 0, 0, 0}, "uint16");
  const auto out = readSegNrrd(path);
  QVERIFY2(out, out ? "" : out.message().c_str());
  QCOMPARE(out->maps.size(), std::size_t(1));
  const std::vector<Segment>& segments = out->maps[0].segments;
  QCOMPARE(segments.size(), std::size_t(2));
  QCOMPARE(segments[0].label, std::string("left kidney"));
  QCOMPARE(segments[0].type, (Code{"64033007", "SCT", "Kidney"}));
  QCOMPARE(segments[0].category, (Code{"123037004", "SCT", "Anatomical Structure"}));
  QCOMPARE(segments[0].modifier, leftSide());
  QCOMPARE(segments[0].region, (Code{"818981001", "SCT", "Abdomen"}));
  QCOMPARE(segments[0].regionModifier, rightSide());
  QVERIFY(segments[0].colour == glm::u8vec3(185, 102, 83));
  QCOMPARE(segments[0].number, 2);  // 300 is no label, and 1 is taken
  QCOMPARE(segments[1].label, std::string("no name"));
  QVERIFY(!segments[1].colour && segments[1].number == 1);
  QCOMPARE(out->maps[0].labels.dense().labels, (std::vector<std::uint8_t>{2, 1, 0, 0}));
  QVERIFY(out->maps[0].labels.geometry() == row(4));
  QCOMPARE(out->notes.size(), std::size_t(2));
  QVERIFY(out->notes[0].find("Segment1_Color '2 0 0'") != std::string::npos);
  QCOMPARE(out->notes[1], path + ": voxels of the label 7 are of no segment, and were left out.");
}

void TestSegNrrdRead::aSegmentALayerAsOlderFilesHaveIt() {
  const QTemporaryDir folder;
  const auto out =
      readSegNrrd(fileOf(folder, "2 3 1 1", "Segment0_ID:=a\nSegment1_ID:=b\n", {1, 0, 1, 1, 0, 1}));
  QVERIFY2(out, out ? "" : out.message().c_str());
  QCOMPARE(out->maps.size(), std::size_t(2));
  QCOMPARE(out->maps[0].labels.dense().labels, (std::vector<std::uint8_t>{1, 1, 0}));
  QCOMPARE(out->maps[1].labels.dense().labels, (std::vector<std::uint8_t>{0, 1, 1}));
  QCOMPARE(out->maps[1].segments.at(0).label, std::string("b"));
}

void TestSegNrrdRead::labelsWithoutFieldsAreNamedByNumber() {
  const QTemporaryDir folder;
  const auto out = readSegNrrd(fileOf(folder, "4 1 1", "", {0, 9, 3, 9}));
  QVERIFY2(out, out ? "" : out.message().c_str());
  QCOMPARE(out->maps.at(0).segments.size(), std::size_t(2));
  QCOMPARE(out->maps[0].segments[0].label, std::string("Label 3"));
  QCOMPARE(out->maps[0].segments[1].number, 9);
}

void TestSegNrrdRead::croppedFilesLieWhereTheyLay() {
  const QTemporaryDir folder;
  auto read = readSegNrrd(fileOf(folder, "3 1 1", "Segment0_Name:=a\n", {1, 0, 1}));
  QVERIFY(read.ok());
  VoxelGeometry grid = row(6);
  grid.origin.x = 8;  // begins two voxels earlier
  const auto inside = onGrid(*read, grid);
  QVERIFY(inside.ok());
  QCOMPARE(inside->maps[0].labels.dense().labels, (std::vector<std::uint8_t>{0, 0, 1, 0, 1, 0}));
  QVERIFY(inside->maps[0].labels.geometry() == grid);
  QCOMPARE(inside->notes.size(), std::size_t(1));
  QVERIFY(inside->notes[0].find("3 x 1 x 1") != std::string::npos);
  grid.origin.x = 11;
  const auto cut = onGrid(*read, grid);
  QVERIFY(cut.ok());
  QCOMPARE(cut->maps[0].labels.dense().labels, (std::vector<std::uint8_t>{0, 1, 0, 0, 0, 0}));
  QCOMPARE(cut->notes.size(), std::size_t(2));
  const auto same = onGrid(*read, row(3));
  QVERIFY(same && same->notes.empty() && same->maps[0].labels == read->maps[0].labels);
  VoxelGeometry unknown = row(6);
  unknown.calibrated = false;
  QVERIFY(!onGrid(*read, unknown).ok());
  unknown.size.x = 3;
  QVERIFY(onGrid(*read, unknown)->maps[0].labels.geometry() == unknown);
}

// If all segments are empty, Slicer writes a single voxel at any position.
void TestSegNrrdRead::anEmptyFileHasItsSegments() {
  const QTemporaryDir folder;
  const auto read =
      readSegNrrd(fileOf(folder, "1 1 1", "Segment0_Name:=a\nSegment0_Extent:=0 -1 0 -1 0 -1\n", {0}));
  QVERIFY(read.ok());
  const auto out = onGrid(*read, row(5));
  QVERIFY(out.ok());
  QVERIFY2(out->notes.empty(), out->notes.empty() ? "" : out->notes[0].c_str());
  QCOMPARE(out->maps.at(0).segments.size(), std::size_t(1));
  QVERIFY(out->maps[0].labels == LabelMap(row(5)));
}

void TestSegNrrdRead::coloursThatAreNoneAreTold_data() {
  QTest::addColumn<QByteArray>("colour");
  for (const char* colour : {"nan 0 0", "0 -inf 0", "70000 0 0", "x x x", "0.5", "0 0 0 0", "1,0,0"})
    QTest::newRow(colour) << QByteArray(colour);
}

void TestSegNrrdRead::coloursThatAreNoneAreTold() {
  QFETCH(QByteArray, colour);
  const QTemporaryDir folder;
  const std::string path =
      fileOf(folder, "2 1 1", "Segment0_Name:=a\nSegment0_Color:=" + colour.toStdString() + "\n", {1, 0});
  const auto out = readSegNrrd(path);
  QVERIFY2(out, out ? "" : out.message().c_str());
  QCOMPARE(out->notes, std::vector{path + ": other colours were taken for Segment0_Color '" +
                                   colour.toStdString() + "'; three numbers from 0 to 1 are meant."});
  QVERIFY(!out->maps.at(0).segments.at(0).colour);
}

void TestSegNrrdRead::labelsOfNoSegmentAreToldAtOnce() {
  const QTemporaryDir folder;
  const std::string path = fileOf(folder, "8 1 1", "Segment0_Name:=a\n", {1, 9, 3, 3, 4, 5, 6, 7});
  const auto out = readSegNrrd(path);
  QVERIFY2(out, out ? "" : out.message().c_str());
  QCOMPARE(out->notes, std::vector{path + ": voxels of 6 labels are of no segment, and were left out: 3, 4, "
                                          "5, 6, 7 and 1 more."});
}

void TestSegNrrdRead::contradictionsAreRefused_data() {
  QTest::addColumn<QByteArray>("lines");
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("a layer that is not there")
      << QByteArray("Segment0_ID:=a\nSegment0_Layer:=1\n") << QByteArray("Segment0_Layer is '1'; 0 to 0");
  QTest::newRow("a layer that is no number")
      << QByteArray("Segment0_ID:=a\nSegment0_Layer:=x\n") << QByteArray("Segment0_Layer is 'x'");
  QTest::newRow("the background") << QByteArray("Segment0_ID:=a\nSegment0_LabelValue:=0\n")
                                  << QByteArray("Segment0_LabelValue is '0'");
  QTest::newRow("a huge label") << QByteArray("Segment0_ID:=a\nSegment0_LabelValue:=99999999999999999999\n")
                                << QByteArray("Segment0_LabelValue");
  QTest::newRow("two of one label") << QByteArray(
                                           "Segment0_ID:=a\nSegment0_LabelValue:=1\nSegment1_ID:=b\nSegment1_"
                                           "LabelValue:=1\nSegment1_Layer:=0\n")
                                    << QByteArray("two of its segments are the label 1");
  QTest::newRow("an old file of more segments than layers")
      << QByteArray("Segment0_ID:=a\nSegment1_ID:=b\n") << QByteArray("its segment 2 is in none of them");
  QByteArray many;
  for (int n = 0; n < 256; ++n) {
    const QByteArray number = QByteArray::number(n);
    many += "Segment" + number + "_LabelValue:=" + QByteArray::number(n + 1) + "\nSegment" + number +
            "_Layer:=0\n";
  }
  QTest::newRow("256 segments") << many << QByteArray("256 segments in one layer; at most 255");
}

void TestSegNrrdRead::contradictionsAreRefused() {
  QFETCH(QByteArray, lines);
  QFETCH(QByteArray, says);
  const QTemporaryDir folder;
  const std::string path = fileOf(folder, "4 1 1", lines.toStdString(), {0, 1, 2, 3});
  const auto out = readSegNrrd(path);
  QVERIFY(!out.ok());
  QVERIFY2(out.message().find(says.toStdString()) != std::string::npos && out.message().starts_with(path) &&
               out.message().ends_with("."),
           out.message().c_str());
}

// Bytes of a good file are changed or cut off. It is read or refused with a sentence that names it.
void TestSegNrrdRead::damagedFilesNeverCrash() {
  const QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a.seg.nrrd")).toStdString();
  DenseLabels dense{row(5), {0, 1, 2, 1, 0}};
  const std::vector<Segmented> in{
      {{{.number = 1, .label = "a"}, {.number = 2, .label = "b"}}, LabelMap(dense)},
      {{{.number = 1, .label = "c"}}, LabelMap(dense)}};
  QVERIFY(writeSegNrrd(in, path).ok());
  const std::vector<std::uint8_t> good = readAll(path);
  const Seeds seeds = seedsOf(600, 6000);
  int read = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    std::vector<std::uint8_t> bytes = good;
    if (chance.oneIn(3)) bytes.resize(std::size_t(chance.below(int(good.size()))));
    for (int n = 0; n < 1 + chance.below(5) && !bytes.empty(); ++n)
      bytes[std::size_t(chance.below(int(bytes.size())))] = std::uint8_t(chance.below(256));
    writeAll(path, bytes);
    const auto out = readSegNrrd(path);
    read += out.ok();
    if (out) continue;
    QVERIFY2(out.message().find("a.seg.nrrd") != std::string::npos && out.message().ends_with("."),
             out.message().c_str());
  }
  QVERIFY(read > 0 && read < seeds.count);
}

VOLUMEN_TEST(TestSegNrrdRead);
#include "tst_seg_nrrd_read.moc"
