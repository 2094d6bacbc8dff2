// Guards design.md 8: a series or object found elsewhere replaces the missing one, and all references follow.
#include <nlohmann/json.hpp>

#include "tests/unit/suite.h"
#include "tests/unit/workspace/random_workspace.h"
#include "ui/workspace/moved.h"
#include "ui/workspace/series_segments.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using volumen::tests::randomWorkspace;

class TestMoved : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void allThatNamesASeriesFollowsIt();
  void itsSegmentsJoinThoseThatAreThere();
  void allThatNamesAnObjectFollowsIt();
  void objectsAreNamedBesideTheSession();
  void oldSessionsFindTheirObjects();
};

namespace {

Series elsewhere(const Series& series) {
  Series moved = series;
  moved.path = "/moved" + series.path;
  return moved;
}

}  // namespace

// Compares with opening a session whose series have all moved.
void TestMoved::allThatNamesASeriesFollowsIt() {
  int missing = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Workspace w = randomWorkspace(seed);
    const auto opened = sessionFromJson(*sessionToJson(w, "/data"), [&](const SavedSeries& saved) {
      return std::make_shared<const Series>(elsewhere(*w.series.at(keyOf(saved.series)).series));
    });
    QVERIFY(opened);
    Workspace moved = w;
    for (const auto& [key, state] : w.series) {
      missing += state.missing.has_value();
      moved = withSeriesMoved(std::move(moved), key, elsewhere(*state.series));
    }
    QVERIFY2(moved == opened->workspace, qPrintable(QStringLiteral("seed %1").arg(seed)));
  }
  QVERIFY(missing > 20);
}

// The series was meanwhile opened from another path and segmented.
void TestMoved::itsSegmentsJoinThoseThatAreThere() {
  Series missing, there;
  missing.path = "/data/ct", there.path = "/moved/ct";
  VoxelGeometry grid;
  grid.size = {4, 4, 4};
  Workspace w;
  for (const Series& series : {missing, there}) {
    const SeriesKey key = keyOf(series);
    w.series.editOrAdd(key).series = std::make_shared<const Series>(series);
    w = withNewSegment(withNewSegment(std::move(w), key, grid, {}), key, grid, {}, 1);
  }
  w = withSegmentsIn3d(std::move(w), keyOf(missing), false);
  const Workspace moved = withSeriesMoved(w, keyOf(missing), there);
  QCOMPARE(moved.segmentMaps.size(), std::size_t(4));
  for (int number = 0; number < 4; ++number) {
    const SegmentMap* map = segmentMapOf(moved, keyOf(there), number);
    QVERIFY(map && map->in3d);
  }
  const auto text = sessionToJson(moved, "/data");
  QVERIFY(text);
  const auto back = sessionFromJson(*text, {});
  QVERIFY2(back, back ? "" : back.message().c_str());
}

void TestMoved::allThatNamesAnObjectFollowsIt() {
  int used = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Workspace w = randomWorkspace(seed);
    Workspace moved = w;
    for (const UsedObject& object : derivedObjectsOf(w)) {
      moved = withObjectMoved(std::move(moved), object.key, {"/moved" + object.key.path, object.key.id});
      ++used;
    }
    for (const UsedObject& object : derivedObjectsOf(moved)) QVERIFY(object.key.path.starts_with("/moved"));
    QCOMPARE(derivedObjectsOf(moved).size(), derivedObjectsOf(w).size());
    for (const UsedObject& object : derivedObjectsOf(w))
      moved = withObjectMoved(std::move(moved), {"/moved" + object.key.path, object.key.id}, object.key);
    QVERIFY2(moved == w, qPrintable(QStringLiteral("seed %1").arg(seed)));
  }
  QVERIFY(used > 100);
}

namespace {

// Two views use one presentation state, and a segmentation is over all of them.
Workspace withObjects() {
  Series series;
  series.path = "/data/ct", series.id = "1.2.3";
  Workspace w = withSeries({}, sceneViewId, series, {});
  for (const ViewId id : {axialViewId, coronalViewId})
    w.editView(id).flats.editOrAdd(keyOf(series)).presentation = {"/data/more/pr.dcm", "1.2.4"};
  w.regions.editOrAdd({"/other/seg.dcm", "1.2.5#1"}).kind = DerivedKind::segmentation;
  return w;
}

}  // namespace

void TestMoved::objectsAreNamedBesideTheSession() {
  const std::string text = *sessionToJson(withObjects(), "/data");
  std::vector<SavedObject> asked;
  const auto back = sessionFromJson(text, {}, [&](const SavedObject& saved) -> std::optional<DerivedKey> {
    asked.push_back(saved);
    if (saved.kind == DerivedKind::segmentation) return {};
    return DerivedKey{"/new/" + saved.relativePath, saved.key.id};
  });
  QVERIFY(back);
  QCOMPARE(asked.size(), std::size_t(2));
  QCOMPARE(asked[0].relativePath, std::string("more/pr.dcm"));
  QCOMPARE(asked[1].relativePath, std::string("../other/seg.dcm"));
  for (const ViewId id : {axialViewId, coronalViewId})
    QCOMPARE(flatLookOf(back->workspace.view(id)).presentation.path, std::string("/new/more/pr.dcm"));
  QVERIFY2(back->workspace.regions == withObjects().regions, "what is missing stays as it was");
}

// Old sessions name each object only where it is used.
void TestMoved::oldSessionsFindTheirObjects() {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(*sessionToJson(withObjects(), "/data"));
  QVERIFY(json.erase("references") == 1);
  int asked = 0;
  const auto back = sessionFromJson(json.dump(), {}, [&](const SavedObject& saved) {
    ++asked;
    return std::optional(saved.key);
  });
  QVERIFY(back);
  QCOMPARE(asked, 2);
  QVERIFY(back->workspace.views == withObjects().views);
}

VOLUMEN_TEST(TestMoved);
#include "tst_moved.moc"
