// Guards design.md 11: a session is the workspace as a value, and what is not one is refused in a sentence.
#include <QDir>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/random_workspace.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using volumen::tests::randomWorkspace;
using Json = nlohmann::ordered_json;

namespace {

const std::string folder = "/data";

// Finds the series that the workspace itself holds, where they are what the session says.
FindSeries seriesOf(const Workspace& w) {
  return [&w](const SavedSeries& saved) -> std::shared_ptr<const Series> {
    const auto known = w.series.find(keyOf(saved.series));
    if (known == w.series.end() || known->second.missing || proofOf(*known->second.series) != saved.proof)
      return nullptr;
    return known->second.series;
  };
}

// The session of a window that shows one series.
Json plainSession() {
  Series series;
  series.path = "/data/ct";
  series.id = "1.2.3";
  series.format = "DICOM";
  return Json::parse(*sessionToJson(withSeries({}, sceneViewId, series, {}), folder));
}

QString refusal(const std::string& text) {
  const auto session = sessionFromJson(text, {});
  return session ? QString() : QString::fromStdString(session.message());
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
  void segmentsAreInSlicesAloneWhereASessionSaysSo_data();
  void segmentsAreInSlicesAloneWhereASessionSaysSo();
  void stepsThatCannotBeReadAreLeftOutWithTheirRecord_data();
  void stepsThatCannotBeReadAreLeftOutWithTheirRecord();
  void aSeriesHasSeveralMapsOfSegments();
  void pathsAreAlsoRelativeToTheSession_data();
  void pathsAreAlsoRelativeToTheSession();
  void refusalsNameTheField_data();
  void refusalsNameTheField();
  void everyFieldRefusesOtherTypes();
  void hostileTextsAreRefused_data();
  void hostileTextsAreRefused();
  void whatCannotBeReadIsNotWritten_data();
  void whatCannotBeReadIsNotWritten();
};

void TestSessionJson::workspacesComeBackEqual() {
  const tests::Seeds seeds = tests::seedsOf(330, 1000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    const Workspace w = randomWorkspace(std::uint64_t(seed));
    const auto text = sessionToJson(w, folder);
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
    QVERIFY2(*sessionToJson(back->workspace, folder) == *text,
             qPrintable(QStringLiteral("seed %1").arg(seed)));
  }
}

// Those that were written before there were larger grids.
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
  const Json written = Json::parse(*sessionToJson(large, folder));
  QCOMPARE(written["layout"].get<std::string>(), std::string("3x4"));
  QCOMPARE(written["views"].size(), std::size_t(firstComparedId + 7));
  const auto same = sessionFromJson(written.dump(), {});
  QVERIFY(same && same->workspace == large);
}

// What there was no second window for is written as before, and read as without one.
void TestSessionJson::theSecondWindowComesBack() {
  const Json plain = plainSession();
  QVERIFY(!plain.contains("second"));
  const auto before = sessionFromJson(plain.dump(), {});
  QVERIFY(before && before->workspace.second == SecondWindow());
  Workspace w = withSecondShown({}, true);
  w = withSecondLayout(std::move(w), Layout{Layout::Kind::grid, 2, 3});
  w = withFocus(std::move(w), firstSecondId + 4);
  w.editView(firstSecondId + 5).wanted = "T2";
  const Json written = Json::parse(*sessionToJson(w, folder));
  QCOMPARE(written["second"]["layout"].get<std::string>(), std::string("2x3"));
  QCOMPARE(written["views"].size(), std::size_t(firstSecondId + 6));
  QCOMPARE(written["layout"].get<std::string>(), std::string("one"));
  const auto back = sessionFromJson(written.dump(), {});
  QVERIFY(back && back->workspace == w);
  const Workspace closed = withSecondShown(w, false);
  const auto same = sessionFromJson(*sessionToJson(closed, folder), {});
  QVERIFY2(same && same->workspace == closed, "its views are kept while it is closed");
  QVERIFY(same->workspace.view(firstSecondId + 5).wanted == "T2");
}

void TestSessionJson::bothWindowsShowTheirFocus() {
  Json written = Json::parse(*sessionToJson(withSecondShown({}, true), folder));
  QCOMPARE(refusal(written.dump()), QString());
  written["layout"] = "two";
  QVERIFY(refusal(written.dump()).contains(QStringLiteral("second.mainFocus must be a view of the layout")));
  written["second"]["mainFocus"] = 5;
  QCOMPARE(refusal(written.dump()), QString());
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
  const std::string text = *sessionToJson(w, folder, "/data/s.volumen");
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
  // Saved again, nothing of what proves it is lost.
  QVERIFY(*sessionToJson(back->workspace, folder, "/data/s.volumen") == text);
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
  QVERIFY2(read, qPrintable(refusal(session.dump())));
  QCOMPARE(read->workspace.segmentMaps.front().in3d, says.value_or(true));
}

void TestSessionJson::stepsThatCannotBeReadAreLeftOutWithTheirRecord_data() {
  QTest::addColumn<QString>("step");  // behind one that can be read
  QTest::addColumn<QString>("why");   // empty: it can be read, too
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

// Of the map that has them alone; all else of the session is as it says.
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
  QVERIFY2(read, qPrintable(refusal(session.dump())));
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

// Those of before have one, without a number; of several the first is worked on.
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
    return refusal(session.dump());
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
  const std::string text = *sessionToJson(withSeries({}, sceneViewId, series, {}), folder);
  const Json entry = Json::parse(text).at("series").at(0);
  QCOMPARE(QString::fromStdString(entry.at("path")), path);
  QCOMPARE(QString::fromStdString(entry.at("relativePath")), relative);
}

void TestSessionJson::refusalsNameTheField_data() {
  QTest::addColumn<QString>("pointer");  // RFC 6901
  QTest::addColumn<QString>("value");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* name, const char* pointer, const char* value, const char* sentence) {
    QTest::newRow(name) << QString::fromLatin1(pointer) << QString::fromLatin1(value)
                        << QString::fromLatin1(sentence);
  };
  row("another version", "/volumenSession", "2", "volumenSession must be 1");
  row("unknown at the top", "/hello", "1", "hello is unknown");
  row("unknown in a series", "/series/0/hello", "1", "series[0].hello is unknown");
  row("unknown in a view", "/views/3/hello", "1", "views[3].hello is unknown");
  row("unknown in a look", "/views/1/flats/0/hello", "1", "views[1].flats[0].hello is unknown");
  row("unknown in a scene", "/views/0/scenes/0/scene/hello", "1",
      "views[0].scenes[0].scene: hello is unknown");
  row("a wrong scene", "/views/0/scenes/0/scene/lights/0/intensity", "-1",
      "views[0].scenes[0].scene: lights[0].intensity must be >= 0");
  row("a scene that is a list", "/views/0/scenes/0/scene", "[]",
      "views[0].scenes[0].scene: The JSON must be");
  row("too few views", "/views", "[]", "views must be 8 to 44");
  const QByteArray many = "[" + QByteArray("{},").repeated(44) + "{}]";
  row("too many views", "/views", many.constData(), "views must be 8 to 44");
  row("a flat view in 3D", "/views/1/kind", "\"volume\"", "views[1].kind must not be \"volume\"");
  row("the 3D view flat", "/views/0/kind", "\"axial\"", "views[0].kind must be \"volume\"");
  row("an unknown kind", "/views/1/kind", "\"oblique\"", "views[1].kind must be");
  row("a series that is not there", "/views/0/series", "1",
      "views[0].series must be the number of one of the 1");
  row("a negative series", "/views/0/series", "-1", "views[0].series must be");
  row("half a series", "/views/0/series", "0.5", "views[0].series must be");
  row("a series twice", "/series/-", "{\"path\": \"/data/ct\", \"id\": \"1.2.3\"}",
      "series[1] is there twice");
  row("a look twice", "/views/1/flats/-", "{\"series\": 0}", "views[1].flats[1] is there twice");
  row("no such view", "/focus", "44", "focus must be in 0 .. 43");
  row("a view of a window that is closed", "/focus", "24", "focus must be a view of the layout");
  row("a second window of planes", "/second", "{\"layout\": \"planes\"}", "second.layout must be \"1x1\"");
  row("a main window in the second one", "/second", "{\"mainFocus\": 24}",
      "second.mainFocus must be in 0 .. 23");
  row("unknown in the second window", "/second", "{\"hello\": 1}", "second.hello is unknown");
  row("a view that is not on screen", "/layout", "\"two\"", "focus must be a view of the layout");
  row("an unknown layout", "/layout", "\"five\"", "layout must be \"one\" or");
  row("no zoom", "/views/1/flats/0/zoom", "0", "views[1].flats[0].zoom must be in 0.001");
  row("a huge pan", "/views/1/flats/0/panMm", "[1e300, 0]", "views[1].flats[0].panMm[0] must be in");
  row("a negative slab", "/views/1/flats/0/slabMm", "-1", "views[1].flats[0].slabMm must be in");
  row("a slab of another kind", "/views/1/flats/0/slabMode", "\"sum\"", "slabMode must be \"max\"");
  row("a window of no width", "/series/0/window", "{\"width\": 0}", "series[0].window.width must not be 0");
  row("a grid of no voxels", "/series/0/geometry/sizeI", "0", "series[0].geometry.sizeI must be in");
  row("a cursor of two numbers", "/crosshairs/-", "{\"at\": [1, 2]}",
      "crosshairs[0].at must be a list of 3 numbers");
  row("a cursor in no series", "/crosshairs/-", "{\"frame\": 7}", "crosshairs[0].frame must be the number");
  row("pixels of a million rays", "/goal/level/edge", "1e6", "goal.level.edge must be in");
  row("an outline of half a point", "/series/0/lassos/-", "{\"points\": [0, 0, 1]}",
      "series[0].lassos[0].points must be a list of x, y, x, y");
  row("an outline without end", "/series/0/lassos/-", "{\"points\": [0, 1e300]}",
      "series[0].lassos[0].points[1] must be in");
  row("an outline that is no list", "/series/0/lassos/-", "{\"points\": 7}",
      "series[0].lassos[0].points must be");
  row("a lasso askew", "/series/0/lassos/-", "{\"down\": [1, 0, 0]}",
      "series[0].lassos[0].right and down must be orthogonal unit vectors");
  row("an unknown level", "/goal/level/quality", "\"best\"", "goal.level.quality must be \"draft\"");
}

void TestSessionJson::refusalsNameTheField() {
  QFETCH(QString, pointer);
  QFETCH(QString, value);
  QFETCH(QString, sentence);
  Json session = plainSession();
  QCOMPARE(refusal(session.dump()), QString());
  session[Json::json_pointer(pointer.toStdString())] = Json::parse(value.toStdString());
  const QString refused = refusal(session.dump());
  QVERIFY2(refused.contains(sentence), qPrintable(refused));
  QVERIFY2(refused.endsWith(QLatin1Char('.')), "a sentence");
}

// Each value of a session, in place of which stands one of every other type.
void TestSessionJson::everyFieldRefusesOtherTypes() {
  const Json session = plainSession();
  const Json values[] = {true, 1e300, "text", Json::array({nullptr}), Json::object({{"x", 1}})};
  int fields = 0;
  const Json flat = session.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (value.is_null()) continue;
    ++fields;
    for (const Json& wrong : values) {
      if (wrong.type() == value.type() || (wrong.is_number() && value.is_number())) continue;
      if (pointer.ends_with("/background") && wrong.is_string()) continue;  // a word, which is checked
      Json changed = session;
      changed[Json::json_pointer(pointer)] = wrong;
      QVERIFY2(!refusal(changed.dump()).isEmpty(),
               qPrintable(QString::fromStdString(pointer + wrong.dump())));
    }
  }
  QVERIFY2(fields > 100, qPrintable(QString::number(fields)));
}

void TestSessionJson::hostileTextsAreRefused_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("sentence");
  const QByteArray begin = "{\"volumenSession\": 1, \"series\": ";
  const auto row = [](const char* name, const QByteArray& text, const char* sentence) {
    QTest::newRow(name) << text << QString::fromLatin1(sentence);
  };
  row("empty", "", "Not JSON");
  row("cut off", begin + "[", "Not JSON");
  row("no session", "{}", "volumenSession must be 1");
  row("a list", "[1]", "must be an object");
  row("a number", "1", "must be an object");
  row("nested deeply", begin + QByteArray(1 << 20, '['), "nested too deeply");
  row("objects nested deeply", QByteArray("{\"a\":").repeated(1 << 18), "nested too deeply");
  row("100 MB", begin + QByteArray(100 << 20, ' '), "larger than 8 MiB");
  row("a field twice", "{\"volumenSession\": 1, \"volumenSession\": 1}", "given twice");
  row("a number without end", "{\"volumenSession\": 1" + QByteArray(1 << 20, '0') + "}", "");
  row("an exponent without end", "{\"volumenSession\": 1e" + QByteArray(4000, '9') + "}", "too large");
  row("a million series", begin + "[" + QByteArray("{},").repeated(1 << 20) + "{}]}", "is there twice");
  row("a million views",
      "{\"volumenSession\": 1, \"views\": [" + QByteArray("{},").repeated(1 << 20) + "{}]}",
      "views must be 8");
  row("no UTF-8", begin + "\"\xff\xfe\"}", "Not JSON");
  row("NaN", "{\"volumenSession\": NaN}", "Not JSON");
  row("infinity", "{\"volumenSession\": 1, \"focus\": 1e999}", "too large");
}

void TestSessionJson::hostileTextsAreRefused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, sentence);
  const QString refused = refusal(text.toStdString());
  QVERIFY2(!refused.isEmpty() && refused.contains(sentence), qPrintable(refused));
  QVERIFY2(refused.size() < 600, "short enough for a line");
}

void TestSessionJson::whatCannotBeReadIsNotWritten_data() {
  QTest::addColumn<int>("which");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("infinite zoom") << 0 << QStringLiteral("views[1].flats[0].zoom must be");
  QTest::newRow("NaN in a camera") << 1 << QStringLiteral("views[0].scenes[0].scene: camera.height must be");
  QTest::newRow("a cursor of NaN") << 2 << QStringLiteral("crosshairs[0].at[1] must be");
}

void TestSessionJson::whatCannotBeReadIsNotWritten() {
  QFETCH(int, which);
  QFETCH(QString, sentence);
  Series series;
  series.path = "/data/ct";
  Workspace w = withSeries({}, sceneViewId, series, {});
  const SeriesKey key = keyOf(series);
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  if (which == 0) w.editView(axialViewId).flats.edit(key).zoom = infinity;
  if (which == 1) w.editView(sceneViewId).scenes.edit(key).scene.camera.emplace().height = nan;
  if (which == 2) w.crosshairs.editOrAdd("1.2").at = {0, nan, 0};
  const auto text = sessionToJson(w, folder);
  QVERIFY(!text);
  QVERIFY2(QString::fromStdString(text.message()).startsWith(sentence), text.message().c_str());
}

VOLUMEN_TEST(TestSessionJson);
#include "tst_session_json.moc"
