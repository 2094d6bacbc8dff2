// Guards design.md 11: an invalid session is refused in a sentence that names the field. None is written that
// would be refused.
#include <cmath>
#include <limits>

#include "tests/unit/suite.h"
#include "tests/unit/workspace/plain_session.h"

using namespace volumen;
using volumen::tests::plainSession;
using volumen::tests::sessionFolder;
using volumen::tests::whyNoSession;
using Json = nlohmann::ordered_json;

class TestSessionRefusals : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void refusalsNameTheField_data();
  void refusalsNameTheField();
  void everyFieldRefusesOtherTypes();
  void hostileTextsAreRefused_data();
  void hostileTextsAreRefused();
  void whatCannotBeReadIsNotWritten_data();
  void whatCannotBeReadIsNotWritten();
};

void TestSessionRefusals::refusalsNameTheField_data() {
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

void TestSessionRefusals::refusalsNameTheField() {
  QFETCH(QString, pointer);
  QFETCH(QString, value);
  QFETCH(QString, sentence);
  Json session = plainSession();
  QCOMPARE(whyNoSession(session.dump()), QString());
  session[Json::json_pointer(pointer.toStdString())] = Json::parse(value.toStdString());
  const QString refused = whyNoSession(session.dump());
  QVERIFY2(refused.contains(sentence), qPrintable(refused));
  QVERIFY2(refused.endsWith(QLatin1Char('.')), "a sentence");
}

// Replaces each value of a session by one of every other type.
void TestSessionRefusals::everyFieldRefusesOtherTypes() {
  const Json session = plainSession();
  const Json values[] = {true, 1e300, "text", Json::array({nullptr}), Json::object({{"x", 1}})};
  int fields = 0;
  const Json flat = session.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (value.is_null()) continue;
    ++fields;
    for (const Json& wrong : values) {
      if (wrong.type() == value.type() || (wrong.is_number() && value.is_number())) continue;
      // a word, which is checked elsewhere
      if (pointer.ends_with("/background") && wrong.is_string()) continue;
      Json changed = session;
      changed[Json::json_pointer(pointer)] = wrong;
      QVERIFY2(!whyNoSession(changed.dump()).isEmpty(),
               qPrintable(QString::fromStdString(pointer + wrong.dump())));
    }
  }
  QVERIFY2(fields > 100, qPrintable(QString::number(fields)));
}

void TestSessionRefusals::hostileTextsAreRefused_data() {
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

void TestSessionRefusals::hostileTextsAreRefused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, sentence);
  const QString refused = whyNoSession(text.toStdString());
  QVERIFY2(!refused.isEmpty() && refused.contains(sentence), qPrintable(refused));
  QVERIFY2(refused.size() < 600, "short enough for a line");
}

void TestSessionRefusals::whatCannotBeReadIsNotWritten_data() {
  QTest::addColumn<int>("which");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("infinite zoom") << 0 << QStringLiteral("views[1].flats[0].zoom must be");
  QTest::newRow("NaN in a camera") << 1 << QStringLiteral("views[0].scenes[0].scene: camera.height must be");
  QTest::newRow("a cursor of NaN") << 2 << QStringLiteral("crosshairs[0].at[1] must be");
}

void TestSessionRefusals::whatCannotBeReadIsNotWritten() {
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
  const auto text = sessionToJson(w, sessionFolder);
  QVERIFY(!text);
  QVERIFY2(QString::fromStdString(text.message()).startsWith(sentence), text.message().c_str());
}

VOLUMEN_TEST(TestSessionRefusals);
#include "tst_session_refusals.moc"
