// Guards design.md 10 (the preset that is chosen automatically, defaults of render).
#include <algorithm>
#include <random>

#include "tests/unit/scene/preset_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/scene/automatic.h"
#include "viewer/scene/curve_changes.h"
#include "viewer/scene/presets.h"

using namespace volumen;
using namespace volumen::tests;

class TestAutoPreset : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void autoChoosesByModalityAndHistogram_data();
  void autoChoosesByModalityAndHistogram();
  void autoLightsOverTheShoulder();
  void aSmallThingInALargeBackgroundIsSeen();
  void presetsOfCtLieWhereWaterIs();
};

namespace {

struct Tissue {
  double mean, deviation;
  int voxels;
};

// Returns a volume with the histogram of these tissues.
VolumePtr patient(const std::vector<Tissue>& tissues, const char* modality) {
  std::mt19937 bits(1);
  std::vector<std::int16_t> values;
  for (const Tissue& t : tissues)
    for (int n = 0; n < t.voxels; ++n) {
      const double v = std::normal_distribution<double>(t.mean, t.deviation)(bits);
      values.push_back(std::int16_t(std::clamp(v, -1024.0, 3071.0)));
    }
  return rowOf(std::move(values), modality);
}

constexpr Tissue air{-1000, 10, 60000}, lung{-850, 60, 20000}, fat{-100, 25, 20000}, muscle{50, 25, 50000};
constexpr Tissue spongyBone{100, 150, 5000}, denseBone{900, 400, 15000}, blood{300, 25, 2500},
    table{280, 30, 400};

}  // namespace

void TestAutoPreset::autoChoosesByModalityAndHistogram_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::addColumn<QString>("preset");
  const std::vector<Tissue> chest{air, lung, fat, muscle, spongyBone}, body{air, fat, muscle, spongyBone};
  std::vector<Tissue> chestWithContrast = chest, bodyWithContrast = body;
  chestWithContrast.push_back(blood);
  bodyWithContrast.push_back(blood);
  QTest::newRow("chest") << patient(chest, "CT") << "CT-Bones";
  QTest::newRow("chest with contrast") << patient(chestWithContrast, "CT") << "CT-Chest-Contrast-Enhanced";
  QTest::newRow("chest on a dense table")
      << patient({air, lung, fat, muscle, spongyBone, table}, "CT") << "CT-Bones";
  QTest::newRow("abdomen") << patient(body, "CT") << "CT-Muscle";
  QTest::newRow("abdomen with contrast") << patient(bodyWithContrast, "CT") << "CT-AAA";
  QTest::newRow("head") << patient({air, fat, muscle, denseBone}, "CT") << "CT-Bone";
  QTest::newRow("chest, modality unknown") << patient(chest, "") << "CT-Bones";
  QTest::newRow("head, modality unknown") << patient({air, fat, muscle, denseBone}, "") << "CT-Bone";
  QTest::newRow("MR") << countingVolume("MR") << "MR-MIP";
  QTest::newRow("PET") << countingVolume("PT") << "PET-MIP";
  QTest::newRow("SPECT") << countingVolume("NM") << "PET-MIP";
  QTest::newRow("no HU, modality unknown") << countingVolume("") << "MR-Default";
  QTest::newRow("HU-like but MR") << patient(chest, "MR") << "MR-MIP";
  QTest::newRow("ultrasound") << countingVolume("US") << "US-Fetal";
  QTest::newRow("head without rescale: air is 0, water 1024")
      << patient({{5, 1, 60000}, {924, 25, 20000}, {1074, 25, 50000}, {1924, 400, 15000}}, "CT") << "CT-Bone";
  QTest::newRow("a piece of bone, nothing below 0")
      << patient({{120, 20, 20000}, {1000, 400, 20000}}, "CT") << "CT-Bone";
  QTest::newRow("CT of one value") << rowOf(std::vector<std::int16_t>(10, 0), "CT") << "CT-Muscle";
}

void TestAutoPreset::autoChoosesByModalityAndHistogram() {
  QFETCH(VolumePtr, volume);
  QFETCH(QString, preset);
  QCOMPARE(QString::fromStdString(automaticPreset(*volume)), preset);
  Scene chosen = *presetScene(automaticPreset(*volume), *volume);
  Scene automatic = *presetScene("auto", *volume);
  automatic.lights = chosen.lights;
  QVERIFY(automatic == chosen);
}

// Only 60 of 100,000 voxels are not 0, so that P1 and P99.5 are both 0.
void TestAutoPreset::aSmallThingInALargeBackgroundIsSeen() {
  std::vector<std::int16_t> values(100000, 0);
  for (int n = 0; n < 60; ++n) values[500 + n] = std::int16_t(1 + n % 9);
  const Scene scene = *presetScene("auto", *rowOf(std::move(values), ""));
  const TransferFunction& curve = scene.transferFunction;
  QCOMPARE(opacityAt(curve, 0), 0.0);
  QVERIFY(opacityAt(curve, 9) > 0.3);
}

// If a CT head is raised by 1024, presets of CT that need no anchor show it unchanged, with values 1024
// higher.
void TestAutoPreset::presetsOfCtLieWhereWaterIs() {
  const auto head = [](double by) {
    return patient(
        {{by - 990, 1, 60000}, {by - 100, 25, 20000}, {by + 50, 25, 50000}, {by + 900, 400, 15000}}, "CT");
  };
  const VolumePtr inHu = head(0), raised = head(1024);
  QCOMPARE(waterOf(*inHu), 0.0);
  QCOMPARE(waterOf(*raised), 1024.0);
  for (const Preset& preset : builtInPresets()) {
    if (preset.modality != "CT" || preset.anchor) continue;
    Scene expected = sceneOf(preset, *inHu);
    moveValues(expected, 1024);
    QVERIFY2(sceneOf(preset, *raised) == expected, preset.name.c_str());
  }
}

void TestAutoPreset::autoLightsOverTheShoulder() {
  const Scene scene = *presetScene("auto", *countingVolume());
  QVERIFY(!scene.lights.empty());
  const Light& main = scene.lights[0];
  QVERIFY(main.space == Space::camera && main.on);
  QVERIFY(main.direction.x < 0 && main.direction.y > 0 && main.direction.z > 0);  // left, above, from behind
  for (std::size_t n = 1; n < scene.lights.size(); ++n)
    QVERIFY(scene.lights[n].intensity < main.intensity / 2);
}

VOLUMEN_TEST(TestAutoPreset);
#include "tst_auto_preset.moc"
