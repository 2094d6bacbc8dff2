// Guards design.md 2 (levels): the promises on scenes in which a level missed one on 23 November 2026
// (../shared/data/promise-cases), and on the other scenes and volumes of that folder. With VOLUMEN_FIGURES
// set it prints what each row measured.
#include <cstdio>
#include <map>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/promises/level_scenes.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/suite.h"
#include "viewer/reference/reference.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

/// Of a file in the folder.
std::string pathOf(const std::string& file) { return "promise-cases/" + file; }

/// Of cases.tsv. `exact`: that level's promise counts too.
struct PromiseCase {
  std::string name = {}, volume = {}, scene = {};
  glm::ivec2 size{96, 96};
  bool exact = true;
};

/// What cases.tsv says; none where it is not here.
std::vector<PromiseCase> listedCases() {
  std::vector<PromiseCase> cases;
  const QByteArray text = contentsOf(QString::fromStdString(dataPath(pathOf("cases.tsv"))));
  for (const QByteArray& line : text.split('\n').mid(1)) {
    const QByteArrayList fields = line.split('\t');
    if (fields.size() < 9) continue;
    const QByteArrayList size = fields[3].split('x');
    cases.push_back({fields[0].toStdString(),
                     fields[1].toStdString(),
                     fields[2].toStdString(),
                     {size[0].toInt(), size[1].toInt()},
                     fields[8].trimmed() != "-"});
  }
  return cases;
}

/// Scenes and volumes of the folder that cases.tsv does not name.
std::vector<PromiseCase> furtherCases() {
  return {
      {"gradient opacity over a flat curve, target given", "phantom:soft-sphere", "go-check.json"},
      {"gradient opacity over a flat curve, dense", "phantom:soft-sphere", "go-shell-flat-curve-dense.json"},
      {"gradient opacity over a flat curve, head", "phantom:ct-head:128", "go-flat-curve-head.json"},
      {"gradient opacity over a flat curve, head, dense", "phantom:ct-head:128",
       "go-flat-curve-head-dense.json"},
      {"gradient opacity, Levoy's, head", "phantom:ct-head:64", "gradient-opacity-levoy.json"},
      {"two colours over 65 HU, small head", "phantom:ct-head:64", "iso-ramp.json"},
      {"values of 0 and the smallest float", "denormal-1.4e-45.nrrd", "point-at-minimum.json"},
      {"values of 0 and 1e-36", "range-1e-36.nrrd", "point-at-minimum.json"}};
}

/// In these pixels of pilot-stripes.json's picture, 55 x 55, the values of its stripes are seen.
constexpr glm::ivec2 firstStriped(741, 741), lastStriped(795, 795);

/// The error of a picture too large for the whole reference: at every striped pixel, and at 4000 of the
/// others, each of which stands for as many as there are.
PictureError sampledError(const Rendered& rendered, const Volume& volume) {
  const glm::ivec2 size = rendered.picture.size;
  std::vector<glm::ivec2> pixels;
  for (int y = firstStriped.y; y <= lastStriped.y; ++y)
    for (int x = firstStriped.x; x <= lastStriped.x; ++x) pixels.emplace_back(x, y);
  const std::size_t striped = pixels.size(), others = 4000;
  Chance chance(1);
  while (pixels.size() < striped + others) {
    const glm::ivec2 p(chance.below(size.x), chance.below(size.y));
    if (p != glm::clamp(p, firstStriped, lastStriped)) pixels.push_back(p);
  }
  const auto truth = referencePixels(rendered.plan.scene, volume, size, pixels);
  const std::size_t standsFor = (std::size_t(size.x) * size.y - striped) / others;
  Picture seen{{int(striped + standsFor * others), 1}, false, {}}, right = seen;
  std::vector<std::uint8_t> use;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    const float* p = rendered.picture.row(pixels[n].y) + 4 * pixels[n].x;
    for (std::size_t times = n < striped ? 1 : standsFor; times > 0; --times) {
      seen.rgba.insert(seen.rgba.end(), p, p + 4);
      right.rgba.insert(right.rgba.end(), &truth->rgba[n][0], &truth->rgba[n][0] + 4);
      use.push_back(truth->well[n]);
    }
  }
  return compare(seen, right, use);
}

}  // namespace

Q_DECLARE_METATYPE(PromiseCase)

class TestPromiseCases : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyLevelKeepsItsPromise_data();
  void everyLevelKeepsItsPromise();

 private:
  std::map<std::string, RenderCaches> caches_;
};

void TestPromiseCases::everyLevelKeepsItsPromise_data() {
  QTest::addColumn<PromiseCase>("promiseCase");
  std::vector<PromiseCase> cases = listedCases();
  if (cases.empty())
    cases = {{.name = "cases.tsv"}};  // a row to skip
  else
    for (const PromiseCase& c : furtherCases()) cases.push_back(c);
  for (const PromiseCase& c : cases) QTest::newRow(c.name.c_str()) << c;
}

void TestPromiseCases::everyLevelKeepsItsPromise() {
  QFETCH(PromiseCase, promiseCase);
  const PromiseCase& c = promiseCase;
  NEED_VOLUME(!c.volume.empty());
  const std::string name = c.volume.starts_with("phantom:") ? c.volume : pathOf(c.volume);
  const VolumePtr volume = levelVolume(name);
  const auto scene =
      sceneFromJson(contentsOf(QString::fromStdString(dataPath(pathOf(c.scene)))).toStdString());
  QVERIFY2(scene.ok(), scene.ok() ? "" : scene.message().c_str());
  Truth truth(caches_.try_emplace(name, volume).first->second, *scene, c.size);
  QStringList broken;
  for (const Promise& promise : promises) {
    if (promise.quality == Quality::exact && !c.exact) continue;
    const Rendered rendered = truth.rendered(atLevel(promise.quality));
    const QString spoilt = whereNotFinite(rendered.picture);
    QVERIFY2(spoilt.isEmpty(), qPrintable(spoilt));
    const PictureError e =
        c.size.x > 512 ? sampledError(rendered, *volume) : truth.errorOf(rendered.picture, promise);
    const QString words = QLatin1String(promise.name) + QStringLiteral(": ") + inWords(e);
    if (figuresWanted()) std::fprintf(stderr, "%s | %s\n", QTest::currentDataTag(), qPrintable(words));
    if (!promise.keptBy(e)) broken << words;
  }
  QVERIFY2(broken.isEmpty(), qPrintable(broken.join(QStringLiteral("; "))));
}

VOLUMEN_TEST(TestPromiseCases);
#include "tst_promise_cases.moc"
