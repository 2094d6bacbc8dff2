// Guards export/read_segments.h: segments are read from every written kind of file, recognised by contents
// and not by name. Losses on another grid are reported with figures. Files that lie elsewhere give a sentence
// that names them.
#include <filesystem>
#include <set>

#include "io/export/export_segments.h"
#include "io/export/read_segments.h"
#include "tests/unit/io/sliced_segments.h"
#include "tests/unit/suite.h"
#include "viewer/segment/names_and_colours.h"

using namespace volumen;
using namespace volumen::tests;

class TestReadSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyComeBackAsTheyWent_data();
  void theyComeBackAsTheyWent();
  void whatAnotherGridCostsIsTold_data();
  void whatAnotherGridCostsIsTold();
  void anotherFrameOfReferenceIsRefused();
  void namesAndColoursAreGivenWhereThereAreNone_data();
  void namesAndColoursAreGivenWhereThereAreNone();
  void filesAreThoseThatWereRead();
  void namesThatSaySo();
  void aFileOfTheSeriesIsNotWrittenOver();
};

void TestReadSegments::theyComeBackAsTheyWent_data() { addEndings({".seg.nrrd", ".dcm", ".nii.gz", ".mha"}); }

void TestReadSegments::theyComeBackAsTheyWent() {
  QFETCH(QByteArray, ending);
  Sliced in;
  std::string path = in.write(ending);
  QVERIFY(!path.empty());
  const bool hasCodes = ending == ".seg.nrrd" || ending == ".dcm";
  if (hasCodes) {  // only the table of an image is found by its name
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

// Covers 4 x 3 x 9 voxels of 2 mm^3. The other grid begins two slices later and has voxels of half the width.
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

void TestReadSegments::anotherFrameOfReferenceIsRefused() {
  Sliced in;
  const std::string path = in.write(".dcm");
  Series other = in.series;
  other.frameOfReferenceUid = "1.2.3.8";
  QVERIFY2(readSegments(path, other, in.grid).ok(), "it names pictures of the series");
  other.sopInstanceUids.clear();
  const auto refused = readSegments(path, other, in.grid);
  QVERIFY(!refused && refused.message().find("another frame of reference") != std::string::npos);
  other.frameOfReferenceUid.clear();  // a series that is not DICOM
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
