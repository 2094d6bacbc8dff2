// Guards what segments are drawn by in 3D: made as a job wherever voxels or masks changed and nowhere else,
// kept while it may be drawn, and the same as for the program; what is not drawn, cancelled or too large, is
// said.
#include <QSignalSpy>
#include <functional>

#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/controller/segment_fields.h"
#include "ui/controller/segment_surface_jobs.h"
#include "viewer/segment/occupancy.h"
#include "viewer/segment/range.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A session without a window, its 3D view beside planes: the hollow ball with the small one is segment 1, the
// core segment 2.
struct SurfaceSession {
  Session session;
  Jobs jobs;
  SegmentPainter painter{session};
  SegmentSurfaceJobs surfaces;
  LoadedSeriesPtr series = hollowBalls();
  SeriesKey key = keyOf(series->series);

  explicit SurfaceSession(std::size_t mostBytes = std::size_t(1) << 30)
      : surfaces(session, painter, jobs, mostBytes) {
    session.show(series);
    session.change(QStringLiteral("test"), withLayout(session.workspace(), Layout::planes));
    add({800, 1200});
    add({400, 600});
  }

  const SegmentMap& map() { return *segmentMapOf(session.workspace(), key); }
  bool idle() {
    return QTest::qWaitFor([this] { return jobs.rows().empty(); }, longest);
  }
  void change(const Workspace& after) { session.change(QStringLiteral("test"), after); }
  void add(ValueRange range) {
    const Workspace with = withNewSegment(session.workspace(), key, series->volume->geometry(), {});
    const SegmentMap& made = *segmentMapOf(with, key);
    change(withSegmentMap(with, withMask(made, made.current, voxelsInRange(*series->volume, range))));
  }
  // One more voxel of segment 1, apart from all others.
  void addVoxel(int i = 0) {
    BitMask mask = maskOf(*map().labels, 1);
    mask.set({i, 0, 0});
    change(withSegmentMap(session.workspace(), withMask(map(), 1, mask)));
  }
  // False where the volume cannot be cut.
  bool cut(const Mask& mask) {
    const auto left = masked(*series->volume, mask);
    if (!left) return false;
    auto without = std::make_shared<LoadedSeries>(*series);
    without->volume = *left;
    session.takeMasked(mask, without);
    session.setMask(QStringLiteral("test"), key, mask);
    return true;
  }
  void undo() { session.undoStack().undo(); }
  std::vector<SegmentSurface> drawn() { return session.drawnScene(sceneViewId).segments; }
  std::shared_ptr<const OccupancyField> field(int number) {
    for (const MadeSurface& made : session.surfaces())
      if (made.number == number) return made.field;
    return nullptr;
  }
};

// What lies on the patient's left of this is cut away.
Mask cutAt(double x) {
  auto lasso = std::make_shared<Lasso>();
  lasso->down = {0, 0, 1};
  lasso->points = {{x, -30}, {30, -30}, {30, 30}, {x, 30}};
  return {false, {lasso}};
}

}  // namespace

class TestSegmentSurfaceJobs : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyAreDrawnOnceTheyAreMade();
  void looksNeedNoJob();
  void onlyChangedVoxelsDo();
  void whatIsUndoneMeanwhileIsNotMade();
  void masksDoAsForTheProgram();
  void aSeriesThatIsOpenedAgainMayHaveOtherSlices();
  void whatIsNotInAViewIsDropped();
  void aJobThatIsCancelledIsNotBegunAgain();
  void whatWasCancelledIsSaidAndTriedAgain_data();
  void whatWasCancelledIsSaidAndTriedAgain();
  void whatWasCancelledOfAMapIsTriedAgainWhereAnotherChanges();
  void hiddenOnesMakeRoom();
  void whatTakesTooMuchMemoryIsNotDrawn_data();
  void whatTakesTooMuchMemoryIsNotDrawn();
};

void TestSegmentSurfaceJobs::theyAreDrawnOnceTheyAreMade() {
  SurfaceSession s;
  QVERIFY(!s.jobs.rows().empty() && s.drawn().empty());
  QVERIFY(s.idle());
  QCOMPARE(s.drawn().size(), std::size_t(2));
  QVERIFY(s.drawn()[0].field == s.field(1) && s.drawn()[1].field == s.field(2));
  QVERIFY2(s.session.sceneOf(sceneViewId).segments.empty(), "they are in no workspace");
  // One without voxels shows nothing.
  s.change(withNewSegment(s.session.workspace(), s.key, s.series->volume->geometry(), {}));
  QVERIFY(s.idle());
  QCOMPARE(s.drawn().size(), std::size_t(3));
  QCOMPARE(shownSegments(s.session.drawnScene(sceneViewId)).size(), std::size_t(2));
}

void TestSegmentSurfaceJobs::looksNeedNoJob() {
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

void TestSegmentSurfaceJobs::onlyChangedVoxelsDo() {
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

// As Esc undoes a stroke once it has ended.
void TestSegmentSurfaceJobs::whatIsUndoneMeanwhileIsNotMade() {
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

void TestSegmentSurfaceJobs::masksDoAsForTheProgram() {
  SurfaceSession s;
  QVERIFY(s.idle());
  const auto one = s.field(1);
  const Mask mask = cutAt(5);
  QVERIFY(s.cut(mask) && s.idle());
  QVERIFY(s.field(1)->values.size() < one->values.size());
  const std::vector<SegmentSurface> drawn = s.drawn();
  const std::vector<MadeSurface> again =
      surfacesOf({&s.map(), 1}, *s.series->volume, mask, mostSurfaceBytes());
  QCOMPARE(again.size(), drawn.size());
  for (std::size_t n = 0; n < drawn.size(); ++n)
    QVERIFY(again[n].field->box == drawn[n].field->box && again[n].field->values == drawn[n].field->values);
  s.undo();
  QVERIFY(s.idle());
  QVERIFY(s.field(1)->values == one->values);
}

// What is left of it by a mask is found again.
void TestSegmentSurfaceJobs::aSeriesThatIsOpenedAgainMayHaveOtherSlices() {
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
  const std::vector<MadeSurface> again = surfacesOf({&s.map(), 1}, *longer->volume, mask, mostSurfaceBytes());
  QCOMPARE(drawn.size(), std::size_t(1));
  QCOMPARE(again.size(), drawn.size());
  QVERIFY(drawn[0].field->box == again[0].field->box && drawn[0].field->values == again[0].field->values);
}

void TestSegmentSurfaceJobs::whatIsNotInAViewIsDropped() {
  SurfaceSession s;
  QVERIFY(s.idle());
  s.session.setFocus(axialViewId);
  s.change(withLayout(s.session.workspace(), Layout::one));
  QVERIFY(s.session.surfaces().empty() && s.jobs.rows().empty());
  s.undo();
  QVERIFY(s.idle());
  QCOMPARE(s.drawn().size(), std::size_t(2));
  s.change(withSegmentMap(s.session.workspace(), withoutSegment(s.map(), 1)));
  QVERIFY(s.idle());
  QVERIFY(!s.field(1) && s.field(2));
  s.session.close({s.key});
  QVERIFY(s.idle());
  QVERIFY(s.session.surfaces().empty() && s.drawn().empty());
}

void TestSegmentSurfaceJobs::aJobThatIsCancelledIsNotBegunAgain() {
  SurfaceSession s;
  QVERIFY(s.idle());
  s.addVoxel();
  QCOMPARE(s.jobs.rows().size(), std::size_t(1));
  s.jobs.cancel(s.jobs.rows().front().id);
  QVERIFY(s.jobs.rows().empty());
  QTest::qWait(20);
  QVERIFY(s.jobs.rows().empty() && s.drawn().empty());
  s.undo();  // something changes
  QVERIFY(s.idle());
  QCOMPARE(s.drawn().size(), std::size_t(2));
}

void TestSegmentSurfaceJobs::whatWasCancelledIsSaidAndTriedAgain_data() {
  QTest::addColumn<std::function<void(SurfaceSession&)>>("act");
  const auto row = [](const char* name, const std::function<void(SurfaceSession&)>& act) {
    QTest::newRow(name) << act;
  };
  row("In 3D off and on", [](SurfaceSession& s) {
    s.change(withSegmentsIn3d(s.session.workspace(), s.key, false));
    s.change(withSegmentsIn3d(s.session.workspace(), s.key, true));
  });
  row("a voxel more", [](SurfaceSession& s) { s.addVoxel(1); });
  row("the colour of one", [](SurfaceSession& s) {
    s.change(withSegmentChanged(s.session.workspace(), s.key, 1,
                                [](Segment& segment) { segment.colour = glm::u8vec3(1, 2, 3); }));
  });
}

// A look that was changed while it was made is no reason to try again.
void TestSegmentSurfaceJobs::whatWasCancelledIsSaidAndTriedAgain() {
  QFETCH(std::function<void(SurfaceSession&)>, act);
  SurfaceSession s;
  QVERIFY(s.idle());
  QVERIFY(s.session.segmentsNotDrawn(sceneViewId).empty());
  const QSignalSpy cancelled(&s.surfaces, &SegmentSurfaceJobs::cancelled);
  s.addVoxel();
  s.change(withSegmentChanged(s.session.workspace(), s.key, 1, [](Segment& one) { one.opacity = 0.5; }));
  s.jobs.cancel(s.jobs.rows().front().id);
  QCOMPARE(cancelled.size(), 1);
  QVERIFY(s.jobs.rows().empty() && s.drawn().empty());
  const QString says = notDrawnText(s.session.segmentsNotDrawn(sceneViewId));
  QVERIFY2(says.startsWith(QStringLiteral("Not drawn in 3D: ")) && says.contains(QStringLiteral("cancelled")),
           qPrintable(says));
  for (const Segment& segment : s.map().segments)
    QVERIFY2(says.contains(QString::fromStdString(segment.label)), qPrintable(says));
  QCOMPARE(says.count(QLatin1Char('\n')), 0);
  act(s);
  QVERIFY(!s.jobs.rows().empty() && s.idle());
  QCOMPARE(s.drawn().size(), std::size_t(2));
  QVERIFY(s.session.segmentsNotDrawn(sceneViewId).empty());
}

void TestSegmentSurfaceJobs::whatWasCancelledOfAMapIsTriedAgainWhereAnotherChanges() {
  SurfaceSession s;
  QVERIFY(s.idle());
  const Workspace with = withNewSegment(s.session.workspace(), s.key, s.series->volume->geometry(), {}, 1);
  s.change(withSegmentMap(
      with, withMask(*segmentMapOf(with, s.key, 1), 1, voxelsInRange(*s.series->volume, {400, 1200}))));
  QCOMPARE(s.jobs.rows().size(), std::size_t(1));
  s.jobs.cancel(s.jobs.rows().front().id);
  QVERIFY(s.idle());
  QCOMPARE(s.session.segmentsNotDrawn(sceneViewId).size(), std::size_t(1));
  QCOMPARE(s.map().number, 0);
  s.change(withSegmentChanged(s.session.workspace(), s.key, 1, [](Segment& one) { one.opacity = 0.5; }));
  QVERIFY(s.idle());
  QVERIFY(s.session.segmentsNotDrawn(sceneViewId).empty());
  QCOMPARE(s.drawn().size(), std::size_t(3));
}

// Not before room is needed: looksNeedNoJob().
void TestSegmentSurfaceJobs::hiddenOnesMakeRoom() {
  const auto bytesOfRange = [](ValueRange range) {
    return occupancyBytes(voxelsInRange(*hollowBalls()->volume, range), surfaceSigma);
  };
  SurfaceSession s(bytesOfRange({800, 1200}) + bytesOfRange({400, 600}) - 1);
  const QSignalSpy told(&s.surfaces, &SegmentSurfaceJobs::failed);
  QVERIFY(s.idle());
  QVERIFY(s.field(1) && !s.field(2));
  QCOMPARE(told.size(), 1);
  s.change(withSegmentChanged(s.session.workspace(), s.key, 1, [](Segment& one) { one.visible = false; }));
  QVERIFY(s.idle());
  QVERIFY(!s.field(1) && s.field(2) && s.session.segmentsNotDrawn(sceneViewId).empty());
  QCOMPARE(told.size(), 1);
  s.undo();
  QVERIFY(s.idle());
  QVERIFY2(!s.field(1) && s.field(2), "what is drawn stays");
  QCOMPARE(told.size(), 2);
  QCOMPARE(s.session.segmentsNotDrawn(sceneViewId).size(), std::size_t(1));
}

void TestSegmentSurfaceJobs::whatTakesTooMuchMemoryIsNotDrawn_data() {
  QTest::addColumn<bool>("countsFirst");
  QTest::addColumn<bool>("countsSecond");
  QTest::addColumn<int>("more");  // bytes
  QTest::addColumn<std::vector<int>>("drawn");
  QTest::newRow("room for both") << true << true << 0 << std::vector<int>{1, 2};
  QTest::newRow("a byte too little for both") << true << true << -1 << std::vector<int>{1};
  QTest::newRow("a byte too little for the first") << true << false << -1 << std::vector<int>{2};
  QTest::newRow("for none") << false << true << -1 << std::vector<int>{};
}

// In their order, by the program as in the window; once one is small enough it is drawn.
void TestSegmentSurfaceJobs::whatTakesTooMuchMemoryIsNotDrawn() {
  QFETCH(bool, countsFirst);
  QFETCH(bool, countsSecond);
  QFETCH(int, more);
  QFETCH(std::vector<int>, drawn);
  const auto bytesOfRange = [](ValueRange range) {
    return occupancyBytes(voxelsInRange(*hollowBalls()->volume, range), surfaceSigma);
  };
  const std::size_t first = bytesOfRange({800, 1200}), second = bytesOfRange({400, 600});
  QVERIFY(second < first);
  const std::size_t room = (countsFirst ? first : 0) + (countsSecond ? second : 0) + std::size_t(more);
  SurfaceSession s(room);
  QStringList told;
  QObject::connect(&s.surfaces, &SegmentSurfaceJobs::failed, &s.session,
                   [&](const QString& sentence) { told << sentence; });
  QVERIFY(s.idle());
  for (const int number : {1, 2})
    QCOMPARE(s.field(number) != nullptr, std::ranges::count(drawn, number) == 1);
  if (s.field(1)) QCOMPARE(s.field(1)->values.size() * sizeof(float), first);
  const auto refused = s.session.segmentsNotDrawn(sceneViewId);
  QCOMPARE(refused.size(), 2 - drawn.size());
  std::size_t next = 0;
  for (const MadeSurface& made : surfacesOf({&s.map(), 1}, *s.series->volume, {}, room)) {
    QCOMPARE(made.field != nullptr, s.field(made.number) != nullptr);
    if (!made.field) QCOMPARE(made.whyNot, refused.at(next++).whyNot);
  }
  QCOMPARE(std::size_t(told.size()), refused.size());
  for (const SegmentNotDrawn& one : refused)
    QVERIFY2(one.whyNot.contains(QStringLiteral(" MB of memory")), qPrintable(one.whyNot));
  for (const QString& sentence : told)
    QVERIFY2(sentence.startsWith(QStringLiteral("Not drawn in 3D: ")), qPrintable(sentence));
  if (drawn != std::vector<int>{2}) return;
  s.addVoxel();
  QVERIFY(s.idle());
  QVERIFY2(!s.field(1) && told.size() == 1, "it is told once");
  BitMask voxel(s.series->volume->geometry());
  voxel.set({20, 20, 20});
  s.change(withSegmentMap(s.session.workspace(), withMask(s.map(), 1, voxel)));
  QVERIFY(s.idle());
  QVERIFY(s.field(1) && s.field(2) && s.session.segmentsNotDrawn(sceneViewId).empty());
}

VOLUMEN_TEST(TestSegmentSurfaceJobs);
#include "tst_segment_surface_jobs.moc"
