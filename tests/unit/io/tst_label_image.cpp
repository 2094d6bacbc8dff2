// Guards export/label_image.h and label_table.h: labels, names and colours survive a round trip as NIfTI,
// MetaImage and NRRD. Errors in a table cost names, not labels.
#include <QFile>
#include <QTemporaryDir>
#include <algorithm>

#include "io/export/label_image.h"
#include "io/export/label_table.h"
#include "io/files/write_volume.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"
#include "viewer/segment/labels_on.h"

using namespace volumen;
using namespace volumen::tests;

class TestLabelImage : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void labelsComeBackAsTheyWent_data();
  void labelsComeBackAsTheyWent();
  void theTableIsOneOfItkSnap();
  void labelsWithoutATableAreNamedByNumber();
  void numbersAbove255BecomeLabels();
  void labelsMayBeOffByRounding_data();
  void labelsMayBeOffByRounding();
  void aDamagedTableIsTold_data();
  void aDamagedTableIsTold();
  void whatIsNoImageOfLabelsIsRefused();
};

namespace {

std::string in(const QTemporaryDir& folder, const char* name) {
  return folder.filePath(QString::fromLatin1(name)).toStdString();
}

void writeText(const std::string& path, const std::string& text) {
  writeAll(path, {text.begin(), text.end()});
}

/// Writes a row of voxels with these real values.
void writeValues(const std::string& path, const std::vector<float>& values) {
  VolumeParts parts;
  parts.geometry.size = {int(values.size()), 1, 1};
  parts.values = values;
  QVERIFY(writeVolume(*volumeFrom(std::move(parts)), path).ok());
}

}  // namespace

void TestLabelImage::labelsComeBackAsTheyWent_data() {
  QTest::addColumn<QByteArray>("name");
  for (const char* name : {"a.nii.gz", "a.mha", "a.nrrd"}) QTest::newRow(name) << QByteArray(name);
}

void TestLabelImage::labelsComeBackAsTheyWent() {
  QFETCH(QByteArray, name);
  const QTemporaryDir folder;
  const std::string path = in(folder, name);
  const Seeds seeds = seedsOf(300, 3000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    VoxelGeometry grid;
    grid.size = {1 + chance.below(40), 1 + chance.below(40), 1 + chance.below(9)};
    grid.patientFromVoxelStep = chance.between(0.3, 3) * grids[chance.below(5)].patientFromVoxelStep;
    grid.origin = 100.0 * chance.vector();
    const int labels = 1 + chance.below(255);
    DenseLabels dense{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()))};
    for (std::uint8_t& label : dense.labels) label = std::uint8_t(chance.below(labels + 1));
    Segmented made{{}, LabelMap(dense)};
    for (int n = 1; n <= labels; ++n) {
      Segment segment{.number = n, .label = "Röhre # " + std::to_string(n)};
      segment.colour = glm::u8vec3(chance.below(256), chance.below(256), chance.below(256));
      segment.visible = chance.oneIn(2);
      segment.opacity = chance.share();
      made.segments.push_back(segment);
    }
    QVERIFY(writeLabelImage(made, path).ok());
    const auto out = readLabelImage(path);
    QVERIFY2(out, out ? "" : out.message().c_str());
    QVERIFY(out->notes.empty());
    QCOMPARE(out->maps.size(), std::size_t(1));
    QVERIFY2(out->maps[0].segments == made.segments, qPrintable(QString::number(seed)));
    QVERIFY(out->maps[0].labels.dense().labels == dense.labels);
    QVERIFY(areSameVoxels(out->maps[0].labels.geometry(), grid));  // NIfTI rounds to float32
    const auto placed = onGrid(*out, grid);
    QVERIFY(placed && placed->notes.empty() && placed->maps[0].labels == made.labels);
  }
}

void TestLabelImage::theTableIsOneOfItkSnap() {
  const QTemporaryDir folder;
  const std::string path = in(folder, "a.nii.gz");
  QCOMPARE(labelTableOf(path), in(folder, "a.label"));
  Segmented made{{{.number = 3, .label = "a \"b\"\nc"}}, LabelMap(VoxelGeometry{.size = {2, 2, 2}})};
  made.segments[0].colour = glm::u8vec3(1, 20, 255);
  made.segments[0].opacity = 0.25;
  QVERIFY(writeLabelImage(made, path).ok());
  const std::vector<std::uint8_t> bytes = readAll(labelTableOf(path));
  const QByteArrayList lines =
      QByteArray(reinterpret_cast<const char*>(bytes.data()), qsizetype(bytes.size())).split('\n');
  QVERIFY(lines[1].contains("ITK-SnAP Label Description File"));
  QList<QByteArray> rows;
  for (const QByteArray& line : lines)
    if (!line.isEmpty() && !line.startsWith('#')) rows << line.simplified();
  QCOMPARE(rows, (QList<QByteArray>{"0 0 0 0 0 0 0 \"Clear Label\"", "3 1 20 255 0.25 1 1 \"a 'b' c\""}));
  const auto read = readLabelTable(labelTableOf(path));
  QVERIFY(read && read->size() == 1 && read->front().segment.label == "a 'b' c");
}

void TestLabelImage::labelsWithoutATableAreNamedByNumber() {
  const QTemporaryDir folder;
  const std::string path = in(folder, "a.mha");
  writeValues(path, {0, 4, 2, 4});
  const auto out = readLabelImage(path);
  QVERIFY2(out, out ? "" : out.message().c_str());
  QCOMPARE(out->maps[0].segments.size(), std::size_t(2));
  QCOMPARE(out->maps[0].segments[1].label, std::string("Label 4"));
  QCOMPARE(out->maps[0].labels.dense().labels, (std::vector<std::uint8_t>{0, 4, 2, 4}));
}

void TestLabelImage::numbersAbove255BecomeLabels() {
  const QTemporaryDir folder;
  const std::string path = in(folder, "a.nii.gz");
  writeValues(path, {1, 1000, 0, 70000});
  writeText(labelTableOf(path),
            "1000 1 2 3 1 1 1 \"a\"\n70000 4 5 6 0 0 0 \"b\"\n5 1 1 1 1 1 1 \"not there\"\n");
  const auto out = readLabelImage(path);
  QVERIFY2(out, out ? "" : out.message().c_str());
  const Segmented& map = out->maps[0];
  QCOMPARE(map.segments.size(), std::size_t(4));
  std::vector<std::string> names;
  const std::vector<std::uint8_t> labels = map.labels.dense().labels;
  for (const std::uint8_t label : labels) {
    const auto found = std::ranges::find(map.segments, int(label), &Segment::number);
    names.push_back(found == map.segments.end() ? "" : found->label);
  }
  QCOMPARE(names, (std::vector<std::string>{"Label 1", "a", "", "b"}));
}

void TestLabelImage::labelsMayBeOffByRounding_data() {
  QTest::addColumn<QList<float>>("values");
  QTest::addColumn<QList<int>>("labels");  // empty if refused
  QTest::addColumn<QByteArray>("told");
  QTest::newRow("whole numbers") << QList<float>{0, 1, 2} << QList<int>{0, 1, 2} << QByteArray();
  QTest::newRow("above and below") << QList<float>{0, 1.0000458f, 1.9999998f} << QList<int>{0, 1, 2}
                                   << QByteArray("off whole numbers by up to 5e-05, and were rounded");
  QTest::newRow("just below 0") << QList<float>{-0.0001f, 1} << QList<int>{0, 1}
                                << QByteArray("by up to 0.0001, and");
  QTest::newRow("between two") << QList<float>{0, 1, 2.5f} << QList<int>{}
                               << QByteArray("no labels, such as 2.5:");
  QTest::newRow("as if interpolated")
      << QList<float>{0, 1, 1.01f} << QList<int>{} << QByteArray("no labels, such as 1.01:");
}

void TestLabelImage::labelsMayBeOffByRounding() {
  QFETCH(QList<float>, values);
  QFETCH(QList<int>, labels);
  QFETCH(QByteArray, told);
  const QTemporaryDir folder;
  const std::string path = in(folder, "a.nii.gz");
  writeValues(path, {values.begin(), values.end()});
  const auto out = readLabelImage(path);
  if (labels.isEmpty()) {
    QVERIFY(!out);
    QVERIFY2(out.message().find(told) != std::string::npos, out.message().c_str());
    return;
  }
  QVERIFY2(out, out ? "" : out.message().c_str());
  const auto found = out->maps[0].labels.dense().labels;
  QCOMPARE(QList<int>(found.begin(), found.end()), labels);
  QCOMPARE(out->notes.size(), std::size_t(!told.isEmpty()));
  if (!told.isEmpty()) QVERIFY2(out->notes[0].find(told) != std::string::npos, out->notes[0].c_str());
}

void TestLabelImage::aDamagedTableIsTold_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("no name") << QByteArray("# a\n\n1 2 3 4 1 1 1\n") << QByteArray("its line 3 is no label");
  QTest::newRow("a colour of 256") << QByteArray("1 256 3 4 1 1 1 \"a\"\n") << QByteArray("its line 1");
  QTest::newRow("too few numbers") << QByteArray("1 2 3 \"a\"\n") << QByteArray("its line 1");
  QTest::newRow("a number that is none") << QByteArray("1 2 x 4 1 1 1 \"a\"\n") << QByteArray("its line 1");
  QTest::newRow("not a number") << QByteArray("nan 2 3 4 1 1 1 \"a\"\n") << QByteArray("its line 1");
  QTest::newRow("more than a MiB") << QByteArray(2 << 20, '\n') << QByteArray("more than 1 MiB");
}

void TestLabelImage::aDamagedTableIsTold() {
  QFETCH(QByteArray, text);
  QFETCH(QByteArray, says);
  const QTemporaryDir folder;
  const std::string path = in(folder, "a.mha");
  writeValues(path, {0, 1});
  writeText(labelTableOf(path), text.toStdString());
  const auto out = readLabelImage(path);
  QVERIFY2(out, out ? "" : out.message().c_str());
  QCOMPARE(out->notes.size(), std::size_t(1));
  QVERIFY2(out->notes[0].find(says.toStdString()) != std::string::npos &&
               out->notes[0].starts_with(labelTableOf(path)) &&
               out->notes[0].ends_with(". None of its names and colours was taken."),
           out->notes[0].c_str());
  QCOMPARE(out->maps[0].segments.at(0).label, std::string("Label 1"));
}

void TestLabelImage::whatIsNoImageOfLabelsIsRefused() {
  const QTemporaryDir folder;
  const auto refused = [&](const std::string& path, const char* words) {
    const auto out = readLabelImage(path);
    return !out && out.message().find(words) != std::string::npos && out.message().starts_with(path);
  };
  const std::string path = in(folder, "a.nrrd");
  for (const float wrong : {0.5f, -1.f, 1e9f}) {
    writeValues(path, {0, 1, wrong});
    QVERIFY(refused(path, "no labels"));
  }
  std::vector<float> many(256);
  for (std::size_t n = 0; n < many.size(); ++n) many[n] = float(n + 1);
  writeValues(path, many);
  QVERIFY(refused(path, "256 segments"));
  QVERIFY(refused(in(folder, "none.mha"), "cannot be opened"));
  const std::string twice = in(folder, "twice.mha");
  writeValues(twice, {0, 1, 1});
  writeText(labelTableOf(twice), "1 2 3 4 1 1 1 \"a\"\n1 5 6 7 1 1 1 \"b\"\n");
  const auto ofTwoRows = readLabelImage(twice);
  QVERIFY(!ofTwoRows);
  QCOMPARE(ofTwoRows.message(), labelTableOf(twice) + " has two rows for the label 1.");
  const Segmented made{{}, LabelMap(VoxelGeometry{.size = {2, 2, 2}})};
  const Status ending = writeLabelImage(made, in(folder, "a.png"));
  QVERIFY(!ending && ending.message().find(".nii.gz") != std::string::npos);
  QVERIFY(!QFile::exists(QString::fromStdString(in(folder, "a.png.label"))));
  QVERIFY(!writeLabelImage(made, in(folder, "none/a.mha")).ok());
}

VOLUMEN_TEST(TestLabelImage);
#include "tst_label_image.moc"
