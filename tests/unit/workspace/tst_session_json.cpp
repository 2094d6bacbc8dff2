// Guards design.md 11: a session is the workspace as a value, and unreadable parts are reported.
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/plain_session.h"
#include "tests/unit/workspace/random_workspace.h"

using namespace volumen;
using volumen::tests::plainSession;
using volumen::tests::randomWorkspace;
using volumen::tests::sessionFolder;
using volumen::tests::whyNoSession;
using Json = nlohmann::ordered_json;

namespace {

// Finds the workspace's own series if they match the session's proof.
FindSeries seriesOf(const Workspace& w) {
  return [&w](const SavedSeries& saved) -> std::shared_ptr<const Series> {
    const auto known = w.series.find(keyOf(saved.series));
    if (known == w.series.end() || known->second.missing || proofOf(*known->second.series) != saved.proof)
      return nullptr;
    return known->second.series;
  };
}

}  // namespace

class TestSessionJson : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void workspacesComeBackEqual();
  void sessionsOfEightViewsStayAsTheyAre();
  void theSecondWindowComesBack();
  void bothWindowsShowTheirFocus();
  void valuesAreComparedNotPlaces();
  void aSeriesElsewhereTakesAllThatWasMadeOfIt();
  void seriesThatAreNotFoundAreKeptAsMissing();
  void exportedSegmentsAreNamed();
  void segmentsAreInSlicesAloneWhereASessionSaysSo_data();
  void segmentsAreInSlicesAloneWhereASessionSaysSo();
  void stepsThatCannotBeReadAreLeftOutWithTheirRecord_data();
  void stepsThatCannotBeReadAreLeftOutWithTheirRecord();
  void aSeriesHasSeveralMapsOfSegments();
  void pathsAreAlsoRelativeToTheSession_data();
  void pathsAreAlsoRelativeToTheSession();
};

void TestSessionJson::workspacesComeBackEqual() {
  const tests::Seeds seeds = tests::seedsOf(330, 1000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    const Workspace w = randomWorkspace(std::uint64_t(seed));
    const auto text = sessionToJson(w, sessionFolder);
    QVERIFY2(
        text,
        qPrintable(
            QStringLiteral("seed %1: %2").arg(seed).arg(QString::fromStdString(text ? "" : text.message()))));
    const auto back = sessionFromJson(*text, seriesOf(w));
    QVERIFY2(
        back,
        qPrintable(
            QStringLiteral("seed %1: %2").arg(seed).arg(QString::fromStdString(back ? "" : back.message()))));
    QVERIFY2(back->workspace == w, qPrintable(QStringLiteral("seed %1").arg(seed)));
    QVERIFY2(*sessionToJson(back->workspace, sessionFolder) == *text,
             qPrintable(QStringLiteral("seed %1").arg(seed)));
  }
}

// Sessions from before larger grids have eight views.
void TestSessionJson::sessionsOfEightViewsStayAsTheyAre() {
  const Json plain = plainSession();
  QCOMPARE(plain["views"].size(), std::size_t(8));
  QVERIFY(!plain["views"][4].contains("wanted"));
  const auto back = sessionFromJson(plain.dump(), {});
  QVERIFY(back);
  QCOMPARE(back->workspace.views.size(), std::size_t(viewCount));
  QVERIFY(back->workspace.views[viewCount - 1] == Workspace().views[viewCount - 1]);
  Workspace large;
  large.layout = {Layout::Kind::grid, 3, 4};
  large.focus = firstComparedId + 11;
  large.editView(firstComparedId + 6).wanted = "T2";
  const Json written = Json::parse(*sessionToJson(large, sessionFolder));
  QCOMPARE(written["layout"].get<std::string>(), std::string("3x4"));
  QCOMPARE(written["views"].size(), std::size_t(firstComparedId + 7));
  const auto same = sessionFromJson(written.dump(), {});
  QVERIFY(same && same->workspace == large);
}

// Without a second window, sessions are written and read as before it existed.
void TestSessionJson::theSecondWindowComesBack() {
  const Json plain = plainSession();
  QVERIFY(!plain.contains("second"));
  const auto before = sessionFromJson(plain.dump(), {});
  QVERIFY(before && before->workspace.second == SecondWindow());
  Workspace w = withSecondShown({}, true);
  w = withSecondLayout(std::move(w), Layout{Layout::Kind::grid, 2, 3});
  w = withFocus(std::move(w), firstSecondId + 4);
  w.editView(firstSecondId + 5).wanted = "T2";
  const Json written = Json::parse(*sessionToJson(w, sessionFolder));
  QCOMPARE(written["second"]["layout"].get<std::string>(), std::string("2x3"));
  QCOMPARE(written["views"].size(), std::size_t(firstSecondId + 6));
  QCOMPARE(written["layout"].get<std::string>(), std::string("one"));
  const auto back = sessionFromJson(written.dump(), {});
  QVERIFY(back && back->workspace == w);
  const Workspace closed = withSecondShown(w, false);
  const auto same = sessionFromJson(*sessionToJson(closed, sessionFolder), {});
  QVERIFY2(same && same->workspace == closed, "its views are kept while it is closed");
  QVERIFY(same->workspace.view(firstSecondId + 5).wanted == "T2");
}

void TestSessionJson::bothWindowsShowTheirFocus() {
  Json written = Json::parse(*sessionToJson(withSecondShown({}, true), sessionFolder));
  QCOMPARE(whyNoSession(written.dump()), QString());
  written["layout"] = "two";
  QVERIFY(
      whyNoSession(written.dump()).contains(QStringLiteral("second.mainFocus must be a view of the layout")));
  written["second"]["mainFocus"] = 5;
  QCOMPARE(whyNoSession(written.dump()), QString());
}

void TestSessionJson::valuesAreComparedNotPlaces() {
  const Workspace w = randomWorkspace(3), same = randomWorkspace(3), other = randomWorkspace(4);
  QVERIFY(w == same);
  QVERIFY(!(w == other));
  Workspace changed = w;
  Series series = *changed.series.begin()->second.series;
  series.description += "x";
  changed.series.edit(changed.series.begin()->first).series = std::make_shared<const Series>(series);
  QVERIFY(!(w == changed));
}

void TestSessionJson::aSeriesElsewhereTakesAllThatWasMadeOfIt() {
  Series series, moved;
  series.path = "/old/ct.nrrd", moved.path = "/new/ct.nrrd";
  series.id = moved.id = "ct.nrrd";
  const auto shown = [](const Series& s) {
    Workspace w = withSeries({}, sceneViewId, s, {});
    w.crosshairs.editOrAdd(frameOfReference(s)).at = {1, 2, 3};
    return w;
  };
  const auto back = sessionFromJson(*sessionToJson(shown(series), "/old"), [&](const SavedSeries& saved) {
    return saved.relativePath == "ct.nrrd" ? std::make_shared<const Series>(moved) : nullptr;
  });
  QVERIFY(back);
  QVERIFY(back->workspace == shown(moved));
}

void TestSessionJson::seriesThatAreNotFoundAreKeptAsMissing() {
  Series gone;
  gone.id = "1.2", gone.path = "/gone";
  const Workspace w = withSeries(randomWorkspace(5), sceneViewId, gone, {});
  const std::string text = *sessionToJson(w, sessionFolder, "/data/s.volumen");
  const auto back = sessionFromJson(text, {});
  QVERIFY(back);
  QCOMPARE(back->savedAs, std::string("/data/s.volumen"));
  QVERIFY(back->workspace.views == w.views);
  QVERIFY(back->workspace.crosshairs == w.crosshairs);
  for (const auto& [key, state] : back->workspace.series) {
    QVERIFY(state.missing);
    const SeriesState& was = w.series.at(key);
    QVERIFY(*state.missing ==
            was.missing.value_or(MissingSeries{proofOf(*was.series), foldersOf(*was.series)}));
  }
  // Saving again keeps all of the proof.
  QVERIFY(*sessionToJson(back->workspace, sessionFolder, "/data/s.volumen") == text);
}

void TestSessionJson::exportedSegmentsAreNamed() {
  Series series;
  series.id = "1.2", series.path = "/ct";
  const Workspace w = withSeries({}, sceneViewId, series, {});
  const std::vector<ExportedMap> exported{{keyOf(series), 0}, {keyOf(series), 3}};
  const auto back = sessionFromJson(*sessionToJson(w, sessionFolder, {}, {}, exported), {});
  QVERIFY(back);
  QVERIFY(back->exported == exported);
}

void TestSessionJson::segmentsAreInSlicesAloneWhereASessionSaysSo_data() {
  QTest::addColumn<std::optional<bool>>("says");
  QTest::newRow("in 3D, too") << std::optional(true);
  QTest::newRow("in slices alone") << std::optional(false);
  QTest::newRow("a session of before") << std::optional<bool>();
}

void TestSessionJson::segmentsAreInSlicesAloneWhereASessionSaysSo() {
  QFETCH(std::optional<bool>, says);
  Json session = plainSession();
  Json map = {{"series", 0}, {"labels", std::string(40, 'a')}};
  if (says) map["in3d"] = *says;
  session["segmentMaps"] = Json::array({map});
  const auto read = sessionFromJson(session.dump(), {});
  QVERIFY2(read, qPrintable(whyNoSession(session.dump())));
  QCOMPARE(read->workspace.segmentMaps.front().in3d, says.value_or(true));
}

void TestSessionJson::stepsThatCannotBeReadAreLeftOutWithTheirRecord_data() {
  QTest::addColumn<QString>("step");  // follows a readable step
  QTest::addColumn<QString>("why");   // empty if it is readable too
  const auto row = [](const char* name, const char* step, const char* why) {
    QTest::newRow(name) << QString::fromLatin1(step) << QString::fromLatin1(why);
  };
  row("all can be read", R"({"step": "grow", "segment": "1"})", "");
  row("a kind of a newer program", R"({"step": "thaw", "segment": "1"})", "\"thaw\" is no step");
  row("an unknown field", R"({"step": "grow", "segment": "1", "slowly": true})",
      "steps[1].slowly is unknown");
  row("a number out of range", R"({"step": "grow", "segment": "1", "radiusMm": -1})",
      "steps[1].radiusMm must be");
  row("no object", "7", "steps[1] must be");
}

// Only the map with that step loses its steps. The rest of the session is read.
void TestSessionJson::stepsThatCannotBeReadAreLeftOutWithTheirRecord() {
  QFETCH(QString, step);
  QFETCH(QString, why);
  Json session = plainSession();
  Json map = {{"series", 0}, {"labels", std::string(40, 'a')}};
  map["segments"] = Json::array({{{"number", 1}, {"label", "Bone"}}});
  map["steps"] = Json::array({{{"step", "range"}, {"segment", "1"}, {"low", 300}}});
  Json whole = map;
  whole["number"] = 1;
  map["steps"].push_back(Json::parse(step.toStdString()));
  map["number"] = 4;
  session["segmentMaps"] = Json::array({map, whole});
  const auto read = sessionFromJson(session.dump(), {});
  QVERIFY2(read, qPrintable(whyNoSession(session.dump())));
  const SharedList<SegmentMap>& maps = read->workspace.segmentMaps;
  QCOMPARE(maps.size(), std::size_t(2));
  QCOMPARE(maps[0].steps.size(), std::size_t(why.isEmpty() ? 2 : 0));
  QCOMPARE(maps[1].steps.size(), std::size_t(1));
  QCOMPARE(maps[0].segments.front().label, std::string("Bone"));
  QCOMPARE(read->unreadSteps.size(), std::size_t(why.isEmpty() ? 0 : 1));
  if (why.isEmpty()) return;
  QVERIFY(read->unreadSteps.front().series == maps[0].series);
  QCOMPARE(read->unreadSteps.front().map, 4);
  const QString told = QString::fromStdString(read->unreadSteps.front().why);
  QVERIFY2(told.contains(why) && told.endsWith(QLatin1Char('.')), qPrintable(told));
}

// Older sessions have one map without a number. If there are several, the first is active.
void TestSessionJson::aSeriesHasSeveralMapsOfSegments() {
  const auto read = [](const Json& maps) {
    Json session = plainSession();
    session["segmentMaps"] = maps;
    const auto opened = sessionFromJson(session.dump(), {});
    return opened ? opened->workspace : Workspace();
  };
  const auto refused = [](const Json& maps) {
    Json session = plainSession();
    session["segmentMaps"] = maps;
    return whyNoSession(session.dump());
  };
  const Json plain = {{"series", 0}, {"labels", std::string(40, 'a')}};
  Json other = {{"series", 0}, {"labels", std::string(40, 'b')}, {"number", 2}};
  QCOMPARE(read(Json::array({plain})).segmentMaps.front().number, 0);
  const Workspace both = read(Json::array({other, plain}));
  const SeriesKey key = both.series.begin()->first;
  QCOMPARE(both.segmentMaps.size(), std::size_t(2));
  QCOMPARE(segmentMapOf(both, key)->number, 2);
  QCOMPARE(segmentMapsOf(both, key).front()->number, 0);
  QVERIFY(segmentMapOf(both, key, 2) == segmentMapOf(both, key) && !segmentMapOf(both, key, 1));
  other["in3d"] = false;
  QVERIFY2(refused(Json::array({plain, other})).contains(QStringLiteral("of the other maps")),
           "another look");
  other["in3d"] = true, other["number"] = 0;
  QVERIFY2(refused(Json::array({plain, other})).contains(QStringLiteral("is there twice")), "one number");
  other["number"] = -1;
  QVERIFY2(!refused(Json::array({other})).isEmpty(), "below 0");
}

void TestSessionJson::pathsAreAlsoRelativeToTheSession_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("relative");
  QTest::newRow("below") << QStringLiteral("/data/a/ct") << QStringLiteral("a/ct");
  QTest::newRow("beside") << QStringLiteral("/other/ct") << QStringLiteral("../other/ct");
  QTest::newRow("the folder itself") << QStringLiteral("/data") << QStringLiteral(".");
}

void TestSessionJson::pathsAreAlsoRelativeToTheSession() {
  QFETCH(QString, path);
  QFETCH(QString, relative);
  Series series;
  series.path = path.toStdString();
  const std::string text = *sessionToJson(withSeries({}, sceneViewId, series, {}), sessionFolder);
  const Json entry = Json::parse(text).at("series").at(0);
  QCOMPARE(QString::fromStdString(entry.at("path")), path);
  QCOMPARE(QString::fromStdString(entry.at("relativePath")), relative);
}

VOLUMEN_TEST(TestSessionJson);
#include "tst_session_json.moc"
