// Guards playback: the order of positions in any range, back and forth and in loops, against a reference
// model and a clock of the test. Playback never runs ahead of drawing.
#include <QSignalSpy>

#include "tests/fixtures/chance.h"
#include "tests/unit/suite.h"
#include "ui/views/cine_player.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Records the positions it was sent to.
struct Listed : Playable {
  int at = 0, length = 10;
  bool ready = true, time = false;
  std::vector<int> visited;

  Stack stack() const override { return countedStack(QStringLiteral("Place"), {at, length}); }
  SeriesKey source() const override { return {}; }
  Cine cine() const override { return {10, {}, false}; }
  void goTo(int place) override {
    at = place;
    visited.push_back(place);
  }
  bool isReady(int) const override { return ready; }
  bool keepsTime() const override { return time; }
};

// A reference model that moves one position at a time, and wraps or turns at the end. -1 means that playback
// is over.
struct Twin {
  CineRound round;
  int at;
  int way = 1;

  int next() {
    if (round.first == round.last) return round.loops ? at : -1;
    if (at == round.last && way > 0) {
      if (round.backAndForth)
        way = -1;
      else
        return round.loops ? at = round.first : -1;
    } else if (at == round.first && way < 0) {
      if (!round.loops) return -1;
      way = 1;
    }
    return at += way;
  }
};

}  // namespace

class TestCinePlayer : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theOrderIsThatOfATwin();
  void nothingRunsAheadOfDrawing();
  void clipsLeaveFramesOut();
  void anotherSpeedGoesOnFromThere();
  void itEndsWhereSomethingElseGoes();
};

void TestCinePlayer::theOrderIsThatOfATwin() {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Chance chance(seed);
    Listed what;
    what.length = 1 + chance.below(12);
    CineRound round{chance.below(what.length), 0, chance.oneIn(2), chance.oneIn(2), 0};
    round.last = round.first + chance.below(what.length - round.first);
    what.at = round.first;
    double now = 0;
    CinePlayer player(what, round, [&] { return now; });
    bool isOver = false;
    connect(&player, &CinePlayer::over, this, [&] { isOver = true; });
    Twin twin{round, round.first};
    std::vector<int> expected;
    for (int n = 0; n < 40; ++n) {
      now += 100;  // 10 per second
      player.tick();
      const int next = twin.next();
      if (next >= 0 && (expected.empty() ? next != round.first : next != expected.back()))
        expected.push_back(next);
      const auto what_was = QStringLiteral("seed %1, step %2").arg(seed).arg(n);
      QVERIFY2(what.visited == expected, qPrintable(what_was));
      const Twin after = twin;
      QVERIFY2(isOver == (Twin(after).next() < 0), qPrintable(what_was));
      if (isOver) break;
    }
  }
}

// However late a picture is, the next position is requested once it is there, never two at a time.
void TestCinePlayer::nothingRunsAheadOfDrawing() {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Chance chance(seed);
    Listed what;
    double now = 0;
    CinePlayer player(what, {0, 9}, [&] { return now; });
    for (int n = 0; n < 60; ++n) {
      const std::size_t before = what.visited.size();
      const double ms = chance.between(0, 400);
      what.ready = chance.oneIn(2);
      now += ms;
      player.tick();
      QVERIFY(what.visited.size() <= before + (what.ready ? 1 : 0));
      if (what.ready && ms >= 100) QCOMPARE(what.visited.size(), before + 1);
      if (what.visited.size() > 1)
        QCOMPARE(what.visited.back(), (what.visited[what.visited.size() - 2] + 1) % 10);
    }
  }
}

void TestCinePlayer::clipsLeaveFramesOut() {
  Listed what;
  what.time = true;
  double now = 0;
  CinePlayer player(what, {0, 9}, [&] { return now; });
  for (const double ms : {250.0, 990.0, 1000.0, 5730.0}) {
    now = ms;
    player.tick();
    QCOMPARE(what.at, int(ms / 100) % 10);
  }
  QCOMPARE(what.visited, (std::vector<int>{2, 9, 0, 7}));
}

void TestCinePlayer::anotherSpeedGoesOnFromThere() {
  Listed what;
  double now = 0;
  CineRound round{0, 9, true, true, 0};
  CinePlayer player(what, round, [&] { return now; });
  for (int n = 0; n < 12; ++n) {
    now += 100;
    player.tick();
  }
  QCOMPARE(what.at, 6);  // 9 minus three steps back
  round.rate = 20;
  player.setRound(round);
  for (const int expected : {5, 4, 3}) {
    now += 50;
    player.tick();
    QCOMPARE(what.at, expected);
  }
}

void TestCinePlayer::itEndsWhereSomethingElseGoes() {
  Listed what;
  double now = 0;
  CinePlayer player(what, {0, 9}, [&] { return now; });
  QSignalSpy over(&player, &CinePlayer::over);
  now = 100;
  player.tick();
  QCOMPARE(over.count(), 0);
  what.at = 7;
  now = 200;
  player.tick();
  QCOMPARE(over.count(), 1);
  QCOMPARE(what.at, 7);
}

VOLUMEN_TEST(TestCinePlayer);
#include "tst_cine_player.moc"
