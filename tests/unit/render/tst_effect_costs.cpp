// Guards design.md 5: each effect on/off with its reason and its cost in ms.
#include <QRegularExpression>
#include <cmath>

#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/render/effect_costs.h"

using namespace volumen;

namespace {

// The frame took 100 ms to resample and 60 ms to shade, after 40 ms for gradients.
const RenderStats stats{.gradientsMs = 40,
                        .resampleMs = 100,
                        .shadeMs = 60,
                        .totalMs = 202,
                        .glMs = 90,
                        .resampled = 3000,
                        .shaded = 1000,
                        .composited = 1000,
                        .kernel = {}};

using Change = void (*)(Scene&, RenderOptions&);

Plan planOf(Change change) {
  static const VolumePtr ball = *makePhantom("sphere:32");
  static const VolumeFacts facts = factsOf(*ball);
  Scene scene;
  scene.transferFunction.points = {{0.5f, {1, 1, 1}, 0}, {0.6f, {1, 1, 1}, 0.5}};
  RenderOptions options;
  change(scene, options);
  return *makePlan(scene, facts, options);
}

std::optional<EffectCost> costOf(const Plan& plan, const char* effect) {
  const EffectCosts costs = effectCosts(plan, stats);
  for (std::size_t n = 0; n < costs.size(); ++n)
    if (plan.effects[n].name == effect) return costs[n];
  return EffectCost{.ms = NAN};
}

}  // namespace

Q_DECLARE_METATYPE(Change)

class TestEffectCosts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void anEffectHasACost_data();
  void anEffectHasACost();
  void sharesAddUpToTheStages_data();
  void sharesAddUpToTheStages();
  void gradientsThatAreThereCostNothingMore();
  void explainSaysThem();
};

void TestEffectCosts::anEffectHasACost_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QString>("effect");
  QTest::addColumn<QString>("text");  // empty if the effect states no cost
  const auto row = [](const char* name, const char* effect, const char* text, Change change) {
    QTest::newRow(name) << change << QString::fromLatin1(effect) << QString::fromLatin1(text);
  };
  const Change lit = [](Scene&, RenderOptions&) {};
  const Change unlit = [](Scene& s, RenderOptions&) { s.shading.lit = false; };
  row("the whole picture, without what is made once", "method", "162 ms", lit);
  row("resampling is measured", "integration", "100 ms", lit);
  // Shading has 1 (colour) + 3 (gradient) + 2 (diffuse and ambient of one light) + 1 (its specular) parts.
  row("three of seven parts of the shading", "gradients", "about 26 ms, once 40 ms", lit);
  row("two of seven parts", "lighting", "about 17 ms", lit);
  row("one of seven parts", "specular", "about 8.6 ms", lit);
  row("what is off costs nothing", "lighting", "0 ms", unlit);
  row("no gradients", "gradients", "0 ms", unlit);
  row("a map's light has its specular in it", "specular", "about 0 ms",
      [](Scene&, RenderOptions& o) { o.shader = Shader::map; });
  // 3 x 1000 components are fetched beside 3000 densities.
  row("gradients fetched before opacity is known", "gradient opacity", "about 50 ms",
      [](Scene& s, RenderOptions&) {
        s.transferFunction.gradientOpacity = {{0, 0}, {1, 1}};
      });
  row("what a maximum saves is not known", "empty blocks", "",
      [](Scene& s, RenderOptions&) { s.mode = Mode::mip; });
  row("counted elsewhere", "precision", "", lit);
  row("voxels are lit beforehand", "lighting", "60 ms",
      [](Scene&, RenderOptions& o) { o.method = Method::preshaded; });
  row("OpenGL's own time", "resampler", "90 ms",
      [](Scene&, RenderOptions& o) { o.resampler = Resampler::gl; });
  // Shading has 1 (colour) + 2 (diffuse and ambient) + 1 (specular) parts, as OpenGL fetches the gradients.
  row("light by the CPU after OpenGL", "lighting", "about 30 ms",
      [](Scene&, RenderOptions& o) { o.resampler = Resampler::gl; });
  row("all in one shader", "lighting", "", [](Scene&, RenderOptions& o) { o.method = Method::gpu; });
  row("the reference is all in one", "reference", "162 ms",
      [](Scene&, RenderOptions& o) { o.method = Method::reference; });
}

void TestEffectCosts::anEffectHasACost() {
  QFETCH(Change, change);
  QFETCH(QString, effect);
  QFETCH(QString, text);
  const auto cost = costOf(planOf(change), effect.toLatin1().constData());
  QCOMPARE(cost ? QString::fromStdString(costText(*cost)) : QString(), text);
}

void TestEffectCosts::sharesAddUpToTheStages_data() {
  QTest::addColumn<Change>("change");
  QTest::newRow("one light") << Change([](Scene&, RenderOptions&) {});
  QTest::newRow("no specular") << Change([](Scene& s, RenderOptions&) { s.shading.specular = 0; });
  QTest::newRow("four lights, direct") << Change([](Scene& s, RenderOptions& o) {
    s.lights.resize(4);
    o.shader = Shader::phong;
  });
  QTest::newRow("four lights, a map") << Change([](Scene& s, RenderOptions&) { s.lights.resize(4); });
  QTest::newRow("5-bit table") << Change([](Scene&, RenderOptions& o) { o.shader = Shader::table; });
}

void TestEffectCosts::sharesAddUpToTheStages() {
  QFETCH(Change, change);
  const Plan plan = planOf(change);
  double shading = 0;
  for (const char* effect : {"gradients", "lighting", "specular"}) {
    const auto cost = costOf(plan, effect);
    QVERIFY(cost && cost->ms >= 0);
    shading += cost->ms;
  }
  QVERIFY2(shading < stats.shadeMs, "colours and compositing take a part, too");
  QVERIFY2(shading > stats.shadeMs / 2, "light takes most");
}

void TestEffectCosts::gradientsThatAreThereCostNothingMore() {
  RenderStats later = stats;
  later.gradientsMs = 0.02;  // looked up in the cache
  const Plan plan = planOf([](Scene&, RenderOptions&) {});
  for (const auto& cost : effectCosts(plan, later)) QVERIFY(!cost || cost->onceMs == 0);
}

void TestEffectCosts::explainSaysThem() {
  const Plan plan = planOf([](Scene&, RenderOptions&) {});
  const QString text = QString::fromStdString(explain(plan, effectCosts(plan, stats)));
  const QRegularExpression specular(QStringLiteral("\non   specular: .*0\\.2.* \\(about 8\\.6 ms\\)\n")),
      clip(QStringLiteral("\noff  clip: .* \\(0 ms\\)\n"));
  QVERIFY2(text.contains(specular) && text.contains(clip), qPrintable(text));
  const std::string json = explainJson(plan, effectCosts(plan, stats));
  QVERIFY(json.find("\"costEstimated\":true,\"onceMs\":40.0") != std::string::npos);
  QVERIFY(json.find("\"effect\":\"precision\"") != std::string::npos);
  QVERIFY(json.find("\"costMs\":null") != std::string::npos);
}

VOLUMEN_TEST(TestEffectCosts);
#include "tst_effect_costs.moc"
