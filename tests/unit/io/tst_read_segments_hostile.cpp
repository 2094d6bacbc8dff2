// Guards export/read_segments.h: a file without segments, a damaged one, or one that contradicts its pictures
// gives a sentence that names it.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "io/export/read_segments.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/sliced_segments.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestReadSegmentsHostile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void repeatedFramesAreNoOtherGrid();
  void whatDiffersFromItsPicturesIsTold_data();
  void whatDiffersFromItsPicturesIsTold();
  void rowsForColumnsAreTold();
  void whatHoldsNoneIsRefused_data();
  void whatHoldsNoneIsRefused();
  void filesOfOthersCostASentence();
  void cutOffFilesCostASentence_data();
  void cutOffFilesCostASentence();
};

namespace {

/// Changes the elements of a DICOM file.
void editFile(const std::string& path, const std::function<void(DcmDataset&)>& edit) {
  DcmFileFormat file;
  if (file.loadFile(path.c_str()).bad()) return;
  edit(*file.getDataset());
  file.saveFile(path.c_str());
}

}  // namespace

// Assigns all frames to the first segment, so that each position occurs twice.
void TestReadSegmentsHostile::repeatedFramesAreNoOtherGrid() {
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

void TestReadSegmentsHostile::whatDiffersFromItsPicturesIsTold_data() {
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("rows too few") << 6 << 9 << QByteArray("(6 x 9 x 8): 64 of 54 bytes are there");
  QTest::newRow("rows too many") << 8 << 9 << QByteArray("cut off: 64 of 72 bytes are there");
  QTest::newRow("columns too few") << 7 << 8 << QByteArray("(7 x 8 x 8): 64 of 56 bytes are there");
}

// The pictures that it names are those of the series.
void TestReadSegmentsHostile::whatDiffersFromItsPicturesIsTold() {
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

// The number of pixels is the same, but hardly any is in place.
void TestReadSegmentsHostile::rowsForColumnsAreTold() {
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

void TestReadSegmentsHostile::whatHoldsNoneIsRefused_data() {
  QTest::addColumn<QByteArray>("name");
  QTest::addColumn<QByteArray>("contents");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* title, const char* name, const QByteArray& contents, const char* says) {
    QTest::newRow(title) << QByteArray(name) << contents << QByteArray(says);
  };
  const QByteArray nrrd =
      "NRRD0004\ntype: int16\ndimension: 3\nsizes: 2 1 1\nencoding: raw\nendian: little\n";
  row("there is none", "none", {}, "does not exist");
  row("a text", "a.txt", "This is a text.", "holds no segments");
  row("nothing in it", "empty.dcm", "", "");
  row("a slice", "s0", {}, "holds no segments");
  row("a picture", "a.nrrd", nrrd + QByteArray("\n\xff\xff\x01\0", 5), "values that are no labels");
  row("background alone", "b.nrrd", nrrd + QByteArray("\n\0\0\0\0", 5), "holds no segments");
  row("by its name alone", "c.seg.nrrd", "This is a text.", "c.seg.nrrd");
}

void TestReadSegmentsHostile::whatHoldsNoneIsRefused() {
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

// Reads all small files of the data. Each gives segments on this grid or a sentence.
void TestReadSegmentsHostile::filesOfOthersCostASentence() {
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

void TestReadSegmentsHostile::cutOffFilesCostASentence_data() {
  addEndings({".seg.nrrd", ".dcm", ".nii.gz", ".mha"});
}

void TestReadSegmentsHostile::cutOffFilesCostASentence() {
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

VOLUMEN_TEST(TestReadSegmentsHostile);
#include "tst_read_segments_hostile.moc"
