// Guards design.md 11: one scheduler draws the view of the last gesture first, and drafts before pictures at
// rest.
#include "tests/unit/suite.h"
#include "ui/controller/draw_schedule.h"

using namespace volumen;

Q_DECLARE_METATYPE(volumen::Waiting)
Q_DECLARE_METATYPE(std::optional<volumen::Turn>)

class TestDrawSchedule : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsDrawnNext_data();
  void whatIsDrawnNext();
  void allIsDrawnInTheEnd();
};

namespace {

WaitingView waits(ViewId view, Work next, int ms = 0) { return {view, next, std::chrono::milliseconds(ms)}; }

}  // namespace

void TestDrawSchedule::whatIsDrawnNext_data() {
  QTest::addColumn<Waiting>("waiting");
  QTest::addColumn<std::optional<Turn>>("turn");
  const auto row = [](const char* name, const Waiting& waiting, std::optional<Turn> turn) {
    QTest::newRow(name) << waiting << turn;
  };
  using enum Work;
  row("nothing", {}, {});
  row("thumbnails, where there is nothing else", {.views = {}, .gestureView = {}, .thumbnail = true},
      Turn{thumbnail});
  row("a trial before thumbnails", {.views = {}, .gestureView = {}, .trial = true, .thumbnail = true},
      Turn{trial});
  row("a picture to be saved before a trial",
      {.views = {}, .gestureView = {}, .saved = true, .trial = true, .thumbnail = true}, Turn{saved});
  row("the screen before all of them",
      {.views = {waits(3, rest)}, .gestureView = {}, .saved = true, .trial = true, .thumbnail = true},
      Turn{rest, 3});
  row("the view of the last gesture", {.views = {waits(1, draft), waits(2, draft)}, .gestureView = 2},
      Turn{draft, 2});
  row("the view of the last gesture, although others have waited",
      {.views = {waits(1, draft, 200), waits(2, draft)}, .gestureView = 2}, Turn{draft, 2});
  row("no starving: another has waited for too long",
      {.views = {waits(1, draft, 300), waits(2, draft)}, .gestureView = 2}, Turn{draft, 1});
  row("both have: the one that has waited for longest",
      {.views = {waits(2, draft, 300), waits(1, draft, 400)}, .gestureView = 2}, Turn{draft, 1});
  row("no gesture: the one that has waited for longest",
      {.views = {waits(1, draft, 10), waits(2, draft, 20), waits(3, draft)}, .gestureView = {}},
      Turn{draft, 2});
  row("a draft of another before the picture at rest under the hand",
      {.views = {waits(1, rest), waits(2, draft)}, .gestureView = 1}, Turn{draft, 2});
  row("a draft of another before the finer one under the hand",
      {.views = {waits(1, finer), waits(2, draft)}, .gestureView = 1}, Turn{draft, 2});
  row("a finer draft of another before the picture at rest under the hand",
      {.views = {waits(1, rest), waits(2, finer)}, .gestureView = 1}, Turn{finer, 2});
  row("pictures at rest: the view of the last gesture, however long others have waited",
      {.views = {waits(1, rest, 5000), waits(2, rest)}, .gestureView = 2}, Turn{rest, 2});
  row("the hand is over a view that waits for nothing", {.views = {waits(1, rest)}, .gestureView = 2},
      Turn{rest, 1});
}

void TestDrawSchedule::whatIsDrawnNext() {
  QFETCH(Waiting, waiting);
  QFETCH(std::optional<Turn>, turn);
  QVERIFY(nextTurn(waiting) == turn);
}

// Draws four views from drafts to rest. The drafts of all views come first, and at each stage the view of the
// last gesture.
void TestDrawSchedule::allIsDrawnInTheEnd() {
  using enum Work;
  Waiting waiting{.views = {waits(0, draft), waits(1, draft), waits(2, draft), waits(3, draft)},
                  .gestureView = 2};
  std::vector<Turn> done;
  while (const auto turn = nextTurn(waiting)) {
    done.push_back(*turn);
    const auto view = std::find_if(waiting.views.begin(), waiting.views.end(),
                                   [&](const WaitingView& v) { return v.view == turn->view; });
    if (turn->work == rest)
      waiting.views.erase(view);
    else
      view->next = Work(int(turn->work) + 1);
  }
  std::vector<Turn> expected;
  for (const Work work : {draft, finer, rest})
    for (const ViewId view : {2, 0, 1, 3}) expected.push_back({work, view});
  QVERIFY(done == expected);
}

VOLUMEN_TEST(TestDrawSchedule);
#include "tst_draw_schedule.moc"
