// Guards design.md 2 (levels): every preset on every kind of study keeps the levels' promises. Rows look from
// different sides. With VOLUMEN_FIGURES set, prints the figures of each row.
#include <array>
#include <cstdio>
#include <map>

#include "tests/fixtures/fixtures.h"
#include "tests/unit/promises/level_scenes.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/suite.h"
#include "viewer/scene/presets.h"

using namespace volumen;
using namespace volumen::tests;

class TestPresetLevels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void errorsKeepThePromise_data();
  void errorsKeepThePromise();

 private:
  std::map<std::string, RenderCaches> caches_;
};

void TestPresetLevels::errorsKeepThePromise_data() {
  QTest::addColumn<QString>("volume");
  QTest::addColumn<QString>("preset");
  QTest::addColumn<int>("side");
  int side = 0;
  for (const char* volume :
       {"ct-chest-lidc0314-138", "mr-head-ge-mprage-130", "mr-head-siemens-gap-175", "phantom:ct-head:96"})
    for (const std::string& preset : presetNames())
      QTest::addRow("%s, %s", volume, preset.c_str())
          << QString::fromLatin1(volume) << QString::fromStdString(preset) << side++;
}

// Traces 32 x 32 rays spread evenly over the picture.
void TestPresetLevels::errorsKeepThePromise() {
  QFETCH(QString, volume);
  QFETCH(QString, preset);
  QFETCH(int, side);
  const VolumePtr v = levelVolume(volume.toStdString());
  NEED_VOLUME(v);
  static constexpr std::array<glm::dvec3, 7> directions{{{0, 1, 0},
                                                         {0.5, 0.8, -0.33},
                                                         {-1, 0, 0},
                                                         {0.69, -0.62, -0.37},
                                                         {0, 0, 1},
                                                         {-0.3, 0.2, 0.9},
                                                         {1, 0.03, -0.02}}};
  Scene scene = *presetScene(preset.toStdString(), *v);
  scene.camera = Camera{};
  scene.camera->direction = directions[std::size_t(side) % directions.size()];
  scene.camera->up = {0, -0.6, 0.8};
  if (side % 3 == 0) scene.camera->projection = Projection::perspective;
  Truth truth(caches_.try_emplace(volume.toStdString(), v).first->second, scene, {32, 32});
  QStringList broken;
  for (const Promise& promise : promises) {
    const PictureError e = truth.errorOf(truth.drawn(atLevel(promise.quality)), promise);
    const QString words = QString::fromLatin1(promise.name) + QStringLiteral(": ") + inWords(e);
    if (figuresWanted()) std::fprintf(stderr, "%s | %s\n", QTest::currentDataTag(), qPrintable(words));
    if (!promise.keptBy(e)) broken << words;
  }
  QVERIFY2(broken.isEmpty(), qPrintable(broken.join(QStringLiteral("; "))));
}

VOLUMEN_TEST(TestPresetLevels);
#include "tst_preset_levels.moc"
