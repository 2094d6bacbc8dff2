// Guards design.md 2 (levels): the promises on scenes in which a level missed one on 23 November 2026
// (../shared/data/promise-cases), and on the other scenes and volumes of that folder. Also covers scenes that
// missed one or gave a non-finite number on 26 and 28 November (level-cases, level-cases-2). With
// VOLUMEN_FIGURES set, prints the figures of each row.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

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

/// One row of cases.tsv. With `exact`, that level's promise is checked too.
struct PromiseCase {
  std::string name = {}, folder = {}, volume = {}, scene = {};
  glm::ivec2 size{96, 96};
  bool exact = true;

  /// Returns the path of a file in the case's folder.
  std::string pathOf(const std::string& file) const { return folder + '/' + file; }
};

glm::ivec2 sizeIn(const QByteArray& field) {
  const QByteArrayList size = field.split('x');
  return {size[0].toInt(), size[1].toInt()};
}

std::vector<QByteArrayList> rowsOf(const std::string& table, int columns) {
  std::vector<QByteArrayList> rows;
  const QByteArray text = contentsOf(QString::fromStdString(dataPath(table)));
  for (const QByteArray& line : text.split('\n').mid(1))
    if (const QByteArrayList fields = line.split('\t'); fields.size() >= columns) rows.push_back(fields);
  if (rows.empty() && !dataPath().empty()) throw std::runtime_error("no rows in " + table);
  return rows;
}

/// Returns the cases of promise-cases/cases.tsv; none if the real data are missing.
std::vector<PromiseCase> listedCases() {
  std::vector<PromiseCase> cases;
  for (const QByteArrayList& fields : rowsOf("promise-cases/cases.tsv", 9))
    cases.push_back({fields[0].toStdString(), "promise-cases", fields[1].toStdString(),
                     fields[2].toStdString(), sizeIn(fields[3]), fields[8].trimmed() != "-"});
  return cases;
}

/// Returns the cases of cases.tsv in both folders level-cases. Each volume and scene is named like its case.
std::vector<PromiseCase> levelCases() {
  std::vector<PromiseCase> cases;
  for (const std::string folder : {"level-cases", "level-cases-2"})
    for (const QByteArrayList& fields : rowsOf(folder + "/cases.tsv", 5)) {
      const std::string name = fields[0].toStdString();
      cases.push_back({name, folder, name + ".nrrd", name + ".json", sizeIn(fields[1])});
    }
  return cases;
}

/// Returns cases of scenes and volumes in promise-cases that its list does not name.
std::vector<PromiseCase> furtherCases() {
  std::vector<PromiseCase> cases;
  const auto add = [&](const char* name, const char* volume, const char* scene) {
    cases.push_back({name, "promise-cases", volume, scene});
  };
  add("gradient opacity over a flat curve, target given", "phantom:soft-sphere", "go-check.json");
  add("gradient opacity over a flat curve, dense", "phantom:soft-sphere", "go-shell-flat-curve-dense.json");
  add("gradient opacity over a flat curve, head", "phantom:ct-head:128", "go-flat-curve-head.json");
  add("gradient opacity over a flat curve, head, dense", "phantom:ct-head:128",
      "go-flat-curve-head-dense.json");
  add("gradient opacity, Levoy's, head", "phantom:ct-head:64", "gradient-opacity-levoy.json");
  add("two colours over 65 HU, small head", "phantom:ct-head:64", "iso-ramp.json");
  add("values of 0 and the smallest float", "denormal-1.4e-45.nrrd", "point-at-minimum.json");
  add("values of 0 and 1e-36", "range-1e-36.nrrd", "point-at-minimum.json");
  return cases;
}

/// Pixels of pilot-stripes.json's picture, 55 x 55, that show the values of its stripes.
constexpr glm::ivec2 firstStriped(741, 741), lastStriped(795, 795);

/// Returns the error of a picture too large for a whole reference. It is measured at every striped pixel and
/// at 4000 others, which are weighted by the number of pixels they stand for.
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
    for (const auto& more : {furtherCases(), levelCases()})
      cases.insert(cases.end(), more.begin(), more.end());
  for (const PromiseCase& c : cases) QTest::newRow(c.name.c_str()) << c;
}

void TestPromiseCases::everyLevelKeepsItsPromise() {
  QFETCH(PromiseCase, promiseCase);
  const PromiseCase& c = promiseCase;
  NEED_VOLUME(!c.volume.empty());
  const std::string name = c.volume.starts_with("phantom:") ? c.volume : c.pathOf(c.volume);
  const VolumePtr volume = levelVolume(name);
  const auto scene =
      sceneFromJson(contentsOf(QString::fromStdString(dataPath(c.pathOf(c.scene)))).toStdString());
  QVERIFY2(scene.ok(), scene.ok() ? "" : scene.message().c_str());
  Truth truth(caches_.try_emplace(name, volume).first->second, *scene, c.size);
  QStringList broken;
  for (const Promise& promise : promises) {
    if (promise.quality == Quality::exact && !c.exact) continue;
    const Rendered rendered = truth.rendered(atLevel(promise.quality));
    const QString spoilt = whereNotFinite(rendered.picture);
    QVERIFY2(spoilt.isEmpty(), qPrintable(spoilt));
    QVERIFY2(std::ranges::all_of(rendered.error, [](float told) { return std::isfinite(told); }),
             "the error map holds what is no number");
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
