// Guards picture.md 4 (order of points) and picture.md 8 (why a scene file is refused, and what it may hold).
#include <functional>
#include <limits>

#include "tests/unit/suite.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;

class TestSceneRefusals : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void refusalsNameTheField_data();
  void refusalsNameTheField();
  void whatIsNoJsonIsRefusedWithItsPlace_data();
  void whatIsNoJsonIsRefusedWithItsPlace();
  void limitsAreInside_data();
  void limitsAreInside();
  void scenesMadeInCodeFollowTheSameRules();
};

namespace {

// Returns the message of a refusal; empty if the text is accepted.
QString refusal(const QByteArray& json) {
  const auto scene = sceneFromJson(json.toStdString());
  return scene.ok() ? QString() : QString::fromStdString(scene.message());
}

QByteArray points(int count) {
  QByteArray all;
  for (int n = 0; n < count; ++n)
    all += (n ? ", " : "") + QByteArray("{\"value\": ") + QByteArray::number(n) + "}";
  return "{\"transferFunction\": {\"points\": [" + all + "]}}";
}

QByteArray repeated(const char* before, const char* item, int count, const char* after) {
  QByteArray all = before;
  for (int n = 0; n < count; ++n) all += (n ? ", " : "") + QByteArray(item);
  return all + after;
}

void row(const char* name, const QByteArray& json, const char* sentence = "") {
  QTest::newRow(name) << json << QString::fromUtf8(sentence);
}

}  // namespace

void TestSceneRefusals::refusalsNameTheField_data() {
  QTest::addColumn<QByteArray>("json");
  QTest::addColumn<QString>("sentence");
  row("no object", "[1]", "The JSON must be an object, not a list.");
  row("other version", R"({"volumenScene": 2})", "volumenScene must be 1, the version of the format, not 2.");
  row("a million lights", repeated("{\"lights\": [", "{}", 1000000, "]}"),
      "lights must hold 0 to 64 lights, not 1000000.");
  row("unknown at the top", R"({"colour": 1})",
      "colour is unknown; the fields here are volumenScene, mode, window, transferFunction, shading, lights, "
      "camera, clip, background.");
  row("unknown in a light", R"({"lights": [{}, {"intensty": 1}]})",
      "lights[1].intensty is unknown; the fields here are direction, space, colour, intensity, on.");
  row("unknown in the window", R"({"window": {"center": 4}})",
      "window.center is unknown; the fields here are centre, width.");
  row("unknown in the curve", R"({"transferFunction": {"unit": 1}})", "transferFunction.unit is unknown");
  row("unknown in a point", R"({"transferFunction": {"points": [{"v": 1}]}})",
      "transferFunction.points[0].v is unknown");
  row("unknown in gradient opacity", R"({"transferFunction": {"gradientOpacity": [{"value": 1}]}})",
      "transferFunction.gradientOpacity[0].value is unknown");
  row("unknown in shading", R"({"shading": {"power": 1}})", "shading.power is unknown");
  row("unknown in camera", R"({"camera": {"zoom": 1}})", "camera.zoom is unknown");
  row("unknown in clip", R"({"clip": {"boxes": []}})", "clip.boxes is unknown");
  row("unknown in a plane", R"({"clip": {"planes": [{"distance": 1}]}})",
      "clip.planes[0].distance is unknown");
  row("duplicate at the top", R"({"mode": "mip", "mode": "mip"})", "mode is given twice.");
  row("duplicate deep below", R"({"lights": [{}, {"on": true, "on": true}]})",
      "lights[1].on is given twice.");

  row("text for a number", R"({"lights": [{"intensity": "1"}]})",
      "lights[0].intensity must be a number, not a text.");
  row("bool for a number", R"({"shading": {"ambient": true}})",
      "shading.ambient must be a number, not true or false.");
  row("null for a number", R"({"shading": {"ambient": null}})",
      "shading.ambient must be a number, not null.");
  row("number for a bool", R"({"shading": {"lit": 1}})", "shading.lit must be true or false, not a number.");
  row("number for a word", R"({"mode": 1})", "mode must be a text, not a number.");
  row("unknown word", R"({"mode": "MIP"})",
      R"(mode must be "composite" or "mip" or "minip" or "average", not "MIP".)");
  row("empty word", R"({"lights": [{"space": ""}]})",
      R"(lights[0].space must be "camera" or "patient", not "".)");
  row("object for a list", R"({"lights": {}})", "lights must be a list, not an object.");
  row("number for an object", R"({"lights": [1]})", "lights[0] must be an object, not a number.");
  row("list for an object", R"({"shading": []})", "shading must be an object, not a list.");
  row("null shading", R"({"shading": null})", "shading must be an object, not null.");
  row("two numbers for three", R"({"camera": {"up": [0, 1]}})",
      "camera.up must be a list of 3 numbers, not of 2.");
  row("text among numbers", R"({"camera": {"up": [0, "1", 0]}})",
      "camera.up[1] must be a number, not a text.");
  row("sides 1.5", R"({"shading": {"sides": 1.5}})", "shading.sides must be a small whole number, not 1.5.");
  row("box of two", R"({"clip": {"box": [[0, 1], [0, 1]]}})",
      "clip.box must be a list of three [low, high] pairs.");
  row("box of triples", R"({"clip": {"box": [[0, 1], [0, 1, 2], [0, 1]]}})",
      "clip.box[1] must be a list of 2 numbers, not of 3.");
  row("background word", R"({"background": "white"})",
      R"(background must be a colour or "transparent", not "white".)");

  row("sides 3", R"({"shading": {"sides": 3}})", "shading.sides must be 1 or 2, not 3.");
  row("negative intensity", R"({"lights": [{}, {}, {"intensity": -1}]})",
      "lights[2].intensity must be >= 0, not -1.");
  row("negative ambient", R"({"shading": {"ambient": -0.5}})", "shading.ambient must be >= 0, not -0.5.");
  row("negative diffuse", R"({"shading": {"diffuse": -1}})", "shading.diffuse must be >= 0, not -1.");
  row("negative specular", R"({"shading": {"specular": -1}})", "shading.specular must be >= 0, not -1.");
  row("shininess 0.9", R"({"shading": {"shininess": 0.9}})",
      "shading.shininess must be in 1 .. 10000, not 0.9.");
  row("shininess 10001", R"({"shading": {"shininess": 10001}})",
      "shading.shininess must be in 1 .. 10000, not 10001.");
  row("gradient floor 0", R"({"shading": {"gradientFloor": 0}})",
      "shading.gradientFloor must be > 0, not 0.");
  row("window width 0", R"({"window": {"width": 0}})", "window.width must not be 0.");
  row("unit distance 0", R"({"transferFunction": {"unitDistance": 0}})",
      "transferFunction.unitDistance must be > 0, not 0.");
  row("no points", R"({"transferFunction": {"points": []}})",
      "transferFunction.points must hold 1 to 256 points, not 0.");
  row("257 points", points(257), "transferFunction.points must hold 1 to 256 points, not 257.");
  row("points out of order", R"({"transferFunction": {"points": [{"value": 120}, {"value": 90}]}})",
      "transferFunction.points[1].value must not be below transferFunction.points[0].value = 120, but is "
      "90.");
  row("point beyond float32", R"({"transferFunction": {"points": [{"value": 1e39}]}})",
      "transferFunction.points[0].value must be within what float32 holds, not 1e+39.");
  row("point colour 1.5", R"({"transferFunction": {"points": [{"colour": [0, 0, 1.5]}]}})",
      "transferFunction.points[0].colour[2] must be in 0 .. 1, not 1.5.");
  row("opacity 2", R"({"transferFunction": {"points": [{"opacity": 2}]}})",
      "transferFunction.points[0].opacity must be in 0 .. 1, not 2.");
  row("opacity -0.1", R"({"transferFunction": {"points": [{"opacity": -0.1}]}})",
      "transferFunction.points[0].opacity must be in 0 .. 1, not -0.1.");
  row("257 gradient points", repeated(R"({"transferFunction": {"gradientOpacity": [)", "{}", 257, "]}}"),
      "transferFunction.gradientOpacity must hold 0 to 256 points, not 257.");
  row("gradients out of order",
      R"({"transferFunction": {"gradientOpacity": [{"gradient": 2}, {"gradient": 1}]}})",
      "transferFunction.gradientOpacity[1].gradient must not be below "
      "transferFunction.gradientOpacity[0].gradient = 2, but is 1.");
  row("factor 1.1", R"({"transferFunction": {"gradientOpacity": [{"factor": 1.1}]}})",
      "transferFunction.gradientOpacity[0].factor must be in 0 .. 1, not 1.1.");
  row("65 lights", repeated(R"({"lights": [)", R"({"on": false})", 65, "]}"),
      "lights must hold 0 to 64 lights, not 65.");
  row("light from nowhere", R"({"lights": [{"direction": [0, 0, 0]}]})",
      "lights[0].direction must not be zero.");
  row("light colour", R"({"lights": [{"colour": [0, -1, 0]}]})",
      "lights[0].colour[1] must be in 0 .. 1, not -1.");
  row("camera without direction", R"({"camera": {"direction": [0, 0, 0]}})",
      "camera.direction must not be zero.");
  row("up is zero", R"({"camera": {"up": [0, 0, 0]}})", "camera.up must not be zero.");
  row("up along direction", R"({"camera": {"direction": [1, 2, 3], "up": [2, 4, 6]}})",
      "camera.up is parallel to camera.direction.");
  row("up against direction", R"({"camera": {"direction": [0, 0, -1]}})",
      "camera.up is parallel to camera.direction.");
  row("height 0", R"({"camera": {"height": 0}})", "camera.height must be > 0, not 0.");
  row("distance next to nothing", R"({"camera": {"distance": 1e-300}})",
      "camera.distance must be in 1e-30 .. 1e+30, not 1e-300.");
  row("distance -1", R"({"camera": {"distance": -1}})", "camera.distance must be > 0, not -1.");
  row("fov 0.09", R"({"camera": {"fov": 0.09}})", "camera.fov must be in 0.1 .. 170, not 0.09.");
  row("fov 171", R"({"camera": {"fov": 171}})", "camera.fov must be in 0.1 .. 170, not 171.");
  row("projection", R"({"camera": {"projection": "orthographic"}})",
      R"(camera.projection must be "parallel" or "perspective", not "orthographic".)");
  row("box upside down", R"({"clip": {"box": [[0, 1], [0.7, 0.2], [0, 1]]}})",
      "clip.box[1] must be [low, high] with 0 <= low <= high <= 1, not [0.7, 0.2].");
  row("box beyond 1", R"({"clip": {"box": [[0, 1], [0, 1], [0, 1.5]]}})",
      "clip.box[2] must be [low, high] with 0 <= low <= high <= 1, not [0, 1.5].");
  row("7 planes", repeated(R"({"clip": {"planes": [)", "{}", 7, "]}}"),
      "clip.planes must hold 0 to 6 planes, not 7.");
  row("plane without normal", R"({"clip": {"planes": [{"normal": [0, 0, 0]}]}})",
      "clip.planes[0].normal must not be zero.");
  row("background 2", R"({"background": [0, 2, 0]})", "background[1] must be in 0 .. 1, not 2.");
}

void TestSceneRefusals::refusalsNameTheField() {
  QFETCH(QByteArray, json);
  QFETCH(QString, sentence);
  const QString said = refusal(json);
  QVERIFY2(said.startsWith(sentence) && said.endsWith(QLatin1Char('.')), said.toUtf8().constData());
}

void TestSceneRefusals::whatIsNoJsonIsRefusedWithItsPlace_data() {
  QTest::addColumn<QByteArray>("json");
  QTest::addColumn<QString>("sentence");
  row("empty", "", "Not JSON at line 1, column 1: ");
  row("missing value", "{\n  \"mode\": }", "Not JSON at line 2, column 11: ");
  row("a comment", "{\n  // said here\n}", "Not JSON at line 2, column 3: ");
  row("trailing comma", "{\"mode\": \"mip\",}", "Not JSON at line 1, column 16: ");
  row("something behind", "{} {}", "Not JSON at line 1, column 4: ");
  row("single quotes", "{'mode': 'mip'}", "Not JSON at line 1, column 2: ");
  row("NaN", "{\"shading\": {\"ambient\": NaN}}", "Not JSON at line 1, column 25: ");
  row("no UTF-8", "{\"mode\": \"\xff\"}", "Not JSON at line 1, column 11: ");
  row("beyond double", "{\"shading\": {\"ambient\": 1e999}}",
      "Not JSON at line 1, column 29: shading.ambient is too large.");
  row("beyond double in a list", "{\"lights\":\n [{}, {\"intensity\": 1e400}]}",
      "Not JSON at line 2, column 25: lights[1].intensity is too large.");
  row("cut in the middle", "{\"lights\": [{\"intensity\": 1", "Not JSON at line 1, column ");
  row("deep lists", QByteArray(2000000, '['), "The JSON is nested too deeply.");
  row("deep objects, all closed", QByteArray("{\"a\":").repeated(200000) + "1" + QByteArray(200000, '}'),
      "The JSON is nested too deeply.");
  row("5 MiB of blanks", QByteArray(5 << 20, ' '), "The JSON is larger than 4 MiB.");
}

void TestSceneRefusals::whatIsNoJsonIsRefusedWithItsPlace() { refusalsNameTheField(); }

void TestSceneRefusals::limitsAreInside_data() {
  QTest::addColumn<QByteArray>("json");
  QTest::addColumn<QString>("sentence");
  row("nothing", "{}");
  row("blanks and BOM", "\xef\xbb\xbf {} \n");
  row("256 points", points(256));
  row("equal values", R"({"transferFunction": {"points": [{"value": 1}, {"value": 1}, {"value": 1}]}})");
  row("256 gradient points", repeated(R"({"transferFunction": {"gradientOpacity": [)", "{}", 256, "]}}"));
  row("64 lights", repeated(R"({"lights": [)", "{}", 64, "]}"));
  row("no lights", R"({"lights": []})");
  row("6 planes", repeated(R"({"clip": {"planes": [)", "{}", 6, "]}}"));
  row("empty box", R"({"clip": {"box": [[0.5, 0.5], [0, 0], [1, 1]]}})");
  row("zero light", R"({"lights": [{"intensity": 0, "colour": [0, 0, 0]}]})");
  row("no reflection", R"({"shading": {"ambient": 0, "diffuse": 0, "specular": 0}})");
  row("bright", R"({"shading": {"ambient": 3}, "lights": [{"intensity": 1000}]})");
  row("shininess ends", R"({"shading": {"shininess": 1}})");
  row("shininess other end", R"({"shading": {"shininess": 10000}})");
  row("fov ends", R"({"camera": {"fov": 0.1}})");
  row("fov other end", R"({"camera": {"fov": 170}})");
  row("nulls", R"({"camera": null, "window": null, "shading": {"gradientFloor": null}})");
  row("target null", R"({"camera": {"target": null}})");
  row("transparent", R"({"background": "transparent"})");
  row("whole numbers as fractions", R"({"volumenScene": 1.0, "shading": {"sides": 1.0}})");
  row("negative gradient", R"({"transferFunction": {"gradientOpacity": [{"gradient": -1}]}})");
  row("largest float32", R"({"transferFunction": {"points": [{"value": 3.4028234663852886e38}]}})");
}

void TestSceneRefusals::limitsAreInside() {
  QFETCH(QByteArray, json);
  QFETCH(QString, sentence);
  QCOMPARE(refusal(json), sentence);
}

void TestSceneRefusals::scenesMadeInCodeFollowTheSameRules() {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto refused = [](const std::function<void(Scene&)>& change, const char* field) {
    Scene scene;
    scene.camera = Camera{};
    change(scene);
    const Status status = validateScene(scene);
    return !status.ok() && status.message().starts_with(field);
  };
  QVERIFY(validateScene(Scene{}).ok());
  QVERIFY(refused([&](Scene& s) { s.shading.ambient = nan; }, "shading.ambient"));
  QVERIFY(refused([&](Scene& s) { s.shading.shininess = nan; }, "shading.shininess"));
  QVERIFY(refused([&](Scene& s) { s.transferFunction.points[1].value = float(inf); },
                  "transferFunction.points[1].value"));
  QVERIFY(refused([&](Scene& s) { s.transferFunction.points[0].value = float(nan); },
                  "transferFunction.points[0].value"));
  QVERIFY(refused([&](Scene& s) { s.camera->target = {0, nan, 0}; }, "camera.target[1]"));
  QVERIFY(refused([&](Scene& s) { s.camera->height = inf; }, "camera.height"));
  QVERIFY(refused([&](Scene& s) { s.camera->direction = {1e200, 0, 0}; }, "camera.direction"));
  QVERIFY(refused([&](Scene& s) { s.lights[0].direction = {0, inf, 0}; }, "lights[0].direction[1]"));
  QVERIFY(refused([&](Scene& s) { s.clip.boxLow.y = nan; }, "clip.box[1]"));
  QVERIFY(refused([&](Scene& s) { s.clip.planes = {{{0, 0, 1}, inf}}; }, "clip.planes[0].offset"));
  QVERIFY(refused([&](Scene& s) { s.background.colour.z = nan; }, "background[2]"));
  QVERIFY(refused([&](Scene& s) { s.window = Window{nan, 1}; }, "window.centre"));
}

VOLUMEN_TEST(TestSceneRefusals);
#include "tst_scene_refusals.moc"
