// Guards design.md 10 (presets, padding) and the published opacities that the presets reproduce.
#include "tests/unit/scene/preset_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/scene/presets.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;
using namespace volumen::tests;

class TestPresets : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void namesAreCompleteAndInOrder();
  void opacitiesAreThePublishedOnes_data();
  void opacitiesAreThePublishedOnes();
  void everyPresetIsValidOnEveryVolume_data();
  void everyPresetIsValidOnEveryVolume();
  void presetsLeaveCameraClipAndLightsAlone();
  void magneticResonanceIsAnchored_data();
  void magneticResonanceIsAnchored();
  void paddingDoesNotMoveTheAnchor();
  void techniqueOfMaximumPresets();
  void unknownNameIsRefusedWithOneLikeIt();
};

namespace {

struct Point {
  double value, opacity;
};

struct Published {
  const char* name;
  std::vector<Point> points;
  double material[4];  // ambient, diffuse, specular, power
  bool lit;
  std::vector<Point> gradient;
  double anchorHigh;  // the published value that is mapped to P99.5; 0 if values stay in HU
};

// Returns the published tables of 3D Slicer, CS3D and VolView (figures only).
const std::vector<Published>& published() {
  static const std::vector<Published> table{
      {"CT-AAA",
       {{143.556, 0}, {166.222, .686}, {214.389, .696}, {419.736, .833}, {3071, .804}},
       {.1, .9, .2, 10},
       true,
       {},
       0},
      {"CT-AAA2",
       {{129.542, 0}, {145.244, .167}, {157.02, .5}, {169.918, .627}, {395.575, .8125}, {1578.73, .8125}},
       {.1, .9, .2, 10},
       true,
       {},
       0},
      {"CT-Air", {{-3024, .706}, {-900, .716}, {-500, 0}}, {.1, .9, .2, 10}, true, {}, 0},
      {"CT-Bone", {{-16.4458, 0}, {641.385, .716}, {3071, .706}}, {.1, .9, .2, 10}, true, {}, 0},
      {"CT-Bones",
       {{-1000, 0}, {152.19, 0}, {278.93, .190}, {952, .2}},
       {.2, 1, 0, 1},
       true,
       {{0, 1}, {985, 1}},
       0},
      {"CT-Cardiac",
       {{-77.6875, 0}, {94.9518, .286}, {179.052, .554}, {260.439, .848}, {3071, .875}},
       {.1, .9, .2, 10},
       true,
       {},
       0},
      {"CT-Cardiac2",
       {{42.8964, 0}, {163.488, .429}, {277.642, .777}, {1587, .755}},
       {.1, .9, .2, 10},
       true,
       {},
       0},
      {"CT-Cardiac3",
       {{-86.9767, 0}, {45.3791, .170}, {139.919, .589}, {347.907, .607}, {1224.16, .607}, {3071, .616}},
       {.1, .9, .2, 10},
       true,
       {},
       0},
      {"CT-Chest-Contrast-Enhanced",
       {{67.0106, 0}, {251.105, .446}, {439.291, .625}, {3071, .616}},
       {.1, .9, .2, 10},
       true,
       {},
       0},
      {"CT-Chest-Vessels",
       {{-1278.35, 0}, {22.8277, .429}, {439.291, .625}, {3071, .616}},
       {.2, 1, 0, 1},
       true,
       {},
       0},
      {"CT-Coronary-Arteries",
       {{136.47, 0}, {159.215, .259}, {318.43, .571}, {478.693, .777}, {3661, 1}},
       {.2, 1, 0, 1},
       false,
       {},
       0},
      {"CT-Coronary-Arteries-3",
       {{128.643, 0}, {129.982, .098}, {173.636, .670}, {255.884, .857}, {584.878, .866}, {3661, 1}},
       {.1, .9, .2, 10},
       true,
       {},
       0},
      {"CT-Cropped-Volume-Bone", {{-451, 0}, {-450, 1}}, {.2, 1, 0, 1}, false, {}, 0},
      {"CT-Fat", {{-100, 0}, {-99, .15}, {-60, .15}, {-59, 0}}, {.2, 1, 0, 1}, false, {}, 0},
      {"CT-Liver-Vasculature",
       {{149.113, 0}, {157.884, .482}, {339.96, .661}, {388.526, .830}, {1197.95, .839}},
       {.2, 1, 0, 1},
       false,
       {},
       0},
      {"CT-Lung", {{-600, 0}, {-599, .15}, {-400, .15}, {-399, 0}}, {.2, 1, 0, 1}, true, {}, 0},
      {"CT-MIP", {{-637.62, 0}, {700, 1}}, {.1, .9, .2, 10}, true, {}, 0},
      {"CT-Muscle",
       {{-155.407, 0}, {217.641, .676}, {419.736, .833}, {3071, .804}},
       {.1, .9, .2, 10},
       true,
       {},
       0},
      {"CT-Pulmonary-Arteries",
       {{-568.625, 0}, {-364.081, .071}, {-244.813, .402}, {18.2775, .607}, {447.798, .830}},
       {.2, 1, 0, 1},
       true,
       {},
       0},
      {"CT-Soft-Tissue", {{-167.01, 0}, {-160, 1}, {240, 1}}, {.2, 1, 0, 1}, false, {}, 0},
      {"CT-X-ray", {{-200, 0}, {1500, .05}, {3071, .05}}, {.1, .9, .2, 10}, false, {}, 0},
      {"MR-Angio",
       {{151.354, 0}, {158.279, .4375}, {190.112, .580}, {200.873, .732}, {3661, .741}},
       {.2, 1, 0, 1},
       true,
       {},
       180},
      {"MR-Default", {{20, 0}, {40, .15}, {120, .3}, {220, .375}, {1024, .5}}, {.2, 1, 0, 1}, true, {}, 220},
      {"MR-MIP", {{98.3725, 0}, {416.637, 1}}, {.2, 1, 0, 1}, false, {}, 320},
      {"MR-T2-Brain",
       {{36.05, 0}, {218.302, .171}, {412.406, 1}},
       {.3, .6, .5, 40},
       true,
       {{0, 1}, {160.25, 1}},
       412.406},
      {"US-Fetal", {{60, 0}, {120, .6}, {255, .8}}, {.1, .9, .2, 10}, true, {}, 0},
  };
  return table;
}

// Interpolates linearly between the table's points, constant outside.
double tableAt(const std::vector<Point>& points, double value) {
  if (value <= points.front().value) return points.front().opacity;
  for (std::size_t n = 1; n < points.size(); ++n)
    if (value <= points[n].value) {
      const Point &a = points[n - 1], &b = points[n];
      return a.opacity + (value - a.value) / (b.value - a.value) * (b.opacity - a.opacity);
    }
  return points.back().opacity;
}

}  // namespace

void TestPresets::namesAreCompleteAndInOrder() {
  std::vector<std::string> expected{"CT-Skin-and-Bone", "PET-MIP"};
  for (const Published& p : published()) expected.push_back(p.name);
  std::sort(expected.begin(), expected.end());
  QCOMPARE(presetNames(), expected);
}

void TestPresets::opacitiesAreThePublishedOnes_data() {
  QTest::addColumn<int>("row");
  for (std::size_t n = 0; n < published().size(); ++n) QTest::newRow(published()[n].name) << int(n);
}

void TestPresets::opacitiesAreThePublishedOnes() {
  QFETCH(int, row);
  const Published& p = published()[std::size_t(row)];
  const Scene scene = *presetScene(p.name, *countingVolume());
  QCOMPARE(scene.transferFunction.unitDistance, 1.0);
  const auto& points = scene.transferFunction.points;
  const double scale = p.anchorHigh ? (994 - 9) / p.anchorHigh : 1, shift = p.anchorHigh ? 9 : 0;
  for (const Point& want : p.points) {
    const float value = float(shift + want.value * scale);
    const auto found = std::find_if(points.begin(), points.end(), [&](const CurvePoint& have) {
      return std::abs(have.value - value) <= 1e-6f * std::abs(value) && have.opacity == want.opacity;
    });
    QVERIFY2(found != points.end(), qPrintable(QString::number(want.value)));
  }
  // Points beyond the table's serve only their colour.
  for (const CurvePoint& have : points)
    QVERIFY(std::abs(have.opacity - tableAt(p.points, (double(have.value) - shift) / scale)) < 1e-3);
  const Shading& s = scene.shading;
  QCOMPARE((std::vector<double>{s.ambient, s.diffuse, s.specular, s.shininess}),
           std::vector<double>(p.material, p.material + 4));
  QCOMPARE(s.lit, p.lit);
  QCOMPARE(scene.transferFunction.gradientOpacity.size(), p.gradient.size());
  for (std::size_t n = 0; n < p.gradient.size(); ++n) {
    QVERIFY(std::abs(scene.transferFunction.gradientOpacity[n].gradient - p.gradient[n].value * scale) <
            1e-9);
    QCOMPARE(scene.transferFunction.gradientOpacity[n].factor, p.gradient[n].opacity);
  }
}

void TestPresets::everyPresetIsValidOnEveryVolume_data() {
  QTest::addColumn<std::vector<float>>("values");
  QTest::newRow("one voxel") << std::vector<float>{7};
  QTest::newRow("all the same") << std::vector<float>(100, -3);
  QTest::newRow("the largest values") << std::vector<float>{-1e30f, 1e30f};
  QTest::newRow("the smallest range") << std::vector<float>{1e6f, std::nextafter(1e6f, 2e6f)};
  QTest::newRow("denormal") << std::vector<float>{0, 1e-44f};
  QTest::newRow("negative") << std::vector<float>{-900, -800, -700};
}

void TestPresets::everyPresetIsValidOnEveryVolume() {
  QFETCH(std::vector<float>, values);
  const VolumePtr volume = rowOf(values, "MR");
  std::vector<std::string> names = presetNames();
  names.push_back("auto");
  for (const std::string& name : names) {
    const auto scene = presetScene(name, *volume);
    QVERIFY(scene.ok());
    const Status status = validateScene(*scene);
    QVERIFY2(status.ok(), (name + ": " + (status.ok() ? "" : status.message())).c_str());
  }
}

void TestPresets::presetsLeaveCameraClipAndLightsAlone() {
  const Scene plain;
  for (const std::string& name : presetNames()) {
    const Scene scene = *presetScene(name, *countingVolume());
    QVERIFY(!scene.camera && scene.clip == plain.clip);
    QCOMPARE(scene.background == plain.background, name != "PET-MIP");
    QVERIFY(scene.lights == plain.lights);
  }
}

void TestPresets::magneticResonanceIsAnchored_data() {
  QTest::addColumn<double>("slope");
  QTest::addColumn<double>("intercept");
  QTest::newRow("as stored") << 1. << 0.;
  QTest::newRow("another scanner's numbers") << 7.5 << -300.;
  QTest::newRow("small fractions") << 1e-3 << 0.;
}

void TestPresets::magneticResonanceIsAnchored() {
  QFETCH(double, slope);
  QFETCH(double, intercept);
  const VolumePtr plain = countingVolume();
  VolumeParts parts;
  parts.geometry = plain->geometry();
  parts.values = plain->stored();
  parts.slope = slope;
  parts.intercept = intercept;
  std::vector<std::string> warnings;
  const VolumePtr rescaled = *Volume::make(parts, warnings);
  const Scene a = *presetScene("MR-Default", *plain), b = *presetScene("MR-Default", *rescaled);
  for (std::size_t n = 0; n < a.transferFunction.points.size(); ++n) {
    const double expected = slope * double(a.transferFunction.points[n].value) + intercept;
    QVERIFY(std::abs(double(b.transferFunction.points[n].value) - expected) < 1e-3 * slope);
  }
  const Scene bone = *presetScene("CT-Bone", *rescaled);
  QCOMPARE(bone.transferFunction.points[0].value, -16.4458f);
}

void TestPresets::paddingDoesNotMoveTheAnchor() {
  std::vector<std::int16_t> values(2000, -2000);
  for (int n = 0; n < 1000; ++n) values[std::size_t(n)] = std::int16_t(n);
  VolumeParts parts;
  parts.geometry.size = {2000, 1, 1};
  parts.values = values;
  parts.attributes.modality = "MR";
  parts.attributes.padding = ValueRange{-2000, -2000};
  std::vector<std::string> warnings;
  const VolumePtr padded = *Volume::make(parts, warnings);
  QVERIFY(*presetScene("MR-Default", *padded) == *presetScene("MR-Default", *countingVolume()));
}

void TestPresets::techniqueOfMaximumPresets() {
  for (const std::string& name : presetNames()) {
    const Scene scene = *presetScene(name, *countingVolume());
    const bool maximum = name.ends_with("-MIP");
    QCOMPARE(scene.mode == Mode::mip, maximum);
    QCOMPARE(scene.window.has_value(), maximum);
  }
  const Window ct = *presetScene("CT-MIP", *countingVolume())->window;
  // air is black, ribs are not white
  QVERIFY(ct.centre - ct.width / 2 > -1000 && ct.centre + ct.width / 2 > 700);
  const Window mr = *presetScene("MR-MIP", *countingVolume())->window;
  // the brightest value is below white
  QVERIFY(mr.centre - mr.width / 2 > 9 && mr.centre + mr.width / 2 > 994);
  const Scene pet = *presetScene("PET-MIP", *countingVolume("PT"));
  QVERIFY2(pet.window->width < 0, "much tracer is dark");
  QVERIFY2(pet.background.colour == glm::dvec3(1), "as bright as no tracer");
}

void TestPresets::unknownNameIsRefusedWithOneLikeIt() {
  const auto scene = presetScene("CT-Bonez", *countingVolume());
  QVERIFY(!scene.ok());
  QVERIFY(scene.message().starts_with("Unknown preset \"CT-Bonez\". Did you mean CT-Bone?"));
}

VOLUMEN_TEST(TestPresets);
#include "tst_presets.moc"
