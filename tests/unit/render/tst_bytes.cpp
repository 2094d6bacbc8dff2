// Guards design.md 3 (stored precision of 8 bits), and for it design.md 2 (determinism) and design.md 5
// (full). The picture must be that of the volume rounded to bytes, as drawn by brute force in double
// precision.
#include <algorithm>
#include <cmath>
#include <map>

#include "tests/fixtures/brute_force.h"
#include "tests/unit/render/method_cases.h"
#include "tests/unit/render/random_scenes.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/reference/reference.h"
#include "viewer/render/render.h"
#include "viewer/volume/bytes.h"
#include "viewer/volume/histogram.h"

using namespace volumen;
using namespace volumen::tests;

class TestBytes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theRoundedVolumeIsDrawn_data();
  void theRoundedVolumeIsDrawn();
  void thePictureIsOffByWhatRoundingExplains_data();
  void thePictureIsOffByWhatRoundingExplains();
  void aVolumeOf256ValuesLosesNothing();
  void constantRegionsStayConstant();
  void threadsAndFullChangeNoByte_data();
  void threadsAndFullChangeNoByte();
  void scenesOfChanceAreFiniteAndTheSameEveryWay();
  void blocksAreJudgedByWhatIsDrawn();
  void bytesHeld();
};

namespace {

constexpr glm::ivec2 size{36, 30};

VolumePtr volumeNamed(const std::string& name) { return name == "wavy" ? wavyVolume() : *makePhantom(name); }

/// A volume rounded to bytes, as real values and gradients.
struct Rounded {
  VolumePtr volume;
  std::vector<glm::dvec3> gradients;  ///< value per voxel
  double gradientUnit;
};

Rounded rounded(const Volume& from) {
  const Voxels8 v = voxels8By(from, GradientOperator::sobel, byteScale(from, valueRange(from)));
  VolumeParts parts;
  parts.geometry = from.geometry();
  std::vector<float> values;
  Rounded r;
  const std::size_t row = std::size_t(from.size().x);
  for (std::size_t n = 0; n < std::size_t(from.geometry().voxelCount()); ++n) {
    const std::uint32_t word = v.row(n / row)[n % row];
    values.push_back(float(v.scale.low + v.scale.unit * (word >> 24)));
    const auto g = [&](int a) { return double(std::int8_t(word >> 8 * a & 255)); };
    r.gradients.push_back(v.gradientUnit * glm::dvec3(g(0), g(1), g(2)));
  }
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  r.volume = *Volume::make(std::move(parts), warnings);
  r.gradientUnit = v.gradientUnit;
  return r;
}

Rendered drawn(const Scene& scene, RenderCaches& caches, RenderOptions options) {
  options.size = size;
  const auto plan = makePlan(scene, caches.facts(), options);
  if (!plan) throw std::runtime_error(plan.message());
  return *render(*plan, caches);
}

RenderOptions inBytes(double step, Method method = Method::planes) {
  RenderOptions options;
  options.precision = 8;
  options.step = step;
  options.method = method;
  return options;
}

/// Returns a scene whose opacity rises over all values of a volume. It has one colour, and light without
/// highlights from all sides.
Scene translucentScene(const Volume& volume, double opacity, bool lit) {
  const ValueRange range = valueRange(volume);
  Scene scene;
  scene.transferFunction = {
      1, {{float(range.low), {1, 1, 1}, 0}, {float(range.high), {1, 1, 1}, opacity}}, {}};
  scene.shading.lit = lit;
  scene.shading.specular = 0;
  return scene;
}

QString inWords(const PictureError& e) {
  return QStringLiteral("RMSE %1, 99th percentile %2, maximum %3 of 1/255")
      .arg(e.rmse)
      .arg(e.percentile99)
      .arg(e.maximum);
}

}  // namespace

void TestBytes::theRoundedVolumeIsDrawn_data() {
  QTest::addColumn<int>("wide");
  QTest::addColumn<int>("scene");
  QTest::addColumn<int>("method");
  // Rows of 512 voxels are far apart in memory.
  for (int wide : {26, 512})
    for (Method method : {Method::planes, Method::blend})
      for (std::size_t n = 0; n < methodScenes().size(); ++n)
        QTest::addRow("%d wide, %s: %s", wide, method == Method::planes ? "planes" : "blend",
                      methodScenes()[n].name.c_str())
            << wide << int(n) << int(method);
}

// Interpolation weights are multiples of 1/32768. They move a value by at most 7/2 of that times the range,
// which is 1e-4 of the range and a twentieth of rounding to bytes. The curve rises from 0.1 to 0.8 over 600
// of 1400 values. The worst case of all eight weights is thus an opacity of 1.3e-4 in half a voxel, 0.03/255.
// Errors have both signs, so that a ray's samples do not add up. The picture of 16 bits differs far more.
void TestBytes::theRoundedVolumeIsDrawn() {
  QFETCH(int, wide);
  QFETCH(int, scene);
  QFETCH(int, method);
  struct Wavy {
    VolumePtr volume;
    Rounded coarse = rounded(*volume);
    RenderCaches caches{volume};
    std::map<int, Picture> truths;
  };
  static std::map<int, Wavy> volumes;
  auto& [volume, coarse, caches, truths] =
      volumes.try_emplace(wide, wavyVolume({wide, 22, 18})).first->second;
  const Scene& s = methodScenes()[scene].scene;
  const auto [truth, isNew] = truths.try_emplace(scene);
  if (isNew)
    truth->second = bruteForce(completed(s, *volume, size), *coarse.volume, size, 0.5, coarse.gradients);
  RenderOptions options = inBytes(0.5, Method(method));
  if (Method(method) == Method::planes) options.stopAt = 0;
  const PictureError e = compare(drawn(s, caches, options).picture, truth->second);
  QVERIFY2(e.rmse <= 0.002 && e.percentile99 <= 0.02 && e.maximum <= 0.03, qPrintable(inWords(e)));
  options.precision = 16;
  QVERIFY(compare(drawn(s, caches, options).picture, truth->second).rmse > 0.015);
}

void TestBytes::thePictureIsOffByWhatRoundingExplains_data() {
  QTest::addColumn<QString>("volume");
  QTest::addColumn<bool>("lit");
  for (const char* volume : {"ct-head:40", "sphere:32", "wavy"})
    for (bool lit : {false, true})
      QTest::addRow("%s, %s", volume, lit ? "lit" : "unlit") << QString::fromLatin1(volume) << lit;
}

// Rounding a density by half a unit changes the opacity per mm by at most half a byte's share of its rise.
// The alpha of a ray changes by at most its length times the change of extinction. Its colour may change
// twice as much if light varies along it. Rounding each gradient component by half a unit moves g by
// sqrt(3)/2 units. D'' then changes by at most 2 diffuse per gradientFloor: at most 1/2 diffuse through q as
// (D' - E) / 2, and 3/2 diffuse through n, two sides included.
void TestBytes::thePictureIsOffByWhatRoundingExplains() {
  QFETCH(QString, volume);
  QFETCH(bool, lit);
  const VolumePtr v = volumeNamed(volume.toStdString());
  const double opacity = 0.05, step = 0.25;
  Scene scene = translucentScene(*v, opacity, lit);
  const glm::dvec3 spacing = v->geometry().spacing();
  const double gradientUnitPerMm = rounded(*v).gradientUnit / std::min({spacing.x, spacing.y, spacing.z});
  scene.shading.gradientFloor = 40 * gradientUnitPerMm;
  scene = completed(scene, *v, size);
  const Picture reference = *renderReference(scene, *v, size);
  const PictureError rule = compare(bruteForce(scene, *v, size, step), reference);

  const glm::dvec3 edges = spacing * glm::dvec3(v->size());
  const double longest = std::sqrt(glm::dot(edges, edges));
  const ByteScale scale = byteScale(*v, valueRange(*v));
  const double density = scale.exact ? 0 : opacity / 255 / 2 / (1 - opacity) * longest * (lit ? 2 : 1);
  const double light =
      lit ? 2 * scene.shading.diffuse * std::sqrt(0.75) * gradientUnitPerMm / *scene.shading.gradientFloor
          : 0;
  RenderCaches caches(v);
  const PictureError e = compare(drawn(scene, caches, inBytes(step)).picture, reference);
  const double bound = rule.maximum + 255 * (density + light) + 0.1;
  QVERIFY2(e.maximum <= bound, qPrintable(QStringLiteral("%1 > %2").arg(e.maximum).arg(bound)));
}

void TestBytes::aVolumeOf256ValuesLosesNothing() {
  const VolumePtr ball = *makePhantom("sphere:32");
  RenderCaches caches(ball);
  const Scene scene = translucentScene(*ball, 0.1, false);
  RenderOptions in16 = inBytes(1);
  in16.precision = 16;
  QVERIFY(drawn(scene, caches, inBytes(1)).picture == drawn(scene, caches, in16).picture);
}

// All voxels but two corners have one value, so that rays away from these meet only that value.
void TestBytes::constantRegionsStayConstant() {
  VolumeParts parts;
  parts.geometry.size = {20, 20, 20};
  std::vector<float> values(8000, 41.7f);
  values.front() = -1000, values.back() = 3071;
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  RenderCaches caches(*Volume::make(std::move(parts), warnings));
  Scene scene;
  scene.clip.boxLow = glm::dvec3(0.2);
  scene.clip.boxHigh = glm::dvec3(0.8);
  scene.camera = Camera{};
  scene.camera->direction = {0.4, 0.8, -0.3};
  scene.camera->height = 6;
  for (Method method : {Method::planes, Method::blend}) {
    scene.mode = Mode::mip;
    const Picture highest = drawn(scene, caches, inBytes(0.3, method)).picture;
    scene.mode = Mode::minip;
    const Picture lowest = drawn(scene, caches, inBytes(0.3, method)).picture;
    QVERIFY(highest == lowest);
    QCOMPARE(std::count(highest.rgba.begin(), highest.rgba.end(), highest.rgba.front()),
             std::ptrdiff_t(3) * size.x * size.y);
  }
}

void TestBytes::threadsAndFullChangeNoByte_data() { theRoundedVolumeIsDrawn_data(); }

void TestBytes::threadsAndFullChangeNoByte() {
  QFETCH(int, scene);
  QFETCH(int, method);
  static RenderCaches caches(wavyVolume());
  for (bool plain : {true, false}) {
    RenderOptions options = inBytes(0.5, Method(method));
    if (!plain) options.step.reset();
    options.threads = 1;
    const Scene& s = methodScenes()[scene].scene;
    const Picture one = drawn(s, caches, options).picture;
    for (int threads : {2, 7}) {
      options.threads = threads;
      QVERIFY2(drawn(s, caches, options).picture == one,
               qPrintable(QStringLiteral("%1 threads").arg(threads)));
    }
    options.full = true;
    QVERIFY2(drawn(s, caches, options).picture == one, "full");
  }
}

void TestBytes::scenesOfChanceAreFiniteAndTheSameEveryWay() {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const RandomScene chance = randomScene(seed);
    RenderCaches caches(chance.volume);
    for (Method method : {Method::planes, Method::blend}) {
      RenderOptions options = inBytes(0.7, method);
      options.size = chance.size;
      const auto draw = [&] {
        return render(*makePlan(chance.scene, caches.facts(), options), caches)->picture;
      };
      const Picture picture = draw();
      const QString where = QStringLiteral("seed %1, method %2").arg(seed).arg(int(method));
      for (float component : picture.rgba) QVERIFY2(component >= 0 && component <= 1, qPrintable(where));
      options.threads = 3;
      options.full = true;
      QVERIFY2(draw() == picture, qPrintable(where));
    }
  }
}

// In units of 2 the value 101 becomes 102, above the step. The blocks' value of 101 is below it.
void TestBytes::blocksAreJudgedByWhatIsDrawn() {
  VolumeParts parts;
  parts.geometry.size = {24, 24, 24};
  std::vector<std::int16_t> values(13824, 101);
  std::fill_n(values.begin(), 6912, std::int16_t(0));
  values.back() = 510;
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  RenderCaches caches(*Volume::make(std::move(parts), warnings));
  Scene scene;
  scene.transferFunction.points = {{101.5f, {1, 1, 1}, 0}, {101.5f, {1, 1, 1}, 0.1}};
  scene.shading.lit = false;
  RenderOptions options = inBytes(1);
  const Picture picture = drawn(scene, caches, options).picture;
  QVERIFY(std::count(picture.rgba.begin(), picture.rgba.end(), 0.0f) < std::ptrdiff_t(2) * size.x * size.y);
  options.full = true;
  QVERIFY(drawn(scene, caches, options).picture == picture);
}

void TestBytes::bytesHeld() {
  const VolumePtr volume = wavyVolume();
  const std::size_t voxels = std::size_t(volume->geometry().voxelCount());
  RenderCaches caches(volume);
  Scene scene;
  for (Method method : {Method::planes, Method::blend}) {
    scene.shading.lit = true;
    const RenderStats lit = drawn(scene, caches, inBytes(1, method)).stats;
    QCOMPARE(lit.densityBytes + lit.gradientBytes, 4 * voxels);
    scene.shading.lit = false;
    const RenderStats unlit = drawn(scene, caches, inBytes(1, method)).stats;
    QCOMPARE(unlit.densityBytes, voxels);
    QCOMPARE(unlit.gradientBytes, std::size_t(0));
  }
}

VOLUMEN_TEST(TestBytes);
#include "tst_bytes.moc"
