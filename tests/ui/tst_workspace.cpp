// Guards the document: views keep their state of each series, every change is an undo step, and series leave
// memory if there is no space.
#include <QSignalSpy>
#include <QTest>
#include <random>

#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/workspace/needed_series.h"
#include "ui/workspace/session.h"
#include "ui/workspace/session_json.h"

using namespace volumen;

namespace {

void brighten(Session& session, double intensity) {
  session.edit(QStringLiteral("Light"), [&](Scene& s) { s.lights[0].intensity = intensity; });
  session.endGesture();
}

double brightness(const Session& session) { return session.scene().lights[0].intensity; }

}  // namespace

class TestWorkspace : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void editsSurviveASwitchAndBack();
  void aSwitchIsAStep();
  void viewsOfAGroupShowOneSeries();
  void comparedViewsShowTheirOwn();
  void layoutsKeepTheFocusOnScreen_data();
  void layoutsKeepTheFocusOnScreen();
  void randomStepsAreUndoneToTheByte();
  void whatPlaysOnBelongsToTheStepBefore();
  void theOldestSeriesGoFirst();
  void whatIsOnScreenStays();
  void aSeriesThatWentIsAskedForAgain();
  void closingIsAStep();
  void theTableComesBackWithUndo();
};

void TestWorkspace::editsSurviveASwitchAndBack() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries();
  session.show(a);
  brighten(session, 0.25);
  session.show(b);
  QCOMPARE(brightness(session), 1.0);
  brighten(session, 0.5);
  QVERIFY(session.showAgain(a->series, session.workspace().focus));
  QCOMPARE(brightness(session), 0.25);
  session.show(b);
  QCOMPARE(brightness(session), 0.5);
}

void TestWorkspace::aSwitchIsAStep() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries();
  session.show(a);
  QVERIFY2(!session.undoStack().canUndo(), "the first series is where it begins");
  brighten(session, 0.25);
  session.show(b);
  brighten(session, 0.5);
  session.undoStack().undo();
  QVERIFY(session.series() == b);
  session.undoStack().undo();
  QVERIFY(session.series() == a);
  QCOMPARE(brightness(session), 0.25);
  session.undoStack().undo();
  QCOMPARE(brightness(session), 1.0);
  while (session.undoStack().canRedo()) session.undoStack().redo();
  QVERIFY(session.series() == b);
  QCOMPARE(brightness(session), 0.5);
}

void TestWorkspace::viewsOfAGroupShowOneSeries() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries();
  session.show(a);
  for (ViewId id = 0; id < firstComparedId; ++id) QVERIFY(session.seriesOf(id) == a);
  for (ViewId id = firstComparedId; id < viewCount; ++id) QVERIFY(!session.seriesOf(id));
}

void TestWorkspace::comparedViewsShowTheirOwn() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries();
  session.show(a);
  session.change(QStringLiteral("Layout"), withLayout(session.workspace(), Layout::two));
  QVERIFY2(session.seriesOf(firstComparedId) == a, "beside what was shown");
  session.show(b, firstComparedId + 1);
  QVERIFY(session.seriesOf(firstComparedId) == a);
  QVERIFY(session.seriesOf(firstComparedId + 1) == b);
  QVERIFY(session.seriesOf(axialViewId) == a);
}

void TestWorkspace::layoutsKeepTheFocusOnScreen_data() {
  QTest::addColumn<int>("from");
  QTest::addColumn<int>("to");
  for (std::size_t from = 0; from < allLayouts().size(); ++from)
    for (std::size_t to = 0; to < allLayouts().size(); ++to)
      QTest::addRow("%s to %s", layoutName(allLayouts()[from]), layoutName(allLayouts()[to]))
          << int(from) << int(to);
}

void TestWorkspace::layoutsKeepTheFocusOnScreen() {
  QFETCH(int, from);
  QFETCH(int, to);
  const Layout first = allLayouts()[std::size_t(from)], second = allLayouts()[std::size_t(to)];
  QCOMPARE(*layoutNamed(layoutName(second)), second);
  Workspace workspace;
  for (ViewId focus = 0; focus < firstSecondId; ++focus) {
    workspace.focus = focus;
    const Workspace after = withLayout(withLayout(workspace, first), second);
    const auto views = viewsOnScreen(after);
    QVERIFY(std::ranges::find(views, after.focus) != views.end());
    if (std::ranges::find(views, focus) != views.end() && from == to) QCOMPARE(after.focus, focus);
    const ViewId scene = sceneViewOf(after);
    QVERIFY(after.view(scene).kind == ViewKind::volume);
  }
}

void TestWorkspace::randomStepsAreUndoneToTheByte() {
  std::mt19937 random(7);
  const auto below = [&](int n) { return int(random() % unsigned(n)); };
  Session session;
  const std::vector<LoadedSeriesPtr> series{tests::ballSeries(), tests::ballSeries(), tests::ballSeries()};
  session.show(series[0]);
  std::vector<Workspace> history{session.workspace()};
  std::vector<std::string> files;
  while (history.size() <= 200) {
    switch (below(7)) {
      case 0:
        session.show(series[std::size_t(below(3))], below(viewCount));
        break;
      case 1:
        session.change(
            QStringLiteral("Layout"),
            withLayout(session.workspace(), allLayouts()[std::size_t(below(int(allLayouts().size())))]));
        break;
      case 2:
        brighten(session, 0.01 * below(100));
        break;
      case 3:
        session.change(QStringLiteral("Zoom"), [&](Workspace& w) {
          ViewState& view = w.editView(below(viewCount));
          view.flats.editOrAdd(view.series).zoom = 1 + below(9);
        });
        break;
      case 4:
        session.showAs(below(viewCount), ViewKind(below(4)));
        break;
      case 5: {
        const SeriesKey key = keyOf(series[std::size_t(below(3))]->series);
        if (!session.workspace().series.contains(key)) break;
        Mask mask = session.maskOf(key);
        if (below(4) == 0) mask.tableRemoved = !mask.tableRemoved;
        if (below(6) == 0) mask.lassos.clear();
        Lasso lasso;
        lasso.perspective = below(2);
        lasso.inside = below(2);
        for (int n = below(9); n > 0; --n) lasso.points.emplace_back(below(99) / 7.0, below(99) / 3.0);
        mask.lassos.push_back(std::make_shared<const Lasso>(lasso));
        session.setMask(QStringLiteral("Cut"), key, mask);
        break;
      }
      default:
        session.change(QStringLiteral("Crosshair"),
                       [&](Workspace& w) { w.crosshairs.editOrAdd("f").at.x = below(99); });
    }
    session.endGesture();
    if (session.undoStack().index() == int(history.size())) history.push_back(session.workspace());
  }
  for (const Workspace& workspace : history) files.push_back(*sessionToJson(workspace, "/"));
  for (std::size_t n = history.size() - 1; n-- > 0;) {
    session.undoStack().undo();
    QVERIFY2(session.workspace() == history[n], qPrintable(QString::number(n)));
    QVERIFY2(*sessionToJson(session.workspace(), "/") == files[n], qPrintable(QString::number(n)));
  }
  for (std::size_t n = 1; n < history.size(); ++n) {
    session.undoStack().redo();
    QVERIFY2(session.workspace() == history[n], qPrintable(QString::number(n)));
  }
}

void TestWorkspace::whatPlaysOnBelongsToTheStepBefore() {
  Session session;
  session.show(tests::ballSeries());
  brighten(session, 0.9);
  const auto steps = [&] { return session.undoStack().index(); };
  const int atStart = steps();
  const auto play = [&](double intensity) {
    session.playOn(atStart, [&] {
      session.edit(
          QStringLiteral("Played"), [&](Scene& s) { s.lights[0].intensity = intensity; },
          QStringLiteral("Played"));
    });
  };
  const Workspace start = session.workspace();
  play(0.1);
  QCOMPARE(steps(), atStart + 1);
  play(0.2);
  const Workspace played = session.workspace();
  session.edit(
      QStringLiteral("Mode"), [](Scene& s) { s.mode = Mode::mip; }, QStringLiteral("Mode"));
  play(0.3);
  session.edit(
      QStringLiteral("Mode"), [](Scene& s) { s.mode = Mode::minip; }, QStringLiteral("Mode"));
  play(0.4);
  const Workspace last = session.workspace();
  QCOMPARE(steps(), atStart + 2);
  QCOMPARE(session.undoStack().undoText(), QStringLiteral("Mode"));
  session.undoStack().undo();
  QVERIFY(session.workspace() == played);
  session.undoStack().undo();
  QVERIFY(session.workspace() == start);
  session.undoStack().redo();
  session.undoStack().redo();
  QVERIFY(session.workspace() == last);
  // Back at its start, the step disappears, and the previous step is unaffected.
  session.undoStack().undo();
  session.undoStack().undo();
  play(0.1);
  play(0.9);
  QCOMPARE(steps(), atStart);
  play(0.2);
  QCOMPARE(steps(), atStart + 1);
  session.undoStack().undo();
  QVERIFY(session.workspace() == start);
}

void TestWorkspace::theOldestSeriesGoFirst() {
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries(), c = tests::ballSeries();
  const std::size_t one = a->volume->bytes();
  SeriesPool pool(2 * one);
  pool.put({keyOf(a->series), {}}, a);
  pool.put({keyOf(b->series), {}}, b);
  QVERIFY(pool.find({keyOf(a->series), {}}) == a);
  pool.put({keyOf(c->series), {}}, c);
  QVERIFY2(!pool.find({keyOf(b->series), {}}), "used longest ago");
  QVERIFY(pool.find({keyOf(a->series), {}}) && pool.find({keyOf(c->series), {}}));
  QCOMPARE(pool.bytes(), 2 * one);
}

void TestWorkspace::whatIsOnScreenStays() {
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries(), c = tests::ballSeries();
  SeriesPool pool(1);
  pool.setOnScreen({{keyOf(a->series), {}}});
  pool.put({keyOf(a->series), {}}, a);
  pool.put({keyOf(b->series), {true, {}}}, b);
  pool.put({keyOf(c->series), {}}, c);
  QVERIFY2(pool.find({keyOf(a->series), {}}), "on screen");
  QVERIFY2(!pool.find({keyOf(b->series), {true, {}}}), "made again where it is wanted");
  pool.put({keyOf(c->series), {}}, c);
  pool.setOnScreen({});
  QVERIFY(!pool.find({keyOf(a->series), {}}));
}

void TestWorkspace::aSeriesThatWentIsAskedForAgain() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries();
  session.pool().setBudget(1);
  session.show(a);
  brighten(session, 0.25);
  session.show(b);
  QVERIFY(!session.pool().find({keyOf(a->series), {}}));
  session.undoStack().undo();
  const std::vector<NeededSeries> needed = neededSeries(session.workspace(), {}, session.pool());
  QCOMPARE(needed.size(), std::size_t(1));
  QCOMPARE(needed[0].series->id, a->series.id);
  QVERIFY(!session.series());
  session.keep(a);
  QVERIFY(session.series() == a);
  QCOMPARE(brightness(session), 0.25);
  QVERIFY2(session.undoStack().canRedo(), "what came back is no step");
}

void TestWorkspace::closingIsAStep() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries();
  session.show(a);
  session.show(b);
  const Workspace before = session.workspace();
  session.close({keyOf(b->series)});
  QVERIFY(!session.series());
  QVERIFY(session.showAgain(a->series, sceneViewId));
  session.show(nullptr);
  QVERIFY(!session.showAgain(a->series, sceneViewId));
  Workspace empty = session.workspace();
  QCOMPARE(empty.unlisted->series.size(), std::size_t(2));
  empty.unlisted = {};
  QVERIFY(empty == Workspace());
  // The next shown series is an undo step. Otherwise undo would restore the first ones in its place.
  const LoadedSeriesPtr c = tests::ballSeries();
  session.show(c);
  session.undoStack().undo();
  QVERIFY(session.workspace().series.empty());
  for (int n = 0; n < 3; ++n) session.undoStack().undo();
  QVERIFY(session.workspace() == before);
}

void TestWorkspace::theTableComesBackWithUndo() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries();
  const auto masked = std::make_shared<const LoadedSeries>(*a);
  session.show(a);
  const SeriesKey key = keyOf(a->series);
  const Mask mask{true, {}};
  session.keep(masked, mask);
  QVERIFY(session.series() == a);
  session.setMask(QStringLiteral("Remove table"), key, mask);
  QVERIFY(session.series() == masked && session.maskOf(key) == mask);
  session.undoStack().undo();
  QVERIFY(session.series() == a && session.maskOf(key).empty());
  QVERIFY(session.seriesWith(key, mask) == masked);
}

VOLUMEN_TEST(TestWorkspace);
#include "tst_workspace.moc"
