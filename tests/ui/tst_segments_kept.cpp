// Guards design.md 8 and 11: segments are saved with the session and by autosave, with their labels in a file
// beside it.
#include <QMenu>
#include <nlohmann/json.hpp>

#include "io/export/seg_nrrd.h"
#include "results/segments/segments.h"
#include "tests/fixtures/chance.h"
#include "tests/ui/session_folder.h"
#include "tests/ui/sphere_segments.h"
#include "tests/unit/suite.h"
#include "ui/controller/autosave.h"
#include "ui/controller/label_changes.h"
#include "ui/controller/open_session.h"
#include "ui/controller/segment_files.h"
#include "ui/workspace/series_segments.h"
#include "viewer/segment/brush.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentsKept : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { QDir(Autosave::folder()).removeRecursively(); }
  void autosaveKeepsWhatChanged();
  void changesMakeTheOtherMap();
  void aStrokeCostsItsBricks();
  void sessionsKeepTwo();
  void sessionsOfBeforeOpen();
  void aSessionWithAnUnknownStepOpens();
  void sessionsKeepIt_data();
  void sessionsKeepIt();
  void whatIsNotBesideTheSessionIsMissing_data();
  void whatIsNotBesideTheSessionIsMissing();
  void filesThatNoSessionNamesGo();
  void aFileThatWasDamagedIsWrittenAgain();
  void workThatCannotBeReadIsKept_data();
  void workThatCannotBeReadIsKept();
  void theLabelsMoveWithDiscardedWork();
};

namespace {

// Saves a session file and returns its path; empty if it fails.
std::string savedAs(const SessionFolder& folder, const Workspace& workspace, const char* name = "s.volumen") {
  const std::string path = folder.at(name).toStdString();
  const Status status = saveSession(path, workspace);
  return status ? path : std::string();
}

// Changes the first segment map in a session file.
bool changeMapIn(const std::string& path, void (*change)(nlohmann::ordered_json& map)) {
  QFile file(QString::fromStdString(path));
  if (!file.open(QIODevice::ReadOnly)) return false;
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(file.readAll().toStdString());
  file.close();
  change(json.at("segmentMaps").at(0));
  return file.open(QIODevice::WriteOnly) && file.write(QByteArray::fromStdString(json.dump())) > 0;
}

QStringList labelFiles(const SessionFolder& folder) { return segmentFilesOf(folder.at("s.volumen")); }

}  // namespace

// Autosave writes the first map completely, and only the differences of later ones.
void TestSegmentsKept::autosaveKeepsWhatChanged() {
  Workspace with;
  {
    SegmentsWindow w;
    const auto files = [](const char* ending) {
      return int(QDir(Autosave::folder()).entryList({QLatin1Char('*') + QLatin1String(ending)}).size());
    };
    QVERIFY(w.segment(0.5, 1));
    QTRY_COMPARE_WITH_TIMEOUT(files(".seg.nrrd"), 1, longest);
    QVERIFY(w.segment(0, 0.4));
    QTRY_COMPARE_WITH_TIMEOUT(files(".labels"), 1, longest);
    QCOMPARE(files(".seg.nrrd"), 1);
    with = w.workspace();
    w.window.end();
  }
  Journey w;
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QWidget>("offerBar")->isVisible(), longest);
  QTest::mouseClick(w.child<QWidget>("offerAccept"), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(w.window.session().workspace().segmentMaps.size(), std::size_t(1), longest);
  QVERIFY(w.window.session().workspace().segmentMaps == with.segmentMaps);
  w.window.end();
}

// Random maps whose grid cuts some of their bricks. Damaged bytes give an error or another map.
void TestSegmentsKept::changesMakeTheOtherMap() {
  Chance chance(5);
  const std::string checksum(40, 'a');
  for (int n = 0; n < 50; ++n) {
    VoxelGeometry grid;
    grid.size = {1 + chance.below(70), 1 + chance.below(40), 1 + chance.below(70)};
    const auto edited = [&](const LabelMap& from, int count) {
      LabelEdit edit(from);
      while (count-- > 0)
        edit.set({chance.below(grid.size.x), chance.below(grid.size.y), chance.below(grid.size.z)},
                 std::uint8_t(chance.below(256)));
      return edit.done();
    };
    const LabelMap base = edited(LabelMap(grid), chance.below(2000)),
                   map = edited(chance.oneIn(4) ? LabelMap(grid) : base, chance.below(50));
    const QByteArray changes = labelChanges(base, checksum, map);
    QCOMPARE(baseOfChanges(changes), std::optional(checksum));
    const auto made = withLabelChanges(base, changes);
    QVERIFY(made && *made == map);
    QVERIFY(!withLabelChanges(base, changes.left(chance.below(int(changes.size())))));
    QByteArray damaged = changes;
    damaged[chance.below(int(damaged.size()))] = char(chance.below(256));
    (void)withLabelChanges(base, damaged);
    (void)withLabelChanges(LabelMap(VoxelGeometry{}), changes);
  }
}

// A ball of 20 voxels reaches into at most eight bricks of 32 KB. Of a map of 79 million voxels, undo holds
// no more than that, and less is written.
void TestSegmentsKept::aStrokeCostsItsBricks() {
  VoxelGeometry grid;
  grid.size = {512, 512, 300};
  const LabelMap before(grid);
  const glm::dvec3 middle(255, 256, 160);
  const LabelMap after = painted(before, ballStroke(grid, middle, middle, 10), PaintRules{.label = 1});
  QCOMPARE(labelCounts(after)[1], std::int64_t(4169));
  QVERIFY(after.bytes() - before.bytes() <= 8 * sizeof(LabelMap::Voxels));
  QVERIFY(labelChanges(before, std::string(40, 'a'), after).size() < 8 * 1024);
}

// A session keeps both segments with all their settings.
void TestSegmentsKept::sessionsKeepTwo() {
  const SessionFolder folder;
  SegmentsWindow w;
  QVERIFY(w.segment(0.5, 1));
  QVERIFY(w.segment(0, 0.4));
  QCOMPARE(w.map().segments.size(), std::size_t(2));
  const SeriesKey series = w.map().series;
  w.window.session().change(QStringLiteral("test"),
                            withSegmentChanged(w.workspace(), series, 1, [](Segment& s) {
                              s.label = "B\xc3\xa4ll";
                              s.visible = false;
                              s.locked = true;
                              s.opacity = 0.25;
                              s.type = {"272673000", "SCT", "Bone"};
                              s.modifier = {"7771000", "SCT", "Left"};
                            }));
  w.window.session().change(QStringLiteral("test"), withCurrentSegment(w.workspace(), series, 1));
  const std::string path = savedAs(folder, w.workspace());
  QCOMPARE(labelFiles(folder).size(), 1);
  const auto opened = openSession(path);
  QVERIFY(opened && opened->problems.isEmpty());
  QVERIFY(opened->workspace == w.workspace());
  QCOMPARE(currentSegment(opened->workspace.segmentMaps.front())->number, 1);
}

// An old session stores a category and a type only by meaning, and nothing else of a look.
void TestSegmentsKept::sessionsOfBeforeOpen() {
  const SessionFolder folder;
  SegmentsWindow w;
  QVERIFY(w.segment(0.5, 1));
  const std::string path = savedAs(folder, w.workspace());
  QVERIFY(changeMapIn(path, [](nlohmann::ordered_json& map) {
    map.erase("current");
    auto& segment = map.at("segments").at(0);
    for (const char* name : {"visible", "locked", "opacity"}) segment.erase(name);
    segment["category"] = "Tissue";
    segment["type"] = "Bone";
  }));
  const auto opened = openSession(path);
  QVERIFY2(opened, opened ? "" : opened.message().c_str());
  const Segment read = opened->workspace.segmentMaps.front().segments.front();
  QVERIFY(read.category == (Code{"", "", "Tissue"}) && read.type == (Code{"", "", "Bone"}));
  QVERIFY(read.visible && !read.locked && read.opacity == 1 && read.label == "0.5 to 1");
}

// Segments with an unknown step open as saved, but count as made by hand, and a message says so.
void TestSegmentsKept::aSessionWithAnUnknownStepOpens() {
  const SessionFolder folder;
  SegmentsWindow w;
  QVERIFY(w.segment(0.5, 1));
  QVERIFY(!w.map().steps.empty());
  const std::string path = savedAs(folder, w.workspace());
  QVERIFY(changeMapIn(path, [](nlohmann::ordered_json& map) {
    map.at("steps").push_back({{"step", "thaw"}, {"segment", "1"}});
  }));
  const auto opened = openSession(path);
  QVERIFY2(opened, opened ? "" : opened.message().c_str());
  QCOMPARE(opened->problems.size(), 1);
  QVERIFY2(opened->problems.front().contains(QStringLiteral("\"thaw\" is no step")),
           qPrintable(opened->problems.front()));
  Workspace expected = w.workspace();
  expected.segmentMaps.editIf([](const SegmentMap&) { return true; },
                              [](SegmentMap& map) { map.steps.clear(); });
  QVERIFY(opened->workspace == expected);
}

void TestSegmentsKept::sessionsKeepIt_data() {
  QTest::addColumn<QString>("renamed");
  QTest::newRow("where it was saved") << QString();
  QTest::newRow("under another name, its labels under the old one") << QStringLiteral("other.volumen");
}

void TestSegmentsKept::sessionsKeepIt() {
  QFETCH(QString, renamed);
  const SessionFolder folder;
  Workspace with;
  {
    SegmentsWindow w;
    QVERIFY(w.segment(0.5, 1));
    with = w.workspace();
    QVERIFY(!savedAs(folder, with).empty());
  }
  QCOMPARE(labelFiles(folder).size(), 1);
  QString path = folder.at("s.volumen");
  if (!renamed.isEmpty()) QVERIFY(QFile::rename(path, folder.at(qPrintable(renamed))));
  if (!renamed.isEmpty()) path = folder.at(qPrintable(renamed));
  const auto opened = openSession(path.toStdString());
  QVERIFY(opened);
  QCOMPARE(opened->problems, QStringList());
  QVERIFY(opened->workspace == with);
  // In a window the numbers are restored, and nothing needs saving.
  Journey again({path});
  auto* result = again.child<QLabel>("segmentResult");
  QTRY_VERIFY_WITH_TIMEOUT(result->text().contains(QStringLiteral("voxels")), longest);
  QVERIFY(again.window.close());
}

void TestSegmentsKept::whatIsNotBesideTheSessionIsMissing_data() {
  QTest::addColumn<bool>("there");
  QTest::newRow("no file") << false;
  QTest::newRow("another volume under its name") << true;
}

// Missing labels are reported. The rest of the session opens, and later saves still refer to them.
void TestSegmentsKept::whatIsNotBesideTheSessionIsMissing() {
  QFETCH(bool, there);
  const SessionFolder folder;
  SegmentsWindow w;
  QVERIFY(w.segment(0.5, 1));
  const std::string path = savedAs(folder, w.workspace());
  const QString file = labelFiles(folder).value(0);
  QVERIFY(QFile::rename(file, folder.at("kept")));
  if (there) {
    LabelEdit edit(*w.map().labels);
    edit.set({0, 0, 0}, 1);
    QVERIFY(writeSegNrrd(edit.done(), w.map().segments, file.toStdString()));
  }
  const auto opened = openSession(path);
  QVERIFY(opened);
  QCOMPARE(opened->problems.size(), 1);
  QVERIFY(opened->problems.front().contains(QStringLiteral("0.5 to 1")));
  QVERIFY(!opened->workspace.segmentMaps.front().labels);
  Workspace without = opened->workspace, with = w.workspace();
  without.segmentMaps.clear();
  with.segmentMaps.clear();
  QVERIFY(without == with);
  QVERIFY(saveSession(path, opened->workspace));
  QFile::remove(file);
  QVERIFY(QFile::rename(folder.at("kept"), file));
  QVERIFY(openSession(path)->workspace == w.workspace());
}

void TestSegmentsKept::filesThatNoSessionNamesGo() {
  const SessionFolder folder;
  SegmentsWindow w;
  QVERIFY(w.segment(0.5, 1));
  QVERIFY(!savedAs(folder, w.workspace()).empty());
  const QStringList first = labelFiles(folder);
  const QDateTime written = QFileInfo(first.value(0)).lastModified();
  QVERIFY(!savedAs(folder, w.workspace()).empty());
  QCOMPARE(QFileInfo(first.value(0)).lastModified(), written);  // existing files are not rewritten
  QVERIFY(!savedAs(folder, w.workspace(), "copy.volumen").empty());
  QVERIFY(w.segment(0, 0.4));
  QVERIFY(!savedAs(folder, w.workspace()).empty());
  QCOMPARE(labelFiles(folder).size(), 2);  // the copy still needs the first
  QVERIFY(QFile::remove(folder.at("copy.volumen")));
  w.undo();
  QVERIFY(!savedAs(folder, w.workspace()).empty());
  QCOMPARE(labelFiles(folder), first);
}

void TestSegmentsKept::aFileThatWasDamagedIsWrittenAgain() {
  const SessionFolder folder;
  SegmentsWindow w;
  QVERIFY(w.segment(0.5, 1));
  const std::string path = savedAs(folder, w.workspace());
  QFile file(labelFiles(folder).value(0));
  QVERIFY(file.resize(100));
  QVERIFY(openSession(path)->workspace.segmentMaps.front().missing);
  QVERIFY(!savedAs(folder, w.workspace()).empty());
  QVERIFY(openSession(path)->workspace == w.workspace());
}

void TestSegmentsKept::workThatCannotBeReadIsKept_data() {
  QTest::addColumn<bool>("areLabels");
  QTest::newRow("its labels") << true;
  QTest::newRow("how it was made") << false;
}

// Work is restored without its unreadable part, and also moved aside for later.
void TestSegmentsKept::workThatCannotBeReadIsKept() {
  QFETCH(bool, areLabels);
  {
    SegmentsWindow w;
    QVERIFY(w.segment(0.5, 1));
    w.window.end();
  }
  const QDir kept(Autosave::folder());
  const auto fileOf = [&](const char* ending) {
    return kept.filePath(kept.entryList({QLatin1String(ending)}, QDir::Files).value(0));
  };
  if (areLabels)
    QVERIFY(QFile(fileOf("*.seg.nrrd")).resize(100));
  else
    QVERIFY(changeMapIn(fileOf("*.volumen").toStdString(), [](nlohmann::ordered_json& map) {
      map.at("steps").push_back({{"step", "thaw"}, {"segment", "1"}});
    }));
  Journey w;
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QWidget>("offerBar")->isVisible(), longest);
  QTest::mouseClick(w.child<QWidget>("offerAccept"), Qt::LeftButton);
  auto* earlier = w.child<QMenu>("earlierMenu");
  QTRY_COMPARE_WITH_TIMEOUT(earlier->actions().size(), 1, longest);
  QCOMPARE(QDir(Autosave::folder() + QStringLiteral("/discarded"))
               .entryList({QStringLiteral("*.seg.nrrd")})
               .size(),
           1);
  w.window.end();
}

void TestSegmentsKept::theLabelsMoveWithDiscardedWork() {
  Workspace with;
  {
    SegmentsWindow w;
    QVERIFY(w.segment(0.5, 1));
    with = w.workspace();
    w.window.end();
  }
  {
    Journey w;
    QTRY_VERIFY_WITH_TIMEOUT(w.child<QWidget>("offerBar")->isVisible(), longest);
    QTest::mouseClick(w.child<QWidget>("offerRefuse"), Qt::LeftButton);
    discard(w);
    auto* earlier = w.child<QMenu>("earlierMenu");
    QTRY_COMPARE_WITH_TIMEOUT(earlier->actions().size(), 1, longest);
    earlier->actions().front()->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(w.window.session().workspace().segmentMaps.size(), std::size_t(1), longest);
    QVERIFY(w.window.session().workspace().segmentMaps == with.segmentMaps);
    w.window.end();
  }
}

VOLUMEN_TEST(TestSegmentsKept);
#include "tst_segments_kept.moc"
