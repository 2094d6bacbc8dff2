// Guards slices.md 2 in the window: frames of clips are scrolled and played.
#include <QElapsedTimer>
#include <QMimeData>
#include <QTreeWidgetItemIterator>
#include <set>
#include <utility>

#include "results/pictures/picture_font.h"
#include "tests/ui/frames_window.h"
#include "ui/views/cine_player.h"
#include "ui/workspace/cine.h"

using namespace volumen;
using volumen::tests::clipFile;
using volumen::tests::Frames;
using volumen::tests::longest;
using volumen::tests::wheel;

class TestClips : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void framesAreScrolled();
  void theScrollToolGoesThroughFrames();
  void aClipIsPlayedByTheClock();
  void playingEndsWithAScroll();
  void playingEndsWhereAnotherFrameIsWanted();
  void aClipPaintsNoOtherView();
  void aClipThatIsTooSlowIsRed();
  void aClipIsDraggedIntoAComparedView();
};

void TestClips::framesAreScrolled() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  QVERIFY(w.press(Qt::Key_Down));
  QCOMPARE(w.look().frame, 1);
  QVERIFY(w.after([&] { wheel(w.view(), -3); }));
  QCOMPARE(w.look().frame, 4);
  QVERIFY(w.press(Qt::Key_End));
  QCOMPARE(w.view()->overlays().topRight.front(), QStringLiteral("Frame 34 / 34"));
  QTest::keyClick(w.view(), Qt::Key_Down);
  QCOMPARE(w.look().frame, 33);
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.look().frame, 0);
  w.child<QAction>("redo")->trigger();
  QVERIFY(w.shows());
  QVERIFY(w.press(Qt::Key_Home));
  QCOMPARE(w.look().frame, 0);
}

void TestClips::theScrollToolGoesThroughFrames() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.view()->setTool(toolNamed("scroll"));
  QVERIFY(w.after([&] { tests::drag(w.view(), {50, 50}, {50, 50.0 + w.view()->height() / 2.0}); }));
  QVERIFY2(std::abs(w.look().frame - 17) <= 1, qPrintable(QString::number(w.look().frame)));
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.look().frame, 0);
}

// Plays 33 frames a second. Frames are dropped rather than time, so the clock determines the frame on screen.
void TestClips::aClipIsPlayedByTheClock() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  std::set<int> seen;
  int last = 0, came = 0;  // frames advanced, with earlier rounds
  const int steps = w.session().undoStack().count();
  // Starts before the player's clock, so that the due frame is never behind the shown one.
  QElapsedTimer clock;
  clock.start();
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(qobject_cast<FrameView*>(w.view())->isPlaying());
  const auto hasRun = [&] {
    const int now = tests::frameIn(w.view())->key.index;
    came += (now - std::exchange(last, now) + 34) % 34;
    seen.insert(now);
    const bool saysRate = w.view()->overlays().topRight.front().endsWith(QStringLiteral(" a second"));
    return clock.elapsed() > 2000 && seen.size() > 20 && saysRate;
  };
  QVERIFY(QTest::qWaitFor(hasRun, longest));
  qInfo("%s", qPrintable(w.view()->overlays().topRight.front()));
  const double due = cineRate(seriesIn(w.workspace(), axialViewId)->cine) * double(clock.elapsed()) / 1000;
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(!qobject_cast<FrameView*>(w.view())->isPlaying());
  // Allows half a second of delay on a machine that is busy with other tests.
  QVERIFY2(came <= due + 1 && came >= due - 17,
           qPrintable(QStringLiteral("%1 are due, %2 came").arg(due).arg(came)));
  QCOMPARE(w.session().undoStack().count(), steps + 1);
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.look().frame, 0);
}

void TestClips::playingEndsWithAScroll() {
  NEED_FILES();
  Frames w({"us-palette-cine-10.dcm"});
  QVERIFY(w.shows());
  w.child<QAction>("playFrames")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(tests::frameIn(w.view())->key.index >= 3, longest);
  const int shown = tests::frameIn(w.view())->key.index;
  wheel(w.view(), 1);
  QVERIFY(!qobject_cast<FrameView*>(w.view())->isPlaying());
  QCOMPARE(w.look().frame, shown - 1);
}

// If something other than a scroll chooses a frame, that frame is shown and playback does not overwrite it.
void TestClips::playingEndsWhereAnotherFrameIsWanted() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  QTest::keyClick(w.view(), Qt::Key_C);
  QTRY_VERIFY_WITH_TIMEOUT(tests::frameIn(w.view())->key.index >= 3, longest);
  const int steps = w.session().undoStack().count();
  goToPlace(w.session(), axialViewId, nullptr, 30);
  QVERIFY(!w.view()->isPlaying());
  QVERIFY(w.shows());
  QCOMPARE(w.look().frame, 30);
  QCOMPARE(w.session().undoStack().count(), steps + 1);
}

// A clip has no position in the patient, so no view draws a line of it.
void TestClips::aClipPaintsNoOtherView() {
  NEED_FILES();
  struct Paints : QObject {
    int count = 0;
    bool eventFilter(QObject*, QEvent* event) override {
      count += event->type() == QEvent::Paint;
      return false;
    }
  } paints;
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.child<QAction>("layoutTwo")->trigger();
  QVERIFY(w.shows(firstComparedId));
  w.session().setFocus(firstComparedId);
  FlatView* beside = w.view(firstComparedId + 1);
  QVERIFY(beside && beside->isVisible());
  QTest::qWait(200);  // until all views are painted
  beside->installEventFilter(&paints);
  std::set<int> seen;
  QTest::keyClick(w.view(firstComparedId), Qt::Key_C);
  // A slow machine drops frames, so that the view may never be at rest.
  const auto hasPlayed = [&] {
    seen.insert(tests::frameIn(w.view(firstComparedId))->key.index);
    return seen.size() >= 20;
  };
  QVERIFY(QTest::qWaitFor(hasPlayed, longest));
  QVERIFY2(paints.count < 10, qPrintable(QString::number(paints.count)));
}

void TestClips::aClipThatIsTooSlowIsRed() {
  struct Hundred : Playable {
    int at = 0;
    Stack stack() const override { return countedStack({}, {at, 100}); }
    SeriesKey source() const override { return {}; }
    Cine cine() const override { return {20, {}, false}; }
    void goTo(int place) override { at = place; }
    bool isReady(int) const override { return true; }
  } hundred;
  CinePlayer player(hundred, {0, 99});
  for (int frame = 0; frame < 16; ++frame) {
    player.tellShown(frame);
    QTest::qWait(100);
  }
  QVERIFY2(player.rate() > 0 && player.rate() < 10.5, qPrintable(QString::number(player.rate())));
  QVERIFY(player.isLate());
  Overlays over;
  over.topRight = {QStringLiteral("Frame 1 / 2"), QStringLiteral("px")};
  over.isLate = true;
  for (const PlacedText& text : placeOverlays(over, QRectF(0, 0, 400, 300), pictureFont()).texts)
    QCOMPARE(text.late, text.text.startsWith(QStringLiteral("Frame")));
}

void TestClips::aClipIsDraggedIntoAComparedView() {
  NEED_FILES();
  Frames w({clipFile, "cr-hip-mono2-jpeg12.dcm"});
  QVERIFY(w.shows());
  QTRY_VERIFY_WITH_TIMEOUT(w.item("(hidden)") || w.tree()->topLevelItemCount() >= 2, longest);
  w.child<QAction>("layoutTwo")->trigger();
  QVERIFY(w.shows(firstComparedId));
  QTreeWidgetItem* hip = nullptr;
  for (QTreeWidgetItemIterator it(w.tree()); *it; ++it)
    if ((*it)->toolTip(0).contains(QStringLiteral("cr-hip"))) hip = *it;
  QVERIFY(hip);
  const std::unique_ptr<QMimeData> dragged(
      w.tree()->model()->mimeData({w.tree()->indexAt(w.tree()->visualItemRect(hip).center())}));
  FlatView* second = w.view(firstComparedId + 1);
  QVERIFY(tests::drop(*dragged, second));
  QVERIFY(w.shows(firstComparedId + 1));
  QVERIFY(!tests::frameIn(w.view(firstComparedId + 1))->colour());
  QVERIFY(tests::frameIn(w.view(firstComparedId))->colour());
  w.shot("frames-compared");
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace().view(firstComparedId + 1).series.empty());
}

VOLUMEN_TEST(TestClips);
#include "tst_clips.moc"
