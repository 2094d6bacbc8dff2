// Guards the views of the second window as values. They are comparison views independent of the main window:
// layout, focus and hanging protocols of one window do not change the other.
#include <algorithm>

#include "tests/unit/suite.h"
#include "tests/unit/workspace/hung_series.h"
#include "ui/workspace/flat_plane.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

bool isAmong(const std::vector<ViewId>& views, ViewId id) {
  return std::ranges::find(views, id) != views.end();
}

Layout anyGrid(int rows, int columns) { return {Layout::Kind::grid, rows, columns}; }

// Opens the second window with two views, the last one focused and showing a series.
Workspace withTwoBeside(Workspace workspace, const Series& series) {
  workspace = withSecondLayout(withSecondShown(std::move(workspace), true), Layout::two);
  workspace = withFocus(std::move(workspace), firstSecondId + 1);
  return withSeries(std::move(workspace), firstSecondId + 1, series, {});
}

}  // namespace

class TestSecondViews : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyStandBesideThoseOfTheMainWindow_data();
  void theyStandBesideThoseOfTheMainWindow();
  void closedAndOpenedAgainTheyShowTheSame();
  void itsGridsKeepTheFocusOnScreen_data();
  void itsGridsKeepTheFocusOnScreen();
  void aLayoutOfTheMainWindowFollowsItsOwnFocus();
  void protocolsFillTheMainWindowAlone();
  void aProtocolIsMadeOfTheMainWindow();
  void framesStayInTheirWindow();
  void theSceneOfTheSameWindowComesFirst();
  void eachScrollsAlone();
};

void TestSecondViews::theyStandBesideThoseOfTheMainWindow_data() {
  QTest::addColumn<int>("layout");
  for (std::size_t n = 0; n < allLayouts().size(); ++n) QTest::newRow(layoutName(allLayouts()[n])) << int(n);
}

void TestSecondViews::theyStandBesideThoseOfTheMainWindow() {
  QFETCH(int, layout);
  const Workspace before = withLayout({}, allLayouts()[std::size_t(layout)]);
  QVERIFY(viewsInSecond(before).empty());
  QCOMPARE(viewsOnScreen(before), viewsInMain(before));
  const Workspace open = withSecondLayout(withSecondShown(before, true), anyGrid(2, 3));
  QCOMPARE(viewsInMain(open), viewsInMain(before));
  const std::vector<ViewId> expected{firstSecondId,     firstSecondId + 1, firstSecondId + 2,
                                     firstSecondId + 3, firstSecondId + 4, firstSecondId + 5};
  QCOMPARE(viewsInSecond(open), expected);
  std::vector<ViewId> all = viewsInMain(before);
  all.insert(all.end(), expected.begin(), expected.end());
  QCOMPARE(viewsOnScreen(open), all);
  QCOMPARE(viewsBeside(open, firstSecondId + 19), expected);
  QCOMPARE(viewsBeside(open, firstComparedId), viewsInMain(before));
  QVERIFY(layoutOf(open, firstSecondId) == anyGrid(2, 3) && layoutOf(open, 0) == before.layout);
}

void TestSecondViews::closedAndOpenedAgainTheyShowTheSame() {
  const OpenPictures open(brainSeries);
  for (const ViewId focus : {sceneViewId, sagittalViewId, firstComparedId + 3}) {
    Workspace before;
    before.focus = focus;
    QVERIFY(withSecondShown(withSecondShown(before, true), false) == before);
    const Workspace shown = withTwoBeside(before, open.series[0]);
    QCOMPARE(viewsInMain(shown), std::vector{focus});
    const Workspace closed = withSecondShown(shown, false);
    QCOMPARE(closed.focus, focus);
    QVERIFY(viewsInSecond(closed).empty());
    const Workspace again = withSecondShown(closed, true);
    QVERIFY(again.views == shown.views && again.second.layout == Layout::two);
    QCOMPARE(again.focus, firstSecondId);
    QVERIFY(withFocus(again, shown.focus) == shown);
  }
}

void TestSecondViews::itsGridsKeepTheFocusOnScreen_data() {
  QTest::addColumn<int>("layout");
  for (std::size_t n = 0; n < allLayouts().size(); ++n) QTest::newRow(layoutName(allLayouts()[n])) << int(n);
}

void TestSecondViews::itsGridsKeepTheFocusOnScreen() {
  QFETCH(int, layout);
  const Layout chosen = allLayouts()[std::size_t(layout)];
  const Workspace large = withSecondLayout(withSecondShown({}, true), anyGrid(4, 5));
  for (ViewId focus = firstSecondId; focus < viewCount; ++focus) {
    const Workspace after = withSecondLayout(withFocus(large, focus), chosen);
    QVERIFY(after.second.layout == (comparesSeries(chosen) ? chosen : anyGrid(1, 1)));
    QVERIFY2(after.layout == Layout::one, "that of the main window");
    QCOMPARE(after.focus, isAmong(viewsInSecond(after), focus) ? focus : firstSecondId);
    QCOMPARE(mainFocusOf(after), sceneViewId);
  }
  const Workspace main = withFocus(large, axialViewId);
  QVERIFY2(withSecondLayout(main, chosen).focus == axialViewId, "it is in the main window");
}

void TestSecondViews::aLayoutOfTheMainWindowFollowsItsOwnFocus() {
  const OpenPictures open(brainSeries);
  Workspace w = withSeries({}, sceneViewId, open.series[1], {});
  w = withLayout(withTwoBeside(std::move(w), open.series[0]), Layout::four);
  QVERIFY2(w.view(firstComparedId).series == keyOf(open.series[1]), "what was in focus there");
  QCOMPARE(w.focus, firstSecondId + 1);
  QCOMPARE(mainFocusOf(w), firstComparedId);
  w = withLayout(withFocus(std::move(w), firstComparedId + 2), Layout::one);
  QCOMPARE(viewsInMain(w), std::vector{firstComparedId + 2});
  w = withFocus(std::move(w), firstSecondId);
  QVERIFY2(viewsInMain(w) == std::vector{firstComparedId + 2}, "the view that was in focus stays");
}

void TestSecondViews::protocolsFillTheMainWindowAlone() {
  const KnownProtocols known = knownProtocols();
  const OpenPictures open(fourBreasts), brain(brainSeries);
  const Workspace before = withTwoBeside({}, brain.series[0]);
  const HangingProtocol& protocol = protocolNamed(known, "Mammograms");
  const Workspace after = hung(before, protocol, open.studies());
  QVERIFY(after.layout == Layout::four);
  QVERIFY(after.second.shown && after.second.layout == Layout::two);
  for (ViewId id = firstSecondId; id < viewCount; ++id) {
    QVERIFY(after.view(id).series == before.view(id).series);
    QVERIFY(after.view(id).kind == before.view(id).kind && after.view(id).flats == before.view(id).flats);
  }
  for (int n = 0; n < 4; ++n) QVERIFY(!after.view(firstComparedId + n).series.empty());
  QVERIFY(isAmong(viewsInMain(after), after.focus));
}

void TestSecondViews::aProtocolIsMadeOfTheMainWindow() {
  const KnownProtocols known = knownProtocols();
  const OpenPictures open(brainSeries);
  const Workspace main = hung({}, protocolNamed(known, "MR brain"), open.studies());
  const Workspace both = withFocus(withTwoBeside(main, open.series[5]), main.focus);
  const HangingProtocol kept = protocolOf(both, "Mine", open.pictures());
  QVERIFY(kept == protocolOf(main, "Mine", open.pictures()));
  QCOMPARE(int(kept.cells.size()), main.layout.rows * main.layout.columns);
}

void TestSecondViews::framesStayInTheirWindow() {
  const OpenPictures open(brainSeries);
  const Workspace planes = withLayout(withSeries({}, sceneViewId, open.series[1], {}), Layout::planes);
  const Workspace beside = withFrames(withSecondShown(planes, true), firstSecondId, open.series[1]);
  QVERIFY(showsFrames(beside, firstSecondId));
  QCOMPARE(beside.focus, firstSecondId);
  QCOMPARE(viewsInMain(beside), viewsInMain(planes));
  const Workspace unfocused =
      withFrames(withFocus(withSecondShown(planes, true), sceneViewId), firstSecondId, open.series[1]);
  QCOMPARE(unfocused.focus, sceneViewId);
  // Frames in the main window end while the second window has the focus.
  const Workspace frames = withSecondShown(withFrames({}, sceneViewId, open.series[1]), true);
  QCOMPARE(viewsInMain(frames), std::vector{axialViewId});
  QCOMPARE(frames.focus, firstSecondId);
  const Workspace volume = withSeries(frames, sceneViewId, open.series[1], {});
  QCOMPARE(viewsInMain(volume), std::vector{sceneViewId});
  QCOMPARE(volume.focus, firstSecondId);
}

void TestSecondViews::theSceneOfTheSameWindowComesFirst() {
  const OpenPictures open(brainSeries);
  Workspace w = withLayout(withSeries({}, sceneViewId, open.series[0], {}), Layout::two);
  w = withKind(std::move(w), firstComparedId, ViewKind::volume, {});
  w = withTwoBeside(std::move(w), open.series[1]);
  QCOMPARE(sceneViewOf(w), firstComparedId);
  w = withSeries(std::move(w), firstSecondId, open.series[1], {});
  w = withKind(std::move(w), firstSecondId, ViewKind::volume, {});
  QCOMPARE(sceneViewOf(w), firstSecondId);
  QCOMPARE(sceneViewOf(withFocus(w, firstComparedId + 1)), firstComparedId);
}

void TestSecondViews::eachScrollsAlone() {
  Workspace w = withSecondShown({}, true);
  QVERIFY(!scrollsAlone(w, firstSecondId));
  w.links.scroll = false;
  QVERIFY(scrollsAlone(w, firstSecondId) && scrollsAlone(w, viewCount - 1));
}

VOLUMEN_TEST(TestSecondViews);
#include "tst_second_views.moc"
