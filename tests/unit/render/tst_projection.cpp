// Guards design.md 5, empty blocks, for projections: skipping what cannot change a maximum or minimum changes
// no byte. Also guards design.md 2: projections are exact at every level.
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/render/random_scenes.h"
#include "tests/unit/suite.h"
#include "viewer/methods/caches.h"
#include "viewer/reference/reference.h"
#include "viewer/render/render.h"

namespace {

using namespace volumen;
using namespace volumen::tests;

using ValueAt = std::function<double(glm::dvec3 pVoxel)>;

template <class T>
VolumePtr stored(const ValueAt& valueAt, double slope = 1, double intercept = 0,
                 glm::ivec3 size = {43, 37, 29}) {
  return volumeOf<T>(size, {{1, 0, 0}, {0.1, 1, 0}, {0, 0.2, 2}}, valueAt, slope, intercept);
}

double ball(glm::dvec3 p) { return std::max(0.0, 500 - 30 * glm::distance(p, glm::dvec3(20, 18, 14))); }

// Returns `share` of the ball plus random noise of up to a fifth of its largest value.
ValueAt noisyBall(double share) {
  return [share, random = std::mt19937(5)](glm::dvec3 p) mutable {
    return share * (ball(p) + double(random() % 4096) / 40.96);
  };
}

// One voxel in eight has the lowest value.
ValueAt ofManyLowest() {
  return [value = noisyBall(1), random = std::mt19937(3)](glm::dvec3 p) mutable {
    return random() % 8 == 0 ? 0 : value(p);
  };
}

struct View {
  const char* name;
  void (*set)(Scene&);
  glm::ivec2 size{61, 50};
};
constexpr View views[] = {
    {"askew",
     [](Scene& s) {
       s.camera->direction = {0.3, 0.5, 0.8};
     }},
    {"along an axis",
     [](Scene& s) {
       s.camera->direction = {0, 0, 1};
     }},
    {"in perspective, from inside",
     [](Scene& s) {
       s.camera->projection = Projection::perspective;
       s.camera->distance = 10;
     }},
    {"with pixels far apart",
     [](Scene& s) {
       s.camera->direction = {1, 1, 1};
     },
     {9, 8}},
    {"with a target far away",
     [](Scene& s) {
       s.camera->direction = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
       s.camera->target = -4026532241.71875 * s.camera->direction;
     }},
    {"clipped",
     [](Scene& s) {
       s.camera->direction = {0.9, 0.1, 0.3};
       s.clip.boxLow = {0.21, 0, 0.33};
       s.clip.planes = {{{1, 1, 0}, 3}};
     }},
    {"clipped to a thin slab",
     [](Scene& s) {
       s.camera->direction = {0.3, 0.5, 0.8};
       s.clip.boxLow.z = 0.43;
       s.clip.boxHigh.z = 0.431;
     }},
    {"clipped away", [](Scene& s) { s.clip.boxLow.x = s.clip.boxHigh.x = 0.4; }},
    {"along the volume's second axis",
     [](Scene& s) {
       s.camera->direction = {0.1, 1, 0};
       s.camera->up = {0, 0, 1};
     }},
};

// The window resolves `part` of the values, about the extreme that the mode searches for.
Scene sceneOf(Mode mode, const ValueRange& range, double part) {
  Scene scene;
  scene.mode = mode;
  const double width = std::max(range.high - range.low, 1e-3);
  scene.window = Window{mode == Mode::minip ? range.low : range.high, 2 * part * width};
  Camera camera;
  camera.up = {0.1, 1, 0.2};
  camera.height = 60;
  scene.camera = camera;
  return scene;
}

}  // namespace

class TestProjection : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void sameBytesAsOfAllSamples_data();
  void sameBytesAsOfAllSamples();
  void levelsAreExact_data();
  void levelsAreExact();
  void randomScenesAreExact();
};

void TestProjection::sameBytesAsOfAllSamples_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::addColumn<int>("bits");     // 0 for the planned precision
  QTest::addColumn<double>("most");  // largest share of samples that an oblique maximum takes
  QTest::addColumn<double>("part");  // share of the values that the window shows
  const auto row = [](const char* name, const VolumePtr& volume, int bits, double most, double part = 1) {
    QTest::newRow(name) << volume << bits << most << part;
  };
  row("a ball", stored<std::int16_t>(ball), 0, 0.65);
  row("a ball in floats", stored<float>(ball), 0, 0.85);
  row("a ball in 8 bits", stored<std::int16_t>(ball), 8, 0.65);
  row("noise", stored<std::int16_t>(noisyBall(1)), 0, 0.87);
  row("noise in floats", stored<float>(noisyBall(1)), 0, 0.87);
  row("noise in 8 bits", stored<std::int16_t>(noisyBall(1)), 8, 0.87);
  row("unsigned noise", stored<std::uint16_t>(noisyBall(100)), 0, 0.87);
  row("many voxels of the smallest value", stored<std::int16_t>(ofManyLowest()), 0, 0.87);
  row("all alike", stored<std::int16_t>([](glm::dvec3) { return 7.0; }), 0, 0.1);
  row("far from 0: blocks in floats are coarse", stored<std::int16_t>(noisyBall(50), 1e-3, 1e5), 0, 0.87);
  row("one voxel of floats far below all others", stored<float>([n = noisyBall(1)](glm::dvec3 p) mutable {
        return p == glm::dvec3(9, 9, 9) ? -1e7 : n(p);
      }),
      0, 0.88);
  row("a slope below 0", stored<std::int16_t>(noisyBall(1), -2, 100), 0, 1);
  row("one voxel along i", stored<std::uint8_t>(noisyBall(0.4), 1, 0, {1, 37, 29}), 0, 1);
  row("one voxel along j", stored<std::int16_t>(noisyBall(1), 1, 0, {43, 1, 29}), 0, 1);
  row("one voxel along k", stored<float>(noisyBall(1), 1, 0, {43, 37, 1}), 0, 1);
  row("floats that interpolation leaves by its rounding",
      stored<float>([random = std::mt19937(2)](glm::dvec3) mutable { return random() % 16 ? 1.7 : -1e7; }), 0,
      1, 1e-6);
}

void TestProjection::sameBytesAsOfAllSamples() {
  QFETCH(VolumePtr, volume);
  QFETCH(int, bits);
  QFETCH(double, most);
  QFETCH(double, part);
  RenderCaches caches(volume);
  for (Mode mode : {Mode::mip, Mode::minip, Mode::average})
    for (const View& view : views) {
      Scene scene = sceneOf(mode, caches.facts().range, part);
      view.set(scene);
      RenderOptions options;
      options.size = view.size;
      if (bits > 0) options.precision = bits;
      const Rendered lean = *render(*makePlan(scene, caches.facts(), options), caches);
      options.full = true;
      const Rendered full = *render(*makePlan(scene, caches.facts(), options), caches);
      const QString name = QStringLiteral("%1, mode %2").arg(QLatin1String(view.name)).arg(int(mode));
      QVERIFY2(lean.picture == full.picture, qPrintable(name));
      const std::int64_t taken = lean.stats.resampled, all = full.stats.resampled;
      const double allowed = mode == Mode::mip && &view == views ? most : 1;
      QVERIFY2(mode == Mode::average ? taken == all : double(taken) <= allowed * double(all),
               qPrintable(name + QStringLiteral(", samples %1 of %2").arg(taken).arg(all)));
    }
}

void TestProjection::levelsAreExact_data() {
  QTest::addColumn<VolumePtr>("volume");
  const auto row = [](const char* name, const VolumePtr& volume) { QTest::newRow(name) << volume; };
  row("noise", stored<std::int16_t>(noisyBall(1)));
  row("noise in floats", stored<float>(noisyBall(1)));
  row("unsigned noise", stored<std::uint16_t>(noisyBall(100)));
  row("a slope below 0", stored<std::int16_t>(noisyBall(1), -2, 100));
  row("bytes", stored<std::uint8_t>(noisyBall(0.4)));
  row("left-handed",
      volumeOf<std::int16_t>({23, 37, 19}, {{-1, 0.3, 0}, {0, 1, 0.4}, {0.2, 0, 1}}, noisyBall(1)));
  row("one voxel along i", stored<std::int16_t>(noisyBall(1), 1, 0, {1, 37, 29}));
  row("one voxel along j", stored<float>(noisyBall(1), 1, 0, {43, 1, 29}));
  row("one voxel along k", stored<std::int16_t>(noisyBall(1), 1, 0, {43, 37, 1}));
  row("one voxel", stored<std::int16_t>([](glm::dvec3) { return 5.0; }, 1, 0, {1, 1, 1}));
  row("two voxels along each axis", stored<std::int16_t>(noisyBall(1), 1, 0, {2, 2, 2}));
  row("all alike", stored<std::int16_t>([](glm::dvec3) { return 7.0; }));
}

// The bound is that of a window an eighth as wide.
void TestProjection::levelsAreExact() {
  QFETCH(VolumePtr, volume);
  RenderCaches caches(volume);
  for (Mode mode : {Mode::mip, Mode::minip, Mode::average})
    for (const View& view : views) {
      Scene scene = sceneOf(mode, caches.facts().range, 1);
      const ValueRange range = caches.facts().range;
      // Floats resolve a range of one hundredth of the values' size equally well.
      const double size = std::max(std::abs(range.low), std::abs(range.high));
      scene.window = Window{(range.low + range.high) / 2, std::max(range.high - range.low, 1e-2 * size)};
      view.set(scene);
      std::optional<Picture> truth;
      for (Quality quality : {Quality::draft, Quality::standard, Quality::high, Quality::exact}) {
        RenderOptions options;
        options.size = view.size / 2;
        options.quality = quality;
        const Rendered done = *render(*makePlan(scene, caches.facts(), options), caches);
        if (!truth) truth = *renderReference(done.plan.scene, *volume, options.size);
        const double off = compare(done.picture, *truth).maximum;
        QVERIFY2(
            off <= 0.05 / 8,
            qPrintable(
                QStringLiteral("%1, mode %2: %3/255").arg(QLatin1String(view.name)).arg(int(mode)).arg(off)));
      }
    }
}

void TestProjection::randomScenesAreExact() {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    RandomScene random = randomScene(seed);
    RenderCaches caches(random.volume);
    for (Mode mode : {Mode::mip, Mode::minip, Mode::average}) {
      random.scene.mode = mode;
      RenderOptions options;
      options.size = random.size;
      const Rendered done = *render(*makePlan(random.scene, caches.facts(), options), caches);
      const Scene& scene = done.plan.scene;
      const PictureError e = compare(done.picture, *renderReference(scene, *random.volume, options.size),
                                     *wellConditioned(scene, *random.volume, options.size));
      QVERIFY2(
          e.maximum <= 0.05,
          qPrintable(QStringLiteral("seed %1, mode %2: %3/255").arg(seed).arg(int(mode)).arg(e.maximum)));
      options.full = true;
      QVERIFY(render(*makePlan(random.scene, caches.facts(), options), caches)->picture == done.picture);
    }
  }
}

VOLUMEN_TEST(TestProjection);
#include "tst_projection.moc"
