// Guards picture.md 4 (values are float32), picture.md 7 (directions) and picture.md 8 (scene file: fields,
// defaults, writing).
#include <QDir>
#include <QFile>
#include <random>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;
using namespace volumen::tests;

class TestSceneJson : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void missingFieldsHaveTheirDefaults();
  void theSceneOfThePageLoads();
  void everyFieldIsRead();
  void pointValuesAreRoundedToFloat();
  void hugeDirectionsKeepTheirDirection();
  void randomScenesComeBackEqual();
  void theTextOfASceneIsFixed();
  void benchScenesLoad();
};

void TestSceneJson::missingFieldsHaveTheirDefaults() {
  QCOMPARE(*sceneFromJson("{}") == Scene{}, true);
  QCOMPARE(*sceneFromJson(R"({"camera": null})") == *sceneFromJson("{}"), true);
  const Scene s = *sceneFromJson(
      R"({"transferFunction": {"points": [{}], "gradientOpacity": [{}]}, "lights": [{}], "camera": {},
          "window": {}, "clip": {"planes": [{}]}})");
  QVERIFY((s.transferFunction.points == std::vector<CurvePoint>{{150, {0.9, 0.8, 0.7}, 0}}));
  QVERIFY((s.transferFunction.gradientOpacity == std::vector<GradientOpacityPoint>{{0, 1}}));
  QVERIFY(s.lights == std::vector<Light>{Light{}});
  QVERIFY(s.camera == Camera{});
  QVERIFY(s.window == (Window{40, 400}));
  QVERIFY((s.clip.planes == std::vector<ClipPlane>{{{0, 0, 1}, 50}}));
}

// Loads the scene of resources/docs/picture.md 8, with all its defaults.
void TestSceneJson::theSceneOfThePageLoads() {
  const QString page =
      QString::fromUtf8(contentsOf(QStringLiteral(VOLUMEN_SOURCE_DIR "/resources/docs/picture.md")));
  const qsizetype begin = page.indexOf(QLatin1String("    {\n")),
                  end = page.indexOf(QLatin1String("\n    }\n"), begin);
  QVERIFY(begin >= 0 && end > begin);
  const auto read = sceneFromJson(page.mid(begin, end + 6 - begin).toStdString());
  QVERIFY2(read.ok(), read.ok() ? "" : read.message().c_str());
  Scene expected;
  expected.window = Window{40, 400};
  expected.transferFunction.gradientOpacity = {{0, 1}};
  expected.camera = Camera{.target = glm::dvec3(0)};
  expected.clip.planes = {{{0, 0, 1}, 50}};
  QVERIFY(*read == expected);
}

void TestSceneJson::everyFieldIsRead() {
  const auto read = sceneFromJson(R"({
  "mode": "minip", "window": {"centre": -600.5, "width": 1500},
  "transferFunction": {"unitDistance": 0.5,
    "points": [{"value": -2, "colour": [0.1, 0.2, 0.3], "opacity": 0.4}, {"value": 7}],
    "gradientOpacity": [{"gradient": 3, "factor": 0.25}]},
  "shading": {"lit": false, "sides": 1, "localViewer": true, "gradientFloor": 2.5,
              "ambient": 0.3, "diffuse": 0.4, "specular": 0.5, "shininess": 60},
  "lights": [{"direction": [1, 2, 3], "space": "patient", "colour": [0.5, 0.6, 0.7], "intensity": 2, "on": false}],
  "camera": {"target": [1, 2, 3], "direction": [1, 0, 0], "up": [0, 1, 0],
             "projection": "perspective", "height": 10, "fov": 45, "distance": 20},
  "clip": {"box": [[0.1, 0.9], [0.2, 0.8], [0.3, 0.7]], "planes": [{"normal": [0, 2, 0], "offset": -5}]},
  "background": [0.25, 0.5, 0.75]
})");
  QVERIFY2(read.ok(), read.ok() ? "" : read.message().c_str());
  Scene e;
  e.mode = Mode::minip;
  e.window = Window{-600.5, 1500};
  e.transferFunction = {0.5, {{-2, {0.1, 0.2, 0.3}, 0.4}, {7, {0.9, 0.8, 0.7}, 0}}, {{3, 0.25}}};
  e.shading = {false, 1, true, 2.5, 0.3, 0.4, 0.5, 60};
  e.lights = {{{1, 2, 3}, Space::patient, {0.5, 0.6, 0.7}, 2, false}};
  e.camera = Camera{glm::dvec3(1, 2, 3), {1, 0, 0}, {0, 1, 0}, Projection::perspective, 10, 45, 20};
  e.clip = {{0.1, 0.2, 0.3}, {0.9, 0.8, 0.7}, {{{0, 2, 0}, -5}}};
  e.background = {false, {0.25, 0.5, 0.75}};
  QVERIFY(*read == e);
}

void TestSceneJson::pointValuesAreRoundedToFloat() {
  const Scene s =
      *sceneFromJson(R"({"transferFunction": {"points": [{"value": 0.1}, {"value": 16777217}]}})");
  QCOMPARE(s.transferFunction.points[0].value, 0.1f);
  QCOMPARE(s.transferFunction.points[1].value, 16777216.0f);
}

void TestSceneJson::hugeDirectionsKeepTheirDirection() {
  const auto s = sceneFromJson(R"({"camera": {"direction": [3e300, 0, 4e300], "up": [0, 1e-300, 0]}})");
  QVERIFY2(s.ok(), s.ok() ? "" : s.message().c_str());
  const CameraAxes axes = cameraAxes(*s->camera);
  QVERIFY(std::abs(axes.direction.x - 0.6) < 1e-12 && std::abs(axes.direction.z - 0.8) < 1e-12);
  QVERIFY(std::abs(axes.up.y - 1) < 1e-12);
}

namespace {

// Makes scenes with numbers of all magnitudes and full precision.
class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : bits_(seed) {}

  Scene make() {
    Scene s;
    s.mode = Mode(below(4));
    if (below(2)) s.window = Window{any(), positive()};
    s.transferFunction = {positive(), {}, {}};
    std::vector<float> values(1 + below(20));
    for (float& v : values) v = float(any());
    std::sort(values.begin(), values.end());
    for (float v : values) s.transferFunction.points.push_back({v, colour(), unit()});
    std::vector<double> gradients(below(5));
    for (double& g : gradients) g = any();
    std::sort(gradients.begin(), gradients.end());
    for (double g : gradients) s.transferFunction.gradientOpacity.push_back({g, unit()});
    s.shading = {below(2) == 0, 1 + int(below(2)), below(2) == 0, {}, unit(), unit(), unit(), 1 + unit()};
    if (below(2)) s.shading.gradientFloor = positive();
    s.lights.resize(below(5));
    for (Light& l : s.lights) l = {vector(), Space(below(2)), colour(), positive(), below(2) == 0};
    if (below(4)) {
      s.camera = Camera{{},
                        {any(), unit() + 0.1, unit()},
                        {unit(), 0, 3},
                        Projection(below(2)),
                        positive(),
                        0.1 + unit(),
                        positive()};
      if (below(2)) s.camera->target = vector();
    }
    for (int a = 0; a < 3; ++a) {
      s.clip.boxLow[a] = unit();
      s.clip.boxHigh[a] = std::max(unit(), s.clip.boxLow[a]);
    }
    s.clip.planes.resize(below(7));
    for (ClipPlane& p : s.clip.planes) p = {vector(), any()};
    s.background = {below(2) == 0, colour()};
    return s;
  }

 private:
  std::mt19937_64 bits_;
  std::size_t below(std::size_t n) { return bits_() % n; }
  double unit() { return std::uniform_real_distribution<double>(0, 1)(bits_); }
  double positive() { return std::exp2(std::uniform_real_distribution<double>(-60, 60)(bits_)); }
  double any() { return (below(2) ? 1 : -1) * positive(); }
  glm::dvec3 colour() { return {unit(), unit(), unit()}; }
  glm::dvec3 vector() { return {any(), any(), any()}; }
};

}  // namespace

void TestSceneJson::randomScenesComeBackEqual() {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const Scene scene = RandomScene(seed).make();
    QVERIFY(validateScene(scene).ok());
    const std::string text = sceneToJson(scene);
    const auto back = sceneFromJson(text);
    QVERIFY2(back.ok(), back.ok() ? "" : back.message().c_str());
    QVERIFY2(*back == scene, text.c_str());
    QCOMPARE(sceneToJson(*back), text);
  }
}

void TestSceneJson::theTextOfASceneIsFixed() {
  Scene scene;
  scene.window = Window{-600.5, 1500};
  scene.transferFunction = {1.0, {{-0.1f, {0.1, 0.2, 0.3}, 0.7}, {3000, {1, 1, 1}, 0}}, {{3, 0.25}}};
  scene.shading.gradientFloor = 2.5;
  scene.lights.push_back({{1, -2, 3e-9}, Space::patient, {0.5, 0.6, 0.7}, 2, false});
  scene.camera = Camera{{}, {1, 0, 0}, {0, 1, 0}, Projection::perspective, 10, 45, 20};
  scene.clip = {{0.1, 0, 0}, {0.9, 1, 1}, {{{0, 2, 0}, -5}, {{1, 0, 0}, 7}}};
  scene.background.transparent = true;
  QCOMPARE(QString::fromStdString(sceneToJson(scene)), QStringLiteral(R"({
  "volumenScene": 1,
  "mode": "composite",
  "window": {"centre": -600.5, "width": 1500},
  "transferFunction": {
    "unitDistance": 1,
    "points": [
      {"value": -0.1, "colour": [0.1, 0.2, 0.3], "opacity": 0.7},
      {"value": 3000, "colour": [1, 1, 1], "opacity": 0}
    ],
    "gradientOpacity": [
      {"gradient": 3, "factor": 0.25}
    ]
  },
  "shading": {"lit": true, "sides": 2, "localViewer": false, "gradientFloor": 2.5,
              "ambient": 0.2, "diffuse": 0.7, "specular": 0.2, "shininess": 20},
  "lights": [
    {"direction": [0, 0, 1], "space": "camera", "colour": [1, 1, 1], "intensity": 1, "on": true},
    {"direction": [1, -2, 3e-09], "space": "patient", "colour": [0.5, 0.6, 0.7], "intensity": 2, "on": false}
  ],
  "camera": {"target": null, "direction": [1, 0, 0], "up": [0, 1, 0],
             "projection": "perspective", "height": 10, "fov": 45, "distance": 20},
  "clip": {"box": [[0.1, 0.9], [0, 1], [0, 1]],
           "planes": [
             {"normal": [0, 2, 0], "offset": -5},
             {"normal": [1, 0, 0], "offset": 7}
           ]},
  "background": "transparent"
}
)"));
  const QString plain = QString::fromStdString(sceneToJson(Scene{}));
  for (const char* part : {"\"window\": null,", "\"gradientOpacity\": []\n  },", "\"gradientFloor\": null,",
                           "\"planes\": []},", "\"background\": [0, 0, 0]\n}\n"})
    QVERIFY2(plain.contains(QLatin1String(part)), part);
}

void TestSceneJson::benchScenesLoad() {
  const std::string folder = dataPath("bench-scenes");
  NEED_DATA(folder);
  const auto files = QDir(QString::fromStdString(folder)).entryInfoList({QStringLiteral("*.json")});
  QVERIFY(!files.isEmpty());
  for (const QFileInfo& info : files) {
    QFile file(info.filePath());
    QVERIFY(file.open(QFile::ReadOnly));
    const auto scene = sceneFromJson(file.readAll().toStdString());
    QVERIFY2(scene.ok(), scene.ok() ? "" : scene.message().c_str());
  }
}

VOLUMEN_TEST(TestSceneJson);
#include "tst_scene_json.moc"
