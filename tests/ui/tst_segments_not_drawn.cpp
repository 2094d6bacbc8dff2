// Guards that segments missing in 3D are reported with the reason. Cancelled ones are retried after a change,
// large ones once there is memory.
#include <QSignalSpy>
#include <functional>

#include "tests/ui/surface_session.h"
#include "tests/unit/suite.h"
#include "ui/workspace/series_segments.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

std::size_t bytesOfRange(ValueRange range) {
  return occupancyBytes(voxelsInRange(*hollowBalls()->volume, range), surfaceSigma);
}

}  // namespace

class TestSegmentsNotDrawn : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aJobThatIsCancelledIsNotBegunAgain();
  void whatWasCancelledIsSaidAndTriedAgain_data();
  void whatWasCancelledIsSaidAndTriedAgain();
  void whatWasCancelledOfAMapIsTriedAgainWhereAnotherChanges();
  void hiddenOnesMakeRoom();
  void whatTakesTooMuchMemoryIsNotDrawn_data();
  void whatTakesTooMuchMemoryIsNotDrawn();
};

void TestSegmentsNotDrawn::aJobThatIsCancelledIsNotBegunAgain() {
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

void TestSegmentsNotDrawn::whatWasCancelledIsSaidAndTriedAgain_data() {
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

// A look changed during the job is no reason to retry.
void TestSegmentsNotDrawn::whatWasCancelledIsSaidAndTriedAgain() {
  QFETCH(std::function<void(SurfaceSession&)>, act);
  SurfaceSession s;
  QVERIFY(s.idle());
  QVERIFY(s.scenes.segmentsNotDrawn(sceneViewId).empty());
  const QSignalSpy cancelled(&s.scenes, &DrawnScenes::cancelled);
  s.addVoxel();
  s.change(withSegmentChanged(s.session.workspace(), s.key, 1, [](Segment& one) { one.opacity = 0.5; }));
  s.jobs.cancel(s.jobs.rows().front().id);
  QCOMPARE(cancelled.size(), 1);
  QVERIFY(s.jobs.rows().empty() && s.drawn().empty());
  const QString says = notDrawnText(s.scenes.segmentsNotDrawn(sceneViewId));
  QVERIFY2(says.startsWith(QStringLiteral("Not drawn in 3D: ")) && says.contains(QStringLiteral("cancelled")),
           qPrintable(says));
  for (const Segment& segment : s.map().segments)
    QVERIFY2(says.contains(QString::fromStdString(segment.label)), qPrintable(says));
  QCOMPARE(says.count(QLatin1Char('\n')), 0);
  act(s);
  QVERIFY(!s.jobs.rows().empty() && s.idle());
  QCOMPARE(s.drawn().size(), std::size_t(2));
  QVERIFY(s.scenes.segmentsNotDrawn(sceneViewId).empty());
}

void TestSegmentsNotDrawn::whatWasCancelledOfAMapIsTriedAgainWhereAnotherChanges() {
  SurfaceSession s;
  QVERIFY(s.idle());
  const Workspace with = withNewSegment(s.session.workspace(), s.key, s.series->volume->geometry(), {}, 1);
  s.change(withSegmentMap(
      with, withMask(*segmentMapOf(with, s.key, 1), 1, voxelsInRange(*s.series->volume, {400, 1200}))));
  QCOMPARE(s.jobs.rows().size(), std::size_t(1));
  s.jobs.cancel(s.jobs.rows().front().id);
  QVERIFY(s.idle());
  QCOMPARE(s.scenes.segmentsNotDrawn(sceneViewId).size(), std::size_t(1));
  QCOMPARE(s.map().number, 0);
  s.change(withSegmentChanged(s.session.workspace(), s.key, 1, [](Segment& one) { one.opacity = 0.5; }));
  QVERIFY(s.idle());
  QVERIFY(s.scenes.segmentsNotDrawn(sceneViewId).empty());
  QCOMPARE(s.drawn().size(), std::size_t(3));
}

// Hidden ones are released only when memory is needed: TestSegmentSurfaces::looksNeedNoJob().
void TestSegmentsNotDrawn::hiddenOnesMakeRoom() {
  SurfaceSession s(bytesOfRange({800, 1200}) + bytesOfRange({400, 600}) - 1);
  const QSignalSpy told(&s.scenes, &DrawnScenes::failed);
  QVERIFY(s.idle());
  QVERIFY(s.field(1) && !s.field(2));
  QCOMPARE(told.size(), 1);
  s.change(withSegmentChanged(s.session.workspace(), s.key, 1, [](Segment& one) { one.visible = false; }));
  QVERIFY(s.idle());
  QVERIFY(!s.field(1) && s.field(2) && s.scenes.segmentsNotDrawn(sceneViewId).empty());
  QCOMPARE(told.size(), 1);
  s.undo();
  QVERIFY(s.idle());
  QVERIFY2(!s.field(1) && s.field(2), "what is drawn stays");
  QCOMPARE(told.size(), 2);
  QCOMPARE(s.scenes.segmentsNotDrawn(sceneViewId).size(), std::size_t(1));
}

void TestSegmentsNotDrawn::whatTakesTooMuchMemoryIsNotDrawn_data() {
  QTest::addColumn<bool>("countsFirst");
  QTest::addColumn<bool>("countsSecond");
  QTest::addColumn<int>("more");  // bytes
  QTest::addColumn<std::vector<int>>("drawn");
  QTest::newRow("room for both") << true << true << 0 << std::vector<int>{1, 2};
  QTest::newRow("a byte too little for both") << true << true << -1 << std::vector<int>{1};
  QTest::newRow("a byte too little for the first") << true << false << -1 << std::vector<int>{2};
  QTest::newRow("for none") << false << true << -1 << std::vector<int>{};
}

// Segments are drawn in order, by the program as in the window. A segment is drawn once it is small enough.
void TestSegmentsNotDrawn::whatTakesTooMuchMemoryIsNotDrawn() {
  QFETCH(bool, countsFirst);
  QFETCH(bool, countsSecond);
  QFETCH(int, more);
  QFETCH(std::vector<int>, drawn);
  const std::size_t first = bytesOfRange({800, 1200}), second = bytesOfRange({400, 600});
  QVERIFY(second < first);
  const std::size_t room = (countsFirst ? first : 0) + (countsSecond ? second : 0) + std::size_t(more);
  SurfaceSession s(room);
  QStringList told;
  QObject::connect(&s.scenes, &DrawnScenes::failed, &s.session,
                   [&](const QString& sentence) { told << sentence; });
  QVERIFY(s.idle());
  for (const int number : {1, 2})
    QCOMPARE(s.field(number) != nullptr, std::ranges::count(drawn, number) == 1);
  if (s.field(1)) QCOMPARE(s.field(1)->values.size() * sizeof(float), first);
  const auto refused = s.scenes.segmentsNotDrawn(sceneViewId);
  QCOMPARE(refused.size(), 2 - drawn.size());
  std::size_t next = 0;
  for (const auto& [key, field] : surfacesOf({&s.map(), 1}, *s.series->volume, {}, room)) {
    QCOMPARE(field.ok(), s.field(key.number) != nullptr);
    if (!field) QCOMPARE(QString::fromStdString(field.message()), refused.at(next++).whyNot);
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
  QVERIFY(s.field(1) && s.field(2) && s.scenes.segmentsNotDrawn(sceneViewId).empty());
}

VOLUMEN_TEST(TestSegmentsNotDrawn);
#include "tst_segments_not_drawn.moc"
