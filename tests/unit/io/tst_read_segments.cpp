// Guards export/read_segments.h: segments come back from every kind of file that is written, by its contents
// and not its name; what another grid costs is told with figures; what holds no segments, is damaged or lies
// elsewhere costs a sentence that names it.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "io/export/export_segments.h"
#include "io/export/read_segments.h"
#include "io/study/series.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"
#include "viewer/segment/label_map.h"
#include "viewer/segment/names_and_colours.h"
#include "viewer/segment/tissue_codes.h"

using namespace volumen;
using namespace volumen::tests;

class TestReadSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyComeBackAsTheyWent_data();
  void theyComeBackAsTheyWent();
  void whatAnotherGridCostsIsTold_data();
  void whatAnotherGridCostsIsTold();
  void repeatedFramesAreNoOtherGrid();
  void whatDiffersFromItsPicturesIsTold_data();
  void whatDiffersFromItsPicturesIsTold();
  void rowsForColumnsAreTold();
  void anotherFrameOfReferenceIsRefused();
  void namesAndColoursAreGivenWhereThereAreNone_data();
  void namesAndColoursAreGivenWhereThereAreNone();
  void filesAreThoseThatWereRead();
  void whatHoldsNoneIsRefused_data();
  void whatHoldsNoneIsRefused();
  void filesOfOthersCostASentence();
  void cutOffFilesCostASentence_data();
  void cutOffFilesCostASentence();
  void namesThatSaySo();
  void aFileOfTheSeriesIsNotWrittenOver();
};

namespace {

/// Six slices of 9 x 7 pixels of 1 mm, 2 mm apart, and segments on them.
struct Sliced {
  DicomFolder folder;
  Series series;
  VoxelGeometry grid;
  Segmented segments{{}, LabelMap(VoxelGeometry{})};

  Sliced() {
    for (int n = 0; n < 6; ++n) {
      DicomPicture picture = sliceAt(2.0 * n, 5);
      picture.columns = 9;
      picture.rows = 7;
      picture.spacing = "1\\1";
      picture.edit = [](DcmDataset& data) { data.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.3.7"); };
      folder.add(numbered("s", n), picture);
    }
    const Study study = folder.open();
    if (study.volumes.size() != 1) return;
    series = study.volumes[0];
    grid = series.acquired;
    LabelEdit edit{LabelMap(grid)};
    for (int k = 1; k < 5; ++k)
      for (int j = 1; j < 4; ++j)
        for (int i = 0; i < 9; ++i) edit.set({i, j, k}, std::uint8_t(i < 4 ? 1 : 2));
    segments = {{{.number = 1, .label = "Liver"}, {.number = 2, .label = "Größe"}}, edit.done()};
    for (Segment& segment : segments.segments) {
      segment.category = tissueCodes()[std::size_t(segment.number)].category;
      segment.type = tissueCodes()[std::size_t(segment.number)].type;
      segment.colour = glm::u8vec3(20, 30 * segment.number, 255);
    }
  }
  std::string write(const char* ending) {
    const std::string path = folder.path(std::string("out") + ending);
    return exportSegments(path, {&segments, 1}, series) ? path : std::string();
  }
};

/// Changes the elements of a DICOM file.
void editFile(const std::string& path, const std::function<void(DcmDataset&)>& edit) {
  DcmFileFormat file;
  if (file.loadFile(path.c_str()).bad()) return;
  edit(*file.getDataset());
  file.saveFile(path.c_str());
}

void addEndings(const std::vector<const char*>& endings) {
  QTest::addColumn<QByteArray>("ending");
  for (const char* ending : endings) QTest::newRow(ending) << QByteArray(ending);
}

}  // namespace

void TestReadSegments::theyComeBackAsTheyWent_data() { addEndings({".seg.nrrd", ".dcm", ".nii.gz", ".mha"}); }

void TestReadSegments::theyComeBackAsTheyWent() {
  QFETCH(QByteArray, ending);
  Sliced in;
  std::string path = in.write(ending);
  QVERIFY(!path.empty());
  const bool hasCodes = ending == ".seg.nrrd" || ending == ".dcm";
  if (hasCodes) {  // the table of an image is found by its name
    std::filesystem::rename(path, in.folder.path("plain"));
    path = in.folder.path("plain");
  }
  const auto out = readSegments(path, in.series, in.grid);
  QVERIFY2(out, out ? "" : out.message().c_str());
  QVERIFY2(out->notes.empty(), out->notes.empty() ? "" : out->notes[0].c_str());
  QCOMPARE(out->maps.size(), std::size_t(1));
  QVERIFY(out->maps[0].labels == in.segments.labels);
  QCOMPARE(out->maps[0].segments.size(), std::size_t(2));
  for (std::size_t n = 0; n < 2; ++n) {
    const Segment &a = in.segments.segments[n], &b = out->maps[0].segments[n];
    QVERIFY(a.number == b.number && a.label == b.label && a.colour == b.colour);
    QVERIFY(!hasCodes || (a.category == b.category && a.type == b.type));
  }
}

void TestReadSegments::whatAnotherGridCostsIsTold_data() { addEndings({".seg.nrrd", ".dcm", ".nii.gz"}); }

// 4 x 3 x 9 voxels of 2 mm^3; a grid that begins two slices later and has voxels of half the width.
void TestReadSegments::whatAnotherGridCostsIsTold() {
  QFETCH(QByteArray, ending);
  Sliced in;
  const std::string path = in.write(ending);
  VoxelGeometry grid = in.grid;
  grid.patientFromVoxelStep[0] *= 0.5;
  grid.size.x *= 2;
  grid.origin -= 0.25 * in.grid.patientFromVoxelStep[0];
  grid.origin += 2.0 * in.grid.patientFromVoxelStep[2];
  const auto out = readSegments(path, in.series, grid);
  QVERIFY2(out, out ? "" : out.message().c_str());
  QCOMPARE(labelCounts(out->maps[0].labels)[1], std::int64_t(3 * 3 * 8));
  QCOMPARE(labelCounts(out->maps[0].labels)[2], std::int64_t(3 * 3 * 10));
  QCOMPARE(out->notes.size(), std::size_t(2));
  QVERIFY2(out->notes[0].find("0.216 ml became 0.162 ml") != std::string::npos, out->notes[0].c_str());
  QVERIFY2(out->notes[1].starts_with("0.054 ml of the segments lie outside"), out->notes[1].c_str());
  grid.origin += 100.0 * in.grid.patientFromVoxelStep[2];
  const auto elsewhere = readSegments(path, in.series, grid);
  QVERIFY(!elsewhere);
  QCOMPARE(elsewhere.message(), path + ": All of its segments lie outside the series.");
}

// All frames of both segments are made those of the first, so that each place comes twice.
void TestReadSegments::repeatedFramesAreNoOtherGrid() {
  Sliced in;
  const std::string path = in.write(".dcm");
  editFile(path, [](DcmDataset& data) {
    DcmItem *frame = nullptr, *segment = nullptr;
    for (long n = 0; data.findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, frame, n).good();
         ++n) {
      frame->findAndGetSequenceItem(DCM_SegmentIdentificationSequence, segment);
      segment->putAndInsertUint16(DCM_ReferencedSegmentNumber, 1);
    }
  });
  const auto out = readSegments(path, in.series, in.grid);
  QVERIFY2(out, out ? "" : out.message().c_str());
  QCOMPARE(labelCounts(out->maps[0].labels)[1], std::int64_t(4 * 3 * 9));
  QCOMPARE(out->notes.size(), std::size_t(1));
  QVERIFY2(out->notes[0].find("repeat a place of their segment (4)") != std::string::npos,
           out->notes[0].c_str());
  const auto own = readSegments(path);
  QVERIFY(own && own->notes == out->notes);
}

void TestReadSegments::whatDiffersFromItsPicturesIsTold_data() {
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("rows too few") << 6 << 9 << QByteArray("(6 x 9 x 8): 64 of 54 bytes are there");
  QTest::newRow("rows too many") << 8 << 9 << QByteArray("cut off: 64 of 72 bytes are there");
  QTest::newRow("columns too few") << 7 << 8 << QByteArray("(7 x 8 x 8): 64 of 56 bytes are there");
}

// The pictures that it names are those of the series.
void TestReadSegments::whatDiffersFromItsPicturesIsTold() {
  QFETCH(int, rows);
  QFETCH(int, columns);
  QFETCH(QByteArray, says);
  Sliced in;
  const std::string path = in.write(".dcm");
  editFile(path, [&](DcmDataset& data) {
    data.putAndInsertUint16(DCM_Rows, Uint16(rows));
    data.putAndInsertUint16(DCM_Columns, Uint16(columns));
  });
  const auto out = readSegments(path, in.series, in.grid);
  QVERIFY(!out);
  const std::string pictures = "; the pictures that it names have 7 rows and 9 columns.";
  QVERIFY2(out.message().starts_with(path) && out.message().ends_with(says.toStdString() + pictures),
           out.message().c_str());
  Series other = in.series;
  other.sopInstanceUids.clear();
  const auto ofOther = readSegments(path, other, in.grid);
  QVERIFY(!ofOther && ofOther.message().ends_with("are there."));
}

// As many pixels, of which hardly one is where it was.
void TestReadSegments::rowsForColumnsAreTold() {
  Sliced in;
  const std::string path = in.write(".dcm");
  editFile(path, [](DcmDataset& data) {
    data.putAndInsertUint16(DCM_Rows, 9);
    data.putAndInsertUint16(DCM_Columns, 7);
  });
  const auto out = readSegments(path, in.series, in.grid);
  QVERIFY2(out, out ? "" : out.message().c_str());
  QCOMPARE(out->notes.back(), "The frames of " + path +
                                  " have 9 rows and 7 columns; the pictures that it names have 7 rows and 9 "
                                  "columns.");
}

void TestReadSegments::anotherFrameOfReferenceIsRefused() {
  Sliced in;
  const std::string path = in.write(".dcm");
  Series other = in.series;
  other.frameOfReferenceUid = "1.2.3.8";
  QVERIFY2(readSegments(path, other, in.grid).ok(), "it names pictures of the series");
  other.sopInstanceUids.clear();
  const auto refused = readSegments(path, other, in.grid);
  QVERIFY(!refused && refused.message().find("another frame of reference") != std::string::npos);
  other.frameOfReferenceUid.clear();  // a series that is no DICOM
  QVERIFY(readSegments(path, other, in.grid).ok());
}

void TestReadSegments::namesAndColoursAreGivenWhereThereAreNone_data() {
  QTest::addColumn<QByteArray>("first");
  QTest::addColumn<QByteArray>("second");
  QTest::addColumn<QByteArray>("firstGiven");
  QTest::addColumn<QByteArray>("secondGiven");
  QTest::addColumn<QByteArray>("told");
  const auto row = [](const char* title, const char* first, const char* second, const char* firstGiven,
                      const char* secondGiven, const char* told) {
    QTest::newRow(title) << QByteArray(first) << QByteArray(second) << QByteArray(firstGiven)
                         << QByteArray(secondGiven) << QByteArray(told);
  };
  const char* const unnamed = ": what has no name is called ";
  row("two names", "Bone", "Skin", "Bone", "Skin", "");
  row("twice one", "Bone", "Bone", "Bone", "Bone (2)",
      ": what has the name of another segment is called Bone (2).");
  row("none", "", "Skin", "Segment 1", "Skin", (QByteArray(unnamed) + "Segment 1.").constData());
  row("blanks", "Bone", "  ", "Bone", "Segment 2", (QByteArray(unnamed) + "Segment 2.").constData());
  row("none twice", "", "", "Segment 1", "Segment 2",
      (QByteArray(unnamed) + "Segment 1, Segment 2.").constData());
  row("one that another has", "", "Segment 1", "Segment 1 (2)", "Segment 1",
      (QByteArray(unnamed) + "Segment 1 (2).").constData());
}

void TestReadSegments::namesAndColoursAreGivenWhereThereAreNone() {
  QFETCH(QByteArray, first);
  QFETCH(QByteArray, second);
  QFETCH(QByteArray, firstGiven);
  QFETCH(QByteArray, secondGiven);
  QFETCH(QByteArray, told);
  Sliced in;
  const std::string path = in.folder.path("a.seg.nrrd");
  const std::string header =
      "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 1 1\n"
      "space directions: (1,0,0) (0,1,0) (0,0,2)\nencoding: raw\nspace origin: (0,0,0)\n"
      "Segment0_Name:=" +
      first.toStdString() +
      "\nSegment0_LabelValue:=1\nSegment0_Layer:=0\nSegment1_Name:=" + second.toStdString() +
      "\nSegment1_LabelValue:=2\nSegment1_Layer:=0\n\n\1\2";
  writeAll(path, {header.begin(), header.end()});
  const auto out = readSegments(path);
  QVERIFY2(out, out ? "" : out.message().c_str());
  const std::vector<Segment>& segments = out->maps.at(0).segments;
  QCOMPARE(segments.size(), std::size_t(2));
  QCOMPARE(segments[0].label, firstGiven.toStdString());
  QCOMPARE(segments[1].label, secondGiven.toStdString());
  QVERIFY(segments[0].colour == tenColour(1) && segments[1].colour == tenColour(2));
  QCOMPARE(out->notes.size(), std::size_t(told.isEmpty() ? 0 : 1));
  if (!told.isEmpty()) QCOMPARE(out->notes[0], path + told.toStdString());
}

void TestReadSegments::filesAreThoseThatWereRead() {
  Sliced in;
  const auto filesOf = [&](const std::string& path) {
    const auto out = readSegments(path, in.series, in.grid);
    return out ? std::set<std::string>(out->files.begin(), out->files.end()) : std::set<std::string>();
  };
  const std::string image = in.write(".nii.gz");
  QVERIFY(filesOf(image) == (std::set{image, in.folder.path("out.label")}));
  const std::string slicers = in.write(".seg.nrrd"), dicom = in.write(".dcm");
  QVERIFY(filesOf(slicers) == std::set{slicers});
  QVERIFY(filesOf(dicom) == std::set{dicom});
}

void TestReadSegments::whatHoldsNoneIsRefused_data() {
  QTest::addColumn<QByteArray>("name");
  QTest::addColumn<QByteArray>("contents");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* title, const char* name, const QByteArray& contents, const char* says) {
    QTest::newRow(title) << QByteArray(name) << contents << QByteArray(says);
  };
  const QByteArray nrrd =
      "NRRD0004\ntype: int16\ndimension: 3\nsizes: 2 1 1\nencoding: raw\nendian: little\n";
  row("there is none", "none", {}, "is no file that can be read");
  row("a text", "a.txt", "This is a text.", "holds no segments");
  row("nothing in it", "empty.dcm", "", "");
  row("a slice", "s0", {}, "holds no segments");
  row("a picture", "a.nrrd", nrrd + QByteArray("\n\xff\xff\x01\0", 5), "values that are no labels");
  row("background alone", "b.nrrd", nrrd + QByteArray("\n\0\0\0\0", 5), "holds no segments");
  row("by its name alone", "c.seg.nrrd", "This is a text.", "c.seg.nrrd");
}

void TestReadSegments::whatHoldsNoneIsRefused() {
  QFETCH(QByteArray, name);
  QFETCH(QByteArray, contents);
  QFETCH(QByteArray, says);
  Sliced in;
  const std::string path = in.folder.path(name.toStdString());
  if (!contents.isNull()) writeAll(path, {contents.begin(), contents.end()});
  const auto out = readSegments(path, in.series, in.grid);
  QVERIFY(!out);
  QVERIFY2(out.message().find(path) != std::string::npos, out.message().c_str());
  QVERIFY2(out.message().find(says.toStdString()) != std::string::npos, out.message().c_str());
  QCOMPARE(std::ranges::count(out.message(), '\n'), std::ptrdiff_t(0));
  const auto folder = readSegments(in.folder.path(), in.series, in.grid);
  QVERIFY(!folder && folder.message().find("is no file") != std::string::npos);
}

// All small files of the data: segments on this grid, or a sentence.
void TestReadSegments::filesOfOthersCostASentence() {
  NEED_DATA(dataPath());
  const Sliced in;
  int count = 0;
  for (const char* folder : {"dicom-2d", "nifti-meta", "nrrd-format-tests", "volumes-classic"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(dataPath(folder))) {
      constexpr std::uintmax_t most = 400'000;
      if (!entry.is_regular_file() || entry.file_size() > most) continue;
      const std::string path = entry.path().string();
      const auto out = readSegments(path, in.series, in.grid);
      ++count;
      if (!out) {
        QVERIFY2(out.message().ends_with('.') && out.message().find('/') != std::string::npos,
                 (path + " says " + out.message()).c_str());
        continue;
      }
      for (const Segmented& map : out->maps) QVERIFY2(map.labels.geometry() == in.grid, path.c_str());
    }
  QVERIFY(count > 50);
}

void TestReadSegments::cutOffFilesCostASentence_data() {
  addEndings({".seg.nrrd", ".dcm", ".nii.gz", ".mha"});
}

void TestReadSegments::cutOffFilesCostASentence() {
  QFETCH(QByteArray, ending);
  Sliced in;
  const std::string path = in.write(ending), cut = in.folder.path("cut" + ending.toStdString());
  const std::vector<std::uint8_t> whole = readAll(path);
  const Seeds seeds = seedsOf(60, 1000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    std::vector<std::uint8_t> bytes = whole;
    if (chance.oneIn(2))
      bytes.resize(std::size_t(chance.below(int(whole.size()))));
    else
      for (int n = 0; n < 1 + chance.below(8); ++n)
        bytes[std::size_t(chance.below(int(whole.size())))] = std::uint8_t(chance.below(256));
    writeAll(cut, bytes);
    const auto out = readSegments(cut, in.series, in.grid);
    const QByteArray where = "seed " + QByteArray::number(seed);
    if (!out) {
      QVERIFY2(out.message().find(cut) != std::string::npos, where + ": " + out.message().c_str());
      continue;
    }
    for (const Segmented& map : out->maps) QVERIFY2(map.labels.geometry() == in.grid, where);
  }
}

void TestReadSegments::namesThatSaySo() {
  Sliced in;
  QVERIFY(isNamedAsSegments(in.write(".seg.nrrd")));
  QVERIFY(isNamedAsSegments(in.write(".nii.gz")));
  QVERIFY(!isNamedAsSegments(in.write(".dcm")));
  std::filesystem::remove(in.folder.path("out.label"));
  QVERIFY(!isNamedAsSegments(in.folder.path("out.nii.gz")));
}

// By its own name, and by a link to it.
void TestReadSegments::aFileOfTheSeriesIsNotWrittenOver() {
  Sliced in;
  const std::string path = in.folder.path("slice.dcm"), link = in.folder.path("link.seg.nrrd");
  std::filesystem::rename(in.series.files[3], path);
  in.series.files[3] = path;
  std::filesystem::create_symlink(path, link);
  const std::vector<std::uint8_t> before = readAll(path);
  for (const std::string& wanted : {path, link}) {
    const auto done = exportSegments(wanted, {&in.segments, 1}, in.series);
    QVERIFY(!done);
    QCOMPARE(done.message(), wanted + " is not written: it is a file of the series.");
    QVERIFY(readAll(path) == before);
  }
}

VOLUMEN_TEST(TestReadSegments);
#include "tst_read_segments.moc"
