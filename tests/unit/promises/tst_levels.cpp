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
  constexpr int block = draftPromise.blockEdge, edge = 4 * block;
  Truth truth(caches, made, glm::ivec2(edge));
  const Picture draft = truth.drawn(atLevel(Quality::draft)),
                standard = truth.drawn(atLevel(Quality::standard));
  std::map<int, double> means;  // mean difference by block and component
  glm::dvec4 mean(0);
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x)
      for (int c = 0; c < 4; ++c) {
        const double off = 255 * (double(draft.row(y)[4 * x + c]) - double(standard.row(y)[4 * x + c]));
        means[(y / block * edge + x / block) * 4 + c] += off / (block * block);
        mean[c] += off / (edge * edge);
      }
  double squares = 0;
  for (const auto& [place, off] : means) squares += off * off / double(means.size());
  const double worst = std::max({std::abs(mean.r), std::abs(mean.g), std::abs(mean.b), std::abs(mean.a)});
  const QString words =
      QStringLiteral("RMSE of blocks %1, mean colour off by %2").arg(std::sqrt(squares)).arg(worst);
  if (figuresWanted()) std::fprintf(stderr, "%s | draft: %s\n", QTest::currentDataTag(), qPrintable(words));
  QVERIFY2(std::sqrt(squares) <= draftPromise.mostRmse && worst <= draftPromise.mostMeanColour,
           qPrintable(words));
}

VOLUMEN_TEST(TestLevels);
#include "tst_levels.moc"
