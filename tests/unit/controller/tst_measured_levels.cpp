// Guards design.md 6 (targets that choose a level).
#include "tests/fixtures/measured_levels.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

const PictureLevel coarseLevel{Quality::draft, 4}, draftLevel{Quality::draft, 1},
    standardLevel{Quality::standard, 1}, highLevel{Quality::high, 1};

}  // namespace

class TestMeasuredLevels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void goalsPickALevel_data();
  void goalsPickALevel();
  void beatenLevelsAreNotOnTheFront();
};

void TestMeasuredLevels::goalsPickALevel_data() {
  QTest::addColumn<QualityGoal>("goal");
  QTest::addColumn<std::vector<MeasuredLevel>>("levels");
  QTest::addColumn<int>("quality");  // -1: not known yet
  using Levels = std::vector<MeasuredLevel>;
  const Levels all{measured(coarseLevel, 5, 20), measured(draftLevel, 40, 8), measured(standardLevel, 90, 3),
                   measured(highLevel, 200, 0.6)};
  const Levels half{measured(coarseLevel, 5, 20), measured(draftLevel, 40, 8), measured(standardLevel, {}, 0),
                    measured(highLevel, {}, 0)};
  const Levels broken{measured(coarseLevel, 5, 20), measured(draftLevel, {}, 0, "no memory"),
                      measured(standardLevel, 90, 3), measured(highLevel, {}, 0, "no memory")};
  const auto row = [](const char* name, Aim aim, double target, const Levels& levels, int quality) {
    QualityGoal goal{.aim = aim, .level = highLevel};
    goal.frameMs = goal.errorOf255 = target;
    QTest::newRow(name) << goal << levels << quality;
  };
  row("the level itself, nothing measured", Aim::level, 0, {}, int(Quality::high));
  row("time: the most accurate within it", Aim::time, 100, all, int(Quality::standard));
  row("time: exactly met counts", Aim::time, 200, all, int(Quality::high));
  row("time: too short for any, so the fastest", Aim::time, 1, all, int(Quality::draft));
  row("time: not told before the next level is timed", Aim::time, 100, half, -1);
  row("time: told early where a level is too slow", Aim::time, 30, half, int(Quality::draft));
  row("error: the fastest within it", Aim::error, 3, all, int(Quality::standard));
  row("error: too small for any, so the most accurate", Aim::error, 0.1, all, int(Quality::high));
  row("error: not told before a level is good enough", Aim::error, 3, half, -1);
  row("error: told early where a level is good enough", Aim::error, 9, half, int(Quality::draft));
  row("levels that cannot be drawn are passed over", Aim::error, 0.1, broken, int(Quality::standard));
  row("nothing measured", Aim::time, 100, {}, -1);
}

void TestMeasuredLevels::goalsPickALevel() {
  QFETCH(QualityGoal, goal);
  QFETCH(std::vector<MeasuredLevel>, levels);
  QFETCH(int, quality);
  const auto level = levelFor(goal, levels);
  QCOMPARE(level ? int(level->quality) : -1, quality);
}

void TestMeasuredLevels::beatenLevelsAreNotOnTheFront() {
  std::vector<MeasuredLevel> levels{measured(coarseLevel, 50, 20), measured(draftLevel, 40, 8),
                                    measured(standardLevel, {}, 0), measured(highLevel, 200, 0.6)};
  markFront(levels);
  QVERIFY2(!levels[0].front, "the draft is faster and nearer");
  QVERIFY(levels[1].front && levels[3].front);
  QVERIFY2(!levels[2].front, "not measured yet");
}

VOLUMEN_TEST(TestMeasuredLevels);
#include "tst_measured_levels.moc"
