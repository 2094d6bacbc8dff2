// Guards window.md "Segment": exported segments are imported again, equal to the voxel, in one undo step.
// Files are asked for; overlaps, other grids and invalid files are reported. Nothing changes until everything
// is ready.
#include <QThread>
#include <algorithm>

#include "io/export/seg_nrrd.h"
#include "tests/ui/import_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/series_segments.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentImport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatWasExportedComesBack_data();
  void whatWasExportedComesBack();
  void namesAndNumbersThatAreTakenBecomeOthers();
  void whatOverlapsGoesToAFurtherMap();
  void anotherGridIsToldWithFigures();
  void filesThatAreNoneChangeNothing_data();
  void filesThatAreNoneChangeNothing();
  void moreThan255GoToAFurtherMap();
  void itWaitsForWhatIsBeingDone();
  void itCanBeGivenUpAtAnyMoment();
  void withoutASeriesThereIsNothingToAddTo();
};

namespace {

std::vector<Segment> manySegments(int count) {
  std::vector<Segment> all;
  for (int n = 1; n <= count; ++n) all.push_back({.number = n, .label = "S" + std::to_string(n)});
  return all;
}

// Returns true near a position outside all balls.
bool isNone(glm::dvec3 p) { return glm::length(p - 17.0) < 2; }

}  // namespace

void TestSegmentImport::whatWasExportedComesBack_data() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"a.seg.nrrd", "a.nii.gz", "a.mha"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

void TestSegmentImport::whatWasExportedComesBack() {
  QFETCH(QString, name);
  ImportWindow w;
  const Workspace empty = w.workspace();
  QVERIFY(w.makeBoth());
  w.session().change(QStringLiteral("test"), withSegmentChanged(w.workspace(), w.series(), 1, [](Segment& s) {
                       s.label =
                           "Knochen, gr\xc3\xb6\xc3\x9f"
                           "er";
                       s.colour = glm::u8vec3(1, 200, 30);
                       s.category = {"85756007", "SCT", "Tissue"};
                       s.type = {"272673000", "SCT", "Bone"};
                     }));
  const SegmentMap before = *w.map();
  QVERIFY(w.exportTo(w.at(qPrintable(name))));
  QVERIFY(w.removeAll());
  QVERIFY(w.workspace().segmentMaps == empty.segmentMaps);
  const Workspace removed = w.workspace();
  const int steps = w.steps();
  QVERIFY(w.import(w.at(qPrintable(name))));
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(w.count(), std::size_t(2));
  QVERIFY(*w.map()->labels == *before.labels);
  for (std::size_t n = 0; n < 2; ++n) {
    const Segment &a = before.segments[n], &b = w.segment(n);
    QVERIFY(a.number == b.number && a.label == b.label && a.colour == b.colour);
    if (name.endsWith(QStringLiteral(".seg.nrrd"))) QVERIFY(a.category == b.category && a.type == b.type);
  }
  QCOMPARE(w.current().number, 1);
  QVERIFY2(w.told().isEmpty(), qPrintable(w.told()));
  w.undo();
  QVERIFY(w.workspace() == removed);
}

void TestSegmentImport::namesAndNumbersThatAreTakenBecomeOthers() {
  ImportWindow w;
  QVERIFY(w.make(400, 600));
  const std::string name = w.segment(0).label;
  const auto colour = w.segment(0).colour;
  const std::vector<Segment> twins{{.number = 1, .label = name, .colour = colour},
                                   {.number = 7, .label = "Other", .colour = glm::u8vec3(1, 2, 3)}};
  const QString file = w.file("a.seg.nrrd", twins, [](glm::dvec3 p) {
    return isShell(p) ? 1 : isSmall(p) ? 7 : 0;
  });
  QVERIFY(w.import(file));
  QCOMPARE(w.count(), std::size_t(3));
  QCOMPARE(w.segment(1).label, name + " (2)");
  QVERIFY(w.segment(0).number == 1 && w.segment(1).number == 2 && w.segment(2).number == 7);
  QVERIFY(w.segment(0).colour == colour && w.segment(1).colour && w.segment(1).colour != colour);
  QVERIFY(w.segment(2).colour == glm::u8vec3(1, 2, 3));
  QCOMPARE(w.voxels(2), voxelsWhere(isShell));
  QCOMPARE(w.voxels(7), voxelsWhere(isSmall));
  QCOMPARE(w.voxels(1), voxelsWhere(isCore));
}

// The core is a segment. One layer of the file holds everything within 10 mm. Another holds the core again,
// and a part that touches nothing.
void TestSegmentImport::whatOverlapsGoesToAFurtherMap() {
  ImportWindow w;
  QVERIFY(w.make(400, 600));
  const SegmentMap first = *w.map();
  const Workspace before = w.workspace();
  const auto isBall = [](glm::dvec3 p) { return glm::length(p + 5.0) < 10; };
  const std::vector<Segmented> layers{
      {{{.number = 1, .label = "Ball"}}, w.labelsBy([&](glm::dvec3 p) { return isBall(p) ? 1 : 0; })},
      {{{.number = 1, .label = "Core"}, {.number = 2, .label = "Small"}}, w.labelsBy([](glm::dvec3 p) {
         return isCore(p) ? 1 : isSmall(p) ? 2 : 0;
       })}};
  QVERIFY(writeSegNrrd(layers, w.at("a.seg.nrrd").toStdString()));
  QVERIFY(w.import(w.at("a.seg.nrrd")));
  const auto voxels = [&](int map, const char* name) {
    const SegmentMap* of = segmentMapOf(w.workspace(), w.series(), map);
    const auto found = std::ranges::find(of->segments, std::string(name), &Segment::label);
    return found == of->segments.end() ? -1 : maskOf(*of->labels, std::uint8_t(found->number)).count();
  };
  QCOMPARE(segmentMapsOf(w.workspace(), w.series()).size(), std::size_t(3));
  QCOMPARE(voxels(0, first.segments[0].label.c_str()), voxelsWhere(isCore));
  QCOMPARE(voxels(0, "Small"), voxelsWhere(isSmall));
  QCOMPARE(voxels(1, "Ball"), voxelsWhere(isBall));
  QCOMPARE(voxels(2, "Core"), voxelsWhere(isCore));
  for (const char* says :
       {"Map 2 holds what overlaps other segments: Ball", "Map 3 holds what overlaps other segments: Core"})
    QVERIFY2(w.told().contains(QLatin1String(says)), qPrintable(w.told()));
  w.undo();
  QVERIFY(w.workspace() == before);
}

void TestSegmentImport::anotherGridIsToldWithFigures() {
  ImportWindow w;
  VoxelGeometry grid = w.session().series()->volume->geometry();
  grid.patientFromVoxelStep *= 2.0;  // 8 mm^3, from -19.5 to 58.5
  DenseLabels dense{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()), 1)};
  QVERIFY(writeSegNrrd(LabelMap(dense), manySegments(1), w.at("a.seg.nrrd").toStdString()));
  QVERIFY(w.import(w.at("a.seg.nrrd")));
  QCOMPARE(w.voxels(1), std::int64_t(40 * 40 * 40));
  QVERIFY2(w.told().contains(QStringLiteral("512 ml became 64 ml")), qPrintable(w.told()));
  QVERIFY2(w.told().contains(QStringLiteral("448 ml of the segments lie outside")), qPrintable(w.told()));
}

void TestSegmentImport::filesThatAreNoneChangeNothing_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QString>("says");
  QTest::newRow("a text") << QStringLiteral("a.txt") << QStringLiteral("a.txt holds no segments");
  QTest::newRow("cut off") << QStringLiteral("cut.seg.nrrd") << QStringLiteral("cut.seg.nrrd");
  QTest::newRow("elsewhere") << QStringLiteral("far.seg.nrrd")
                             << QStringLiteral("All of its segments lie outside the series");
}

void TestSegmentImport::filesThatAreNoneChangeNothing() {
  QFETCH(QString, name);
  QFETCH(QString, says);
  ImportWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.exportTo(w.at("cut.seg.nrrd")));
  QVERIFY(QFile::resize(w.at("cut.seg.nrrd"), QFileInfo(w.at("cut.seg.nrrd")).size() - 20));
  QFile text(w.at("a.txt"));
  QVERIFY(text.open(QIODevice::WriteOnly) && text.write("Not a segment.") > 0);
  text.close();
  DenseLabels far{w.session().series()->volume->geometry(), std::vector<std::uint8_t>(40 * 40 * 40, 1)};
  far.geometry.origin += 1000.0;
  QVERIFY(writeSegNrrd(LabelMap(far), manySegments(1), w.at("far.seg.nrrd").toStdString()));
  const Workspace before = w.workspace();
  const int steps = w.steps();
  QVERIFY(w.import(w.at(qPrintable(name))));
  QVERIFY2(w.told().contains(says), qPrintable(w.told()));
  QVERIFY(w.workspace() == before && w.steps() == steps);
}

void TestSegmentImport::moreThan255GoToAFurtherMap() {
  ImportWindow w;
  QVERIFY(w.makeBoth());
  const Workspace before = w.workspace();
  const auto file = [&](const char* name, int count) {
    return w.file(name, manySegments(count), [](glm::dvec3 p) { return isNone(p) ? 1 : 0; });
  };
  QVERIFY(w.import(file("fit.seg.nrrd", 253)));
  QCOMPARE(w.count(), std::size_t(255));
  w.undo();
  QVERIFY(w.workspace() == before);
  QVERIFY(w.import(file("many.seg.nrrd", 254)));
  const std::vector<const SegmentMap*> maps = segmentMapsOf(w.workspace(), w.series());
  QVERIFY(maps.size() == 2 && maps[0]->segments.size() == 255 && maps[1]->segments.size() == 1);
}

// The import uses the result of the previous job. The core first grows into the place of the file's segment.
void TestSegmentImport::itWaitsForWhatIsBeingDone() {
  ImportWindow w;
  QVERIFY(w.makeBoth() && w.choose(1));
  const auto isAround = [](glm::dvec3 p) { return !isCore(p) && glm::length(p + 5.0) < 5; };
  const QString file =
      w.file("a.seg.nrrd", manySegments(1), [&](glm::dvec3 p) { return isAround(p) ? 1 : 0; });
  w.click("segmentChange");
  const int steps = w.steps();
  w.click("segmentStep-grow");
  w.startImport(file);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 2);
  QCOMPARE(w.map()->number, 1);
  QCOMPARE(w.voxels(1), voxelsWhere(isAround));
  const LabelMap& first = *segmentMapOf(w.workspace(), w.series(), 0)->labels;
  QVERIFY(maskOf(first, 2).count() > voxelsWhere(isCore));
}

void TestSegmentImport::itCanBeGivenUpAtAnyMoment() {
  ImportWindow w;
  QVERIFY(w.makeBoth());
  const QString file = w.file("a.seg.nrrd", manySegments(3), [](glm::dvec3) { return 1; });
  const Workspace before = w.workspace();
  const int steps = w.steps();
  for (int ms = 0; ms < 20; ++ms) {
    w.startImport(file);
    QThread::msleep(static_cast<unsigned long>(ms));  // the job continues, but the window receives no event
    QCOMPARE(w.window.jobs().rows().size(), std::size_t(1));
    w.window.jobs().cancel(w.window.jobs().rows().front().id);
    QVERIFY(w.idle());
    QVERIFY(w.workspace() == before && w.steps() == steps);
  }
  w.startImport(file);
  w.session().close({w.series()});
  QVERIFY(w.idle());
  QVERIFY(w.workspace().segmentMaps.empty());
}

void TestSegmentImport::withoutASeriesThereIsNothingToAddTo() {
  Journey w;
  const auto* action = w.child<QAction>("importSegments");
  QVERIFY(!action->isEnabled() && action->toolTip().contains(QStringLiteral("Open a series")));
}

VOLUMEN_TEST(TestSegmentImport);
#include "tst_segment_import.moc"
