// Guards design.md 10 (presets): reading and writing a preset's file.
#include "tests/unit/scene/preset_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/scene/presets.h"

using namespace volumen;
using namespace volumen::tests;

class TestPresetFiles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsWrittenIsRead();
  void ownPresetsAreFoundByName();
  void wrongFilesAreASentence_data();
  void wrongFilesAreASentence();
  void aLookIsAllButTheView();
};

void TestPresetFiles::whatIsWrittenIsRead() {
  std::vector<Preset> presets = builtInPresets();
  presets.push_back({"Größe \"1\"/2", "", Scene{}, {}});
  presets.back().scene.background = {.transparent = true, .colour = {}};
  for (const Preset& preset : presets) {
    const Result<Preset> read = presetFromJson(presetToJson(preset));
    QVERIFY2(read.ok(), read.ok() ? "" : read.message().c_str());
    QCOMPARE(read->name, preset.name);
    QCOMPARE(read->modality, preset.modality);
    QVERIFY(read->scene == preset.scene);
    QVERIFY(read->anchor == preset.anchor);
  }
}

void TestPresetFiles::ownPresetsAreFoundByName() {
  Preset own{"Mine", "MR", Scene{}, ValueRange{0, 100}};
  own.scene.transferFunction.points = {{0, {1, 1, 1}, 0}, {100, {1, 1, 1}, 1}};
  const auto scene = presetScene("Mine", *countingVolume(), {own});
  QVERIFY(scene.ok());
  QCOMPARE(scene->transferFunction.points[0].value, 9.f);  // P1 and P99.5 of the volume
  QCOMPARE(scene->transferFunction.points[1].value, 994.f);
  QVERIFY(presetScene("Mime", *countingVolume(), {own}).message().find("Did you mean Mine?") !=
          std::string::npos);
}

void TestPresetFiles::wrongFilesAreASentence_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* name, const char* text, const char* sentence) {
    QTest::newRow(name) << QString::fromUtf8(text) << QString::fromUtf8(sentence);
  };
  row("no JSON", "hello", "line 1");
  row("no name", R"({"scene": {}})", "name must not be empty.");
  row("no scene", R"({"name": "a"})", "scene is missing.");
  row("an unknown field", R"({"name": "a", "scene": {}, "colour": 1})", "colour is unknown");
  row("an anchor of nothing", R"({"name": "a", "scene": {}, "anchor": {"low": 3, "high": 3}})", "anchor");
  row("a wrong scene", R"({"name": "a", "scene": {"mode": "x"}})", "scene: mode must be");
}

void TestPresetFiles::wrongFilesAreASentence() {
  QFETCH(QString, text);
  QFETCH(QString, sentence);
  const Result<Preset> read = presetFromJson(text.toStdString());
  QVERIFY(!read.ok());
  QVERIFY2(QString::fromStdString(read.message()).contains(sentence), read.message().c_str());
}

void TestPresetFiles::aLookIsAllButTheView() {
  Scene seen;
  seen.camera = standardView("left");
  seen.clip.boxLow.x = 0.5;
  const Scene look = *presetScene("PET-MIP", *countingVolume("PT"));
  const Scene both = withLook(seen, look);
  QVERIFY(both.camera == seen.camera && both.clip == seen.clip);
  QVERIFY(sameLook(both, look) && !sameLook(seen, look));
}

VOLUMEN_TEST(TestPresetFiles);
#include "tst_preset_files.moc"
