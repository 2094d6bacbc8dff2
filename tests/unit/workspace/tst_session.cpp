// Guards design.md 1 (state in one session object) and design.md 8 (undo for everything).
#include <QSignalSpy>

#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/workspace/session.h"

using namespace volumen;

namespace {

// One edit of the light's intensity: its merge key, and whether a gesture ended before it.
struct Step {
  double intensity;
  const char* key;
  bool newGesture = false;
};

void apply(Session& session, const Step& step) {
  if (step.newGesture) session.endGesture();
  session.edit(
      QStringLiteral("Light"), [&](Scene& s) { s.lights[0].intensity = step.intensity; },
      QString::fromLatin1(step.key));
}

// A session that shows a series.
struct ShownBall : Session {
  ShownBall() { show(tests::ballSeries()); }
};

}  // namespace

class TestSession : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void editsBecomeUndoSteps_data();
  void editsBecomeUndoSteps();
  void undoAndRedoRestoreTheScene();
  void everyChangeIsToldOnceWithBeforeAndAfter();
  void goalsAreStepsBesideTheScene();
  void anotherSeriesIsAStep();
};

void TestSession::editsBecomeUndoSteps_data() {
  QTest::addColumn<QList<double>>("intensities");
  QTest::addColumn<QStringList>("keys");
  QTest::addColumn<int>("gestureEndsBefore");
  QTest::addColumn<int>("steps");
  using Values = QList<double>;
  const QString a = QStringLiteral("a"), b = QStringLiteral("b"), none;
  QTest::newRow("a drag is one step") << Values{2, 3, 4} << QStringList{a, a, a} << -1 << 1;
  QTest::newRow("two drags are two steps") << Values{2, 3, 4} << QStringList{a, a, a} << 2 << 2;
  QTest::newRow("two things are two steps") << Values{2, 3} << QStringList{a, b} << -1 << 2;
  QTest::newRow("without a key nothing merges") << Values{2, 3} << QStringList{none, none} << -1 << 2;
  QTest::newRow("an edit of nothing is no step") << Values{1} << QStringList{none} << -1 << 0;
  QTest::newRow("a drag back to the start is no step") << Values{2, 3, 1} << QStringList{a, a, a} << -1 << 0;
  QTest::newRow("back to the start and on is one step") << Values{2, 1, 5} << QStringList{a, a, a} << -1 << 1;
}

void TestSession::editsBecomeUndoSteps() {
  QFETCH(QList<double>, intensities);
  QFETCH(QStringList, keys);
  QFETCH(int, gestureEndsBefore);
  QFETCH(int, steps);
  ShownBall session;
  const Scene start = session.scene();
  for (int n = 0; n < intensities.size(); ++n)
    apply(session, {intensities[n], keys[n].toLatin1().constData(), n == gestureEndsBefore});
  QCOMPARE(session.scene().lights[0].intensity, intensities.last());
  QCOMPARE(session.undoStack().count(), steps);
  while (session.undoStack().canUndo()) session.undoStack().undo();
  QVERIFY(session.scene() == start);
}

void TestSession::undoAndRedoRestoreTheScene() {
  ShownBall session;
  std::vector<Scene> seen{session.scene()};
  for (double intensity : {2.0, 5.0, 0.5}) {
    apply(session, {intensity, ""});
    seen.push_back(session.scene());
  }
  for (int n = 2; n >= 0; --n) {
    session.undoStack().undo();
    QVERIFY(session.scene() == seen[n]);
  }
  for (int n = 1; n <= 3; ++n) {
    session.undoStack().redo();
    QVERIFY(session.scene() == seen[n]);
  }
}

void TestSession::everyChangeIsToldOnceWithBeforeAndAfter() {
  ShownBall session;
  std::vector<std::pair<double, double>> told;
  connect(&session, &Session::changed, this, [&](const SessionState& before, const SessionState& after) {
    told.emplace_back(before.scene.lights[0].intensity, after.scene.lights[0].intensity);
  });
  apply(session, {2, "a"});
  apply(session, {3, "a"});
  session.undoStack().undo();
  const std::vector<std::pair<double, double>> expected{{1, 2}, {2, 3}, {3, 1}};
  QVERIFY(told == expected);
}

void TestSession::goalsAreStepsBesideTheScene() {
  ShownBall session;
  apply(session, {2, ""});
  QualityGoal goal;
  goal.aim = Aim::time;
  session.setGoal(QStringLiteral("Time"), goal, QStringLiteral("t"));
  goal.frameMs = 80;
  session.setGoal(QStringLiteral("Time"), goal, QStringLiteral("t"));
  session.setGoal(QStringLiteral("Time"), goal);
  QCOMPARE(session.undoStack().count(), 2);
  QCOMPARE(session.scene().lights[0].intensity, 2.0);
  session.undoStack().undo();
  QVERIFY(session.goal() == QualityGoal{});
  QCOMPARE(session.scene().lights[0].intensity, 2.0);
  session.undoStack().redo();
  session.show(tests::ballSeries());
  QVERIFY2(session.goal() == goal, "asked for of every series");
}

void TestSession::anotherSeriesIsAStep() {
  ShownBall session;
  apply(session, {2, ""});
  auto series = std::make_shared<LoadedSeries>(*tests::ballSeries());
  series->firstScene.shading.lit = false;
  session.show(series);
  QCOMPARE(session.series().get(), series.get());
  QVERIFY(!session.scene().shading.lit);
  session.undoStack().undo();
  QVERIFY(session.scene().shading.lit);
  QCOMPARE(session.scene().lights[0].intensity, 2.0);
}

VOLUMEN_TEST(TestSession);
#include "tst_session.moc"
