// Guards design.md 2 (levels, finite, determinism, --full) on random scenes: boxes of real studies, tiny hard
// volumes, kinds of attacks, and scenes hostile to pilots.
// VOLUMEN_RANDOM_CASES=N: N seeds of the first and half as many of the others, from VOLUMEN_RANDOM_SEED on.
// VOLUMEN_RANDOM_FAMILY=NAME: N seeds of that family alone.
// VOLUMEN_RANDOM_SAVE=DIR: writes failing cases there.
// VOLUMEN_RANDOM_BRUTE: prints the error of their references against brute force.
// VOLUMEN_FIGURES: prints each row's figures.
#include <algorithm>
#include <cstdio>
#include <cstring>

#include "io/files/output_file.h"
#include "io/files/write_volume.h"
#include "tests/fixtures/brute_force.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/promises/random_cases.h"
#include "tests/unit/promises/random_report.h"
#include "tests/unit/suite.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

/// Writes `DIR/pieces-17.nrrd` and `.json`, and prints how to draw them.
void save(const RandomCase& c, Family family, std::uint64_t seed, const std::string& folder) {
  const std::string path = folder + "/" + nameOf(family) + "-" + std::to_string(seed);
  const Status volume = writeVolume(*c.volume, path + ".nrrd");
  Result<OutputFile> scene = OutputFile::create(path + ".json");
  const bool saved = volume.ok() && scene && scene->write(sceneToJson(c.scene)) && scene->commit();
  std::fprintf(stderr,
               saved ? "volumen render %s.nrrd --scene %s.json --size %dx%d --quality exact -o %s.png\n"
                     : "cannot write %s.nrrd or %s.json (%d x %d pixels, %s)\n",
               path.c_str(), path.c_str(), c.size.x, c.size.y, path.c_str());
}

/// Returns variants of the options that must all give the same bytes.
std::vector<std::pair<const char*, RenderOptions>> twinsOf(const RenderOptions& options) {
  std::vector<std::pair<const char*, RenderOptions>> twins{
      {"one thread", options}, {"three threads", options}, {"--full", options}};
  twins[0].second.threads = 1;
  twins[1].second.threads = 3;
  twins[2].second.full = true;
  return twins;
}

/// Hard scenes that once failed. Points of their curves are on a plateau of the volume or within ulps of it,
/// and the unit distance makes rounding opaque.
constexpr int foundHard[] = {300195, 400312, 400375, 400710, 400923};
/// Of pilots' scenes: gradient opacity is a step, over gradients that 16 bits round.
constexpr int foundHostile[] = {102};

/// Compares float bytes, so that NaN equals itself.
bool sameBytes(const Picture& a, const Picture& b) {
  return a.size == b.size && std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(float)) == 0;
}

/// Returns all faults of a picture except its error.
QStringList faultsOf(Truth& truth, const Picture& picture, const RenderOptions& options) {
  QStringList faults;
  const QString spoilt = whereNotFinite(picture);
  if (!spoilt.isEmpty()) faults << spoilt;
  for (const auto& [name, twin] : twinsOf(options))
    if (!sameBytes(truth.drawn(twin), picture))
      faults << QLatin1String(name) + QStringLiteral(": other bytes");
  return faults;
}

/// Returns the error and its largest position as text.
QString errorInWords(Truth& truth, const Picture& picture, const PictureError& e) {
  const std::vector<double> errors = truth.errorOfPixels(picture);
  const auto worst = int(std::max_element(errors.begin(), errors.end()) - errors.begin());
  return QStringLiteral("%1, worst at pixel (%2, %3)")
      .arg(inWords(e))
      .arg(worst % picture.size.x)
      .arg(worst / picture.size.x);
}

/// Prints the error of brute force against the reference, to judge whether to trust the reference.
void printBruteForce(Truth& truth, const RandomCase& c) {
  const Picture brute = bruteForceLimit(c.scene, *c.volume, c.size, 1.0 / 256);
  std::fprintf(stderr, "%s: the brute force against the reference: %s\n", QTest::currentDataTag(),
               qPrintable(errorInWords(truth, brute, truth.errorOf(brute))));
}

}  // namespace

class TestRandomScenes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyLevelKeepsItsPromise_data();
  void everyLevelKeepsItsPromise();
  void errorsAreAsTold();
  void cleanupTestCase() { report_.print(); }

 private:
  RandomReport report_;
};

void TestRandomScenes::everyLevelKeepsItsPromise_data() {
  QTest::addColumn<int>("family");
  QTest::addColumn<quint64>("seed");
  const auto [first, pieces] = seedsOf(70, 600);
  const QString only = qEnvironmentVariable("VOLUMEN_RANDOM_FAMILY");
  const auto countOf = [&, pieces = pieces](Family family) {
    if (!only.isEmpty()) return only == QLatin1String(nameOf(family)) ? pieces : 0;
    if (family == Family::attack) return seedsOf(300, 1500).count;
    return family == Family::pieces ? pieces : (pieces + 1) / 2;
  };
  for (Family family : families)
    for (int n = 0; n < countOf(family); ++n)
      QTest::addRow("%s, seed %d", nameOf(family), first + n) << int(family) << quint64(first + n);
  if (!only.isEmpty()) return;
  for (int seed : foundHard) QTest::addRow("hard, found seed %d", seed) << int(Family::hard) << quint64(seed);
  for (int seed : foundHostile)
    QTest::addRow("hostile, found seed %d", seed) << int(Family::hostile) << quint64(seed);
}

void TestRandomScenes::everyLevelKeepsItsPromise() {
  QFETCH(int, family);
  QFETCH(quint64, seed);
  const RandomCase c = randomCase(Family(family), seed);
  NEED_VOLUME(c.volume);
  const Status valid = validateScene(c.scene);
  QVERIFY2(valid.ok(), valid.ok() ? "" : valid.message().c_str());
  RenderCaches caches(c.volume);
  Truth truth(caches, c.scene, c.size);
  QStringList broken;
  for (const Promise& promise : promises) {
    const RenderOptions options = atLevel(promise.quality);
    const Rendered rendered = truth.rendered(options);
    const PictureError e = truth.errorOf(rendered.picture, promise);
    if (!rendered.error.empty())
      report_.addEstimate(std::string(QTest::currentDataTag()) + ", " + promise.name, rendered.error,
                          truth.errorOfPixels(rendered.picture));
    QStringList faults = faultsOf(truth, rendered.picture, options);
    if (!promise.keptBy(e)) faults << QStringLiteral("promise broken");
    const bool failed = !faults.isEmpty();
    if (failed || figuresWanted()) faults << errorInWords(truth, rendered.picture, e);
    const QString words =
        QLatin1String(promise.name) + QStringLiteral(": ") + faults.join(QStringLiteral(", "));
    report_.add({Family(family), seed, c.scene.mode, &promise, e, failed, words.toStdString()});
    if (figuresWanted())
      std::fprintf(stderr, "%s (%s, %s) | %s\n", QTest::currentDataTag(), c.what.c_str(),
                   nameOf(c.scene.mode), qPrintable(words));
    if (failed) broken << words;
  }
  report_.addPicture(Family(family), truth.reference(), truth.illConditionedShare());
  if (!broken.isEmpty() && qEnvironmentVariableIsSet("VOLUMEN_RANDOM_BRUTE")) printBruteForce(truth, c);
  const QByteArray folder = qgetenv("VOLUMEN_RANDOM_SAVE");
  if (!broken.isEmpty() && !folder.isEmpty()) save(c, Family(family), seed, folder.toStdString());
  QVERIFY2(broken.isEmpty(), qPrintable(broken.join(QStringLiteral("; "))));
}

// Covers all pixels drawn above: a picture's stated error bounds its true error.
void TestRandomScenes::errorsAreAsTold() { QVERIFY(report_.shareBeyondEstimate() <= 0.001); }

VOLUMEN_TEST(TestRandomScenes);
#include "tst_random_scenes.moc"
