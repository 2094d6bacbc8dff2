// Guards design.md 2 (levels): errors on scenes and volumes that levels were not tuned on. With
// VOLUMEN_FIGURES set, prints the figures of each row.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "tests/fixtures/fixtures.h"
#include "tests/unit/promises/level_scenes.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns the shaders that a level may choose itself, at least for more pixels or lights.
std::vector<Shader> shadersOf(const Scene& scene, Quality quality) {
  const Shading& s = scene.shading;
  if (scene.mode != Mode::composite || !s.lit) return {Shader::automatic};
  const bool alsoMap = !s.localViewer && s.shininess <= 200 && quality != Quality::exact;
  return alsoMap ? std::vector{Shader::phong, Shader::map} : std::vector{Shader::phong};
}

}  // namespace

class TestLevels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void errorsKeepThePromise_data() { addRows(); }
  void errorsKeepThePromise();
  void aDraftIsStandardSeenFromAfar_data() { addRows(); }
  void aDraftIsStandardSeenFromAfar();

 private:
  static void addRows();
  RenderCaches& cachesOf(const std::string& volume);
  std::map<std::string, RenderCaches> caches_;
};

void TestLevels::addRows() {
  QTest::addColumn<QString>("volume");
  QTest::addColumn<int>("scene");
  for (const std::string& volume : levelVolumes())
    for (std::size_t n = 0; n < levelScenes().size(); ++n)
      QTest::addRow("%s, %s", volume.c_str(), levelScenes()[n].name)
          << QString::fromStdString(volume) << int(n);
}

RenderCaches& TestLevels::cachesOf(const std::string& volume) {
  return caches_.try_emplace(volume, levelVolume(volume)).first->second;
}

#define FETCH_SCENE()                                    \
  QFETCH(QString, volume);                               \
  QFETCH(int, scene);                                    \
  const VolumePtr v = levelVolume(volume.toStdString()); \
  NEED_VOLUME(v);                                        \
  RenderCaches& caches = cachesOf(volume.toStdString()); \
  const Scene made = levelScenes()[std::size_t(scene)].make(*v)

// Traces 20 x 20 rays spread evenly over the picture. The 99th percentile excludes the worst four.
void TestLevels::errorsKeepThePromise() {
  FETCH_SCENE();
  Truth truth(caches, made, {20, 20});
  QStringList broken;
  for (const Promise& promise : promises)
    for (Shader shader : shadersOf(made, promise.quality)) {
      RenderOptions options = atLevel(promise.quality);
      options.shader = shader;
      const PictureError e = truth.errorOf(truth.drawn(options), promise);
      const QString words = QString::fromLatin1(promise.name) +
                            (shader == Shader::map ? QStringLiteral(" by map: ") : QStringLiteral(": ")) +
                            inWords(e);
      if (figuresWanted())
        std::fprintf(stderr, "%s | %s, ill-conditioned %.2f %%\n", QTest::currentDataTag(), qPrintable(words),
                     100 * truth.illConditionedShare());
      if (!promise.keptBy(e)) broken << words;
    }
  QVERIFY2(broken.isEmpty(), qPrintable(broken.join(QStringLiteral("; "))));
}

// The picture is four blocks wide, so that all blocks are whole.
void TestLevels::aDraftIsStandardSeenFromAfar() {
  FETCH_SCENE();
  constexpr int edge = 4 * draftPromise.blockEdge;
  Truth truth(caches, made, glm::ivec2(edge));
  const Picture draft = truth.drawn(atLevel(Quality::draft)),
                standard = truth.drawn(atLevel(Quality::standard));
  const DraftError e = draftErrorOf(draft, standard);
  if (figuresWanted())
    std::fprintf(stderr, "%s | draft: %s\n", QTest::currentDataTag(), qPrintable(inWords(e)));
  QVERIFY2(e.keepsPromise(), qPrintable(inWords(e)));
}

VOLUMEN_TEST(TestLevels);
#include "tst_levels.moc"
