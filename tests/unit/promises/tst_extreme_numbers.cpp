// Guards design.md 2 (finite): pictures, error maps and texts never hold NaN or infinity, whatever numbers a
// valid scene holds. Draws VOLUMEN_RANDOM_CASES=N random scenes from VOLUMEN_RANDOM_SEED on, with some
// numbers replaced by extreme ones. With VOLUMEN_FIGURES set, failing scenes are printed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/fixtures/seeds.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/promises/random_parts.h"
#include "tests/unit/suite.h"
#include "viewer/plan/picture_text.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

/// Replaces some of the numbers it is called for by extreme ones, if the scene stays valid.
class Extremes {
 public:
  Extremes(Chance& chance, Scene& scene) : chance_(chance), scene_(scene), oneIn_(2 + chance.below(20)) {}

  template <class Number>
  void operator()(Number& number) {
    constexpr double usual[] = {0, 1, 5e-324, 1e-300, 1e-100, 1e-45, 1e-38, 1e-30, 1e-9, 0.5, 170, 1e4};
    constexpr double large[] = {1e9, 1e20, 3e29, 1e38, 3.4e38, 1e100, 1e300, 1.7e308};
    if (!chance_.oneIn(oneIn_)) return;
    double x =
        chance_.oneIn(2) ? usual[chance_.below(std::size(usual))] : large[chance_.below(std::size(large))];
    if (chance_.oneIn(4)) x = -x;
    const Number before = number;
    number = Number(
        std::clamp<double>(x, std::numeric_limits<Number>::lowest(), std::numeric_limits<Number>::max()));
    if (!validateScene(scene_).ok()) number = before;
  }
  void operator()(glm::dvec3& v) { (*this)(v.x), (*this)(v.y), (*this)(v.z); }

 private:
  Chance& chance_;
  Scene& scene_;
  int oneIn_;
};

void addExtremes(Chance& chance, Scene& scene) {
  Extremes extreme(chance, scene);
  TransferFunction& curve = scene.transferFunction;
  extreme(curve.unitDistance);
  for (CurvePoint& p : curve.points) extreme(p.value), extreme(p.opacity), extreme(p.colour);
  for (GradientOpacityPoint& p : curve.gradientOpacity) extreme(p.gradient), extreme(p.factor);
  Shading& s = scene.shading;
  if (chance.oneIn(2)) s.gradientFloor = 1;
  if (s.gradientFloor) extreme(*s.gradientFloor);
  for (double* number : {&s.ambient, &s.diffuse, &s.specular, &s.shininess}) extreme(*number);
  for (Light& light : scene.lights) extreme(light.direction), extreme(light.intensity);
  Camera& camera = *scene.camera;
  extreme(*camera.target), extreme(camera.direction), extreme(camera.up);
  for (double* number : {&camera.height, &camera.fov, &camera.distance}) extreme(*number);
  for (ClipPlane& plane : scene.clip.planes) extreme(plane.normal), extreme(plane.offset);
  if (scene.window) extreme(scene.window->centre), extreme(scene.window->width);
}

RandomCase extremeCase(std::uint64_t seed) {
  Chance chance(seed);
  RandomCase c = chance.oneIn(2) ? randomHard(Chance(seed)) : randomAttack(Chance(seed));
  addExtremes(chance, c.scene);
  return c;
}

QString whereNoNumber(const std::string& text) {
  for (const char* word : {"nan", "inf ", "inf/", "-inf", "inf,", "inf\""})
    if (text.find(word) != std::string::npos) return QString::fromStdString(text.substr(0, 300));
  return {};
}

/// Returns what is wrong with a picture or its texts; empty if nothing is.
QString faultOf(const Rendered& rendered) {
  if (const QString spoilt = whereNotFinite(rendered.picture); !spoilt.isEmpty()) return spoilt;
  for (float told : rendered.error)
    if (!(told >= 0 && std::isfinite(told))) return QStringLiteral("the error map holds %1").arg(told);
  KnownError known;
  if (!rendered.error.empty()) known.estimated = estimateOf(rendered.error);
  for (const auto& [key, text] : pictureText(rendered.plan, known))
    if (const QString bad = whereNoNumber(text); !bad.isEmpty()) return bad;
  return whereNoNumber(explain(rendered.plan));
}

}  // namespace

class TestExtremeNumbers : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void allThatIsDrawnAndSaidIsANumber();
};

void TestExtremeNumbers::allThatIsDrawnAndSaidIsANumber() {
  const Seeds seeds = seedsOf(70, 200);
  QStringList faults;
  int drawn = 0;
  std::vector<int> all{1009, 1252, 1553};  // regressions: opacities near the limits of floats
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) all.push_back(seed);
  for (int seed : all) {
    const RandomCase c = extremeCase(std::uint64_t(seed));
    RenderCaches caches(c.volume);
    RenderOptions options[] = {atLevel(Quality::draft), atLevel(Quality::standard), atLevel(Quality::exact),
                               atStep(1)};
    options[2].method = seed % 3 ? Method::planes : Method::blend;
    options[3].precision = seed % 2 ? 32 : 8;
    for (RenderOptions& o : options) {
      o.size = {12, 10};
      const auto plan = makePlan(c.scene, caches.facts(), o);
      if (!plan) continue;  // refused with a sentence
      const auto rendered = render(*plan, caches);
      ++drawn;
      const QString fault = rendered ? faultOf(*rendered) : QString::fromStdString(rendered.message());
      if (fault.isEmpty()) continue;
      if (figuresWanted()) std::fprintf(stderr, "%s, %s\n", c.what.c_str(), sceneToJson(c.scene).c_str());
      faults << QStringLiteral("seed %1, %2: %3").arg(seed).arg(QLatin1String(qualityName(o.quality)), fault);
    }
  }
  QVERIFY2(faults.isEmpty(), qPrintable(faults.join(QLatin1Char('\n'))));
  QVERIFY(drawn > 3 * seeds.count);
}

VOLUMEN_TEST(TestExtremeNumbers);
#include "tst_extreme_numbers.moc"
