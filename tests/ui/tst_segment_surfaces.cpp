// Guards the 3D surfaces of segments. A job makes them only if voxels or masks changed. They are kept while
// they may be drawn, and equal those of the program.
#include <functional>

#include "tests/ui/surface_session.h"
#include "tests/unit/suite.h"
#include "ui/workspace/series_segments.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns a mask that cuts away everything to the patient's left of `x`.
Mask cutAt(double x) {
  auto lasso = std::make_shared<Lasso>();
  lasso->down = {0, 0, 1};
  lasso->points = {{x, -30}, {30, -30}, {30, 30}, {x, 30}};
  return {false, {lasso}};
}

}  // namespace

class TestSegmentSurfaces : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyAreDrawnOnceTheyAreMade();
  void looksNeedNoJob();
  void onlyChangedVoxelsDo();
  void whatIsUndoneMeanwhileIsNotMade();
  void masksDoAsForTheProgram();
  void aSeriesThatIsOpenedAgainMayHaveOtherSlices();
  void whatIsNotInAViewIsDropped();
};

void TestSegmentSurfaces::theyAreDrawnOnceTheyAreMade() {
  SurfaceSession s;
  QVERIFY(!s.jobs.rows().empty() && s.drawn().empty());
  QVERIFY(s.idle());
  QCOMPARE(s.drawn().size(), std::size_t(2));
  QVERIFY(s.drawn()[0].field == s.field(1) && s.drawn()[1].field == s.field(2));
  QVERIFY2(s.session.sceneOf(sceneViewId).segments.empty(), "they are in no workspace");
  // A segment without voxels shows nothing.
  s.change(withNewSegment(s.session.workspace(), s.key, s.series->volume->geometry(), {}));
  QVERIFY(s.idle());
  QCOMPARE(s.drawn().size(), std::size_t(3));
  QCOMPARE(shownSegments(s.scenes.scene(sceneViewId)).size(), std::size_t(2));
}

void TestSegmentSurfaces::looksNeedNoJob() {
  SurfaceSession s;
  QVERIFY(s.idle());
  const auto one = s.field(1);
  const auto edit = [&](const std::function<void(Segment&)>& change) {
    s.change(withSegmentChanged(s.session.workspace(), s.key, 1, change));
    return s.jobs.rows().empty();
  };
  QVERIFY(edit([](Segment& segment) { segment.visible = false; }));
  QCOMPARE(s.drawn().size(), std::size_t(1));
  s.undo();
  QVERIFY(s.jobs.rows().empty() && s.drawn()[0].field == one);
  QVERIFY(edit([](Segment& segment) {
    segment.colour = glm::u8vec3(255, 0, 51);
    segment.opacity = 0.5;
  }));
  QVERIFY(s.drawn()[0] == (SegmentSurface{one, {1, 0, 0.2}, 0.5}));
  QVERIFY(edit([](Segment& segment) { segment.opacity = 0; }));
  QCOMPARE(s.drawn().size(), std::size_t(1));
  s.change(withSegmentsIn3d(s.session.workspace(), s.key, false));
  QVERIFY(s.jobs.rows().empty() && s.drawn().empty());
  s.undo();
  QCOMPARE(s.drawn().size(), std::size_t(1));
}

void TestSegmentSurfaces::onlyChangedVoxelsDo() {
  SurfaceSession s;
  QVERIFY(s.idle());
  const auto one = s.field(1), two = s.field(2);
  s.addVoxel();
  QVERIFY2(s.drawn()[0].field == one, "the one before, until it is made");
  QVERIFY(s.idle());
  QVERIFY(s.field(1)->values.size() > one->values.size() && s.field(2) == two);
  s.undo();
  QVERIFY(s.idle());
  QVERIFY(s.field(1)->values == one->values && s.field(2) == two);
}

// Undoes at once, as Esc does after a stroke.
void TestSegmentSurfaces::whatIsUndoneMeanwhileIsNotMade() {
  SurfaceSession s;
  QVERIFY(s.idle());
  const auto one = s.field(1);
  s.addVoxel();
  QVERIFY(!s.jobs.rows().empty());
  s.undo();
  QVERIFY(s.jobs.rows().empty());
  QTest::qWait(100);
  QVERIFY(s.field(1) == one);
  s.addVoxel();
  QVERIFY(s.idle());
  QVERIFY(s.field(1) && s.field(1) != one);
}

void TestSegmentSurfaces::masksDoAsForTheProgram() {
  SurfaceSession s;
  QVERIFY(s.idle());
  const auto one = s.field(1);
  const Mask mask = cutAt(5);
  QVERIFY(s.cut(mask) && s.idle());
  QVERIFY(s.field(1)->values.size() < one->values.size());
  const std::vector<SegmentSurface> drawn = s.drawn();
  const auto again = surfacesOf({&s.map(), 1}, *s.series->volume, mask, mostSurfaceBytes());
  QCOMPARE(again.size(), drawn.size());
  for (std::size_t n = 0; n < drawn.size(); ++n)
    QVERIFY((*again[n].second)->box == drawn[n].field->box &&
            (*again[n].second)->values == drawn[n].field->values);
  s.undo();
  QVERIFY(s.idle());
  QVERIFY(s.field(1)->values == one->values);
}

// The masked volume of the new slices is computed again.
void TestSegmentSurfaces::aSeriesThatIsOpenedAgainMayHaveOtherSlices() {
  SurfaceSession s;
  QVERIFY(s.idle());
  const Mask mask = cutAt(5);
  QVERIFY(s.cut(mask) && s.idle());
  s.session.close({s.key});
  auto longer = std::make_shared<LoadedSeries>(*s.series);
  longer->volume = volumeOf<std::int16_t>({40, 40, 50}, glm::dmat3(1), [](glm::dvec3) { return 1000.0; });
  longer->series.acquired = longer->volume->geometry();
  s.series = longer;
  s.session.show(longer);
  s.add({800, 1200});
  QVERIFY(s.cut(mask) && s.idle());
  const std::vector<SegmentSurface> drawn = s.drawn();
  const auto again = surfacesOf({&s.map(), 1}, *longer->volume, mask, mostSurfaceBytes());
  QCOMPARE(drawn.size(), std::size_t(1));
  QCOMPARE(again.size(), drawn.size());
  QVERIFY(drawn[0].field->box == (*again[0].second)->box &&
          drawn[0].field->values == (*again[0].second)->values);
}

void TestSegmentSurfaces::whatIsNotInAViewIsDropped() {
  SurfaceSession s;
  QVERIFY(s.idle());
  s.session.setFocus(axialViewId);
  s.change(withLayout(s.session.workspace(), Layout::one));
  QVERIFY(s.scenes.surfaces().entries().empty() && s.jobs.rows().empty());
  s.undo();
  QVERIFY(s.idle());
  QCOMPARE(s.drawn().size(), std::size_t(2));
  s.change(withSegmentMap(s.session.workspace(), withoutSegment(s.map(), 1)));
  QVERIFY(s.idle());
  QVERIFY(!s.field(1) && s.field(2));
  s.session.close({s.key});
  QVERIFY(s.idle());
  QVERIFY(s.scenes.surfaces().entries().empty() && s.drawn().empty());
}

VOLUMEN_TEST(TestSegmentSurfaces);
#include "tst_segment_surfaces.moc"
