// Guards design.md 3 (the GL resampler) and picture.md 2, 3 and 9 as OpenGL interpolates.
#include <cmath>
#include <functional>
#include <map>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/need_gl.h"
#include "tests/fixtures/picture_words.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/render/method_cases.h"
#include "tests/unit/render/picture_cases.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

/// Returns waves in -200 .. 1200 on an oblique, sheared, anisotropic grid, as integers of type T.
template <class T>
VolumePtr integers(glm::ivec3 size, double slope, double intercept) {
  VolumeParts parts;
  parts.geometry.size = size;
  parts.geometry.patientFromVoxelStep = glm::dmat3({0.8, 0.3, 0}, {-0.3, 0.9, 0.1}, {0.1, 0, 1.7});
  parts.geometry.origin = {-10, -12, -14};
  parts.slope = slope;
  parts.intercept = intercept;
  std::vector<T> values;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const double real = 500 + 350 * (std::sin(0.41 * i + 0.3) + std::sin(0.37 * j) * std::cos(0.33 * k));
        values.push_back(T((real - intercept) / slope));
      }
  parts.values = std::move(values);
  return volumeFrom(std::move(parts));
}

VolumePtr volumeNamed(const std::string& name) {
  if (name == "int16") return integers<std::int16_t>({26, 22, 18}, 0.5, -100);
  if (name == "rows apart") return integers<std::int16_t>({256, 8, 7}, 0.5, -100);
  if (name == "uint16") return integers<std::uint16_t>({25, 22, 18}, 0.05, -1000);
  if (name == "uint8") return integers<std::uint8_t>({26, 22, 18}, 8, -300);
  if (name == "one slice") return integers<std::int16_t>({26, 22, 1}, 1, 0);
  if (name == "one column") return integers<std::int16_t>({1, 22, 18}, 1, 0);
  if (name == "uint16, one column") return integers<std::uint16_t>({1, 22, 18}, 0.05, -1000);
  return *makePhantom(name);
}

struct Case {
  const char* name;
  const char* volume;
  glm::ivec2 size;
  std::function<void(Scene&, RenderOptions&)> change;
};

using Change = void (*)(Scene&);

void perspective(Scene& s) { s.camera->projection = Projection::perspective; }

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"parallel, lit", "int16", {40, 40}, [](Scene&, auto&) {}},
      {"perspective", "int16", {40, 40}, [](Scene& s, auto&) { perspective(s); }},
      {"eye inside",
       "int16",
       {40, 40},
       [](Scene& s, auto&) {
         perspective(s);
         s.camera->distance = 4;
         s.camera->fov = 75;
       }},
      {"wide picture: several strips a row", "int16", {150, 30}, [](Scene& s, auto&) { perspective(s); }},
      {"high picture, narrow rows", "int16", {3, 90}, [](Scene&, auto&) {}},
      {"one pixel", "int16", {1, 1}, [](Scene&, auto&) {}},
      {"fine steps: many batches, strips of few rays",
       "int16",
       {70, 6},
       [](Scene&, RenderOptions& o) { o.step = 1.0 / 1024; }},
      {"unlit", "int16", {40, 40}, [](Scene& s, auto&) { s.shading.lit = false; }},
      {"reflectance map", "int16", {40, 40}, [](Scene&, RenderOptions& o) { o.shader = Shader::map; }},
      {"local viewer",
       "int16",
       {40, 40},
       [](Scene& s, auto&) {
         perspective(s);
         s.shading.localViewer = true;
       }},
      {"gradient opacity",
       "int16",
       {40, 40},
       [](Scene& s, auto&) {
         s.transferFunction.gradientOpacity = {{15, 0}, {60, 0.4}, {160, 1}};
       }},
      {"gradient opacity, unlit",
       "int16",
       {40, 40},
       [](Scene& s, auto&) {
         s.shading.lit = false;
         s.transferFunction.gradientOpacity = {{15, 1}, {160, 0}};
       }},
      {"clip box and plane",
       "int16",
       {40, 40},
       [](Scene& s, auto&) {
         s.clip.boxLow = {0.2, 0.05, 0.3};
         s.clip.planes = {{{1, 2, -0.5}, 3}};
       }},
      {"no ray meets the volume",
       "int16",
       {40, 40},
       [](Scene& s, auto&) {
         s.clip.planes = {{{0, 0, 1}, -1000}};
         s.background.colour = {0.2, 0.4, 0.6};
       }},
      {"transparent background", "int16", {40, 40}, [](Scene& s, auto&) { s.background.transparent = true; }},
      {"mip", "int16", {40, 40}, [](Scene& s, auto&) { s.mode = Mode::mip; }},
      {"minip, transparent",
       "int16",
       {40, 40},
       [](Scene& s, auto&) {
         s.mode = Mode::minip;
         s.background.transparent = true;
       }},
      {"average", "int16", {40, 40}, [](Scene& s, auto&) { s.mode = Mode::average; }},
      {"full: no rule leaves anything out",
       "int16",
       {40, 40},
       [](Scene&, RenderOptions& o) { o.full = true; }},
      {"unsigned 16 bits", "uint16", {40, 40}, [](Scene&, auto&) {}},
      {"bytes", "uint8", {40, 40}, [](Scene&, auto&) {}},
      {"rows of 2048 bytes, which lie apart",
       "rows apart",
       {40, 40},
       [](Scene& s, auto&) { s.camera->height = 20; }},
      {"one slice", "one slice", {40, 40}, [](Scene&, auto&) {}},
      {"one column", "one column", {40, 40}, [](Scene&, auto&) {}},
      {"one column, unsigned", "uint16, one column", {40, 40}, [](Scene&, auto&) {}},
      {"curve step exactly at constant parts",
       "sphere:24",
       {40, 40},
       [](Scene& s, auto&) {
         s.transferFunction.points = {{1, {0.9, 0.4, 0.3}, 0}, {1, {0.9, 0.4, 0.3}, 0.2}};
       }},
      {"head", "ct-head:64", {64, 64}, [](Scene& s, auto&) { s.camera->height = 300; }},
  };
  return all;
}

}  // namespace

Q_DECLARE_METATYPE(Change)

class TestGl : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void agreesWithCpu_data();
  void agreesWithCpu();
  void chestAgreesWithCpu_data();
  void chestAgreesWithCpu();
  void longRaysOfOneShaderAgreeWithCpu_data();
  void longRaysOfOneShaderAgreeWithCpu();

 private:
  RenderCaches& cachesOf(const std::string& name);
  void compareResamplers(RenderCaches& caches, const Scene& scene, RenderOptions options);

  std::map<std::string, RenderCaches> caches_;
};

RenderCaches& TestGl::cachesOf(const std::string& name) {
  return caches_.try_emplace(name, caches_.count(name) ? nullptr : volumeNamed(name)).first->second;
}

// In 32 bits the shader performs the CPU's operations one by one. A compiler without `precise` may fuse a
// multiply and an add, which moves positions and densities by a few units in the last place.
// In 16 bits the hardware filters. llvmpipe filters in floats. Its coordinates are scaled to 0..1 and back,
// which moves positions by a few 1e-5 voxel, and the CPU's weights are multiples of 1/32768. At a step of the
// curve a sample that close may fall on either side, in one pixel of thousands.
// GPUs may keep 8 bits of the position between two voxels. The error is up to 1/512 of the neighbours'
// difference on each axis. With such positions, ct-head and chest CT with presets of bone, muscle and skin
// have RMSE 0.02 .. 0.07 and a maximum of 1.4. Thin bright shells (preset CT-Lung) have RMSE 1.3.
void TestGl::compareResamplers(RenderCaches& caches, const Scene& scene, RenderOptions options) {
  options.step = 0.25;  // the CPU would integrate a level
  options.resampler = Resampler::cpu;
  const auto cpu = planAndDraw(caches, scene, options);
  options.resampler = Resampler::gl;
  const auto gl = planAndDraw(caches, scene, options);
  QVERIFY2(cpu.ok(), cpu.ok() ? "" : cpu.message().c_str());
  QVERIFY2(gl.ok(), gl.ok() ? "" : gl.message().c_str());
  const PictureError e = compare(gl->picture, cpu->picture);
  const bool llvmpipe = gl->stats.kernel.find("llvmpipe") == 0;
  if (*options.precision == 32)
    QVERIFY2(llvmpipe ? gl->picture == cpu->picture : e.rmse <= 0.05, qPrintable(inWords(e)));
  else
    QVERIFY2(llvmpipe ? e.percentile99 <= 0.05 && e.rmse <= 0.1 : e.rmse <= 1.5, qPrintable(inWords(e)));
  QVERIFY(gl->stats.resampled >= cpu->stats.composited);
}

void TestGl::agreesWithCpu_data() {
  QTest::addColumn<int>("index");
  QTest::addColumn<int>("bits");
  for (std::size_t n = 0; n < cases().size(); ++n)
    for (int bits : {16, 32}) QTest::addRow("%s, %d bits", cases()[n].name, bits) << int(n) << bits;
}

void TestGl::agreesWithCpu() {
  NEED_GL();
  QFETCH(int, index);
  QFETCH(int, bits);
  const Case& c = cases()[index];
  Scene scene = softScene();
  RenderOptions options;
  options.size = c.size;
  options.precision = bits;
  c.change(scene, options);
  compareResamplers(cachesOf(c.volume), scene, options);
}

void TestGl::chestAgreesWithCpu_data() {
  QTest::addColumn<int>("bits");
  for (int bits : {16, 32}) QTest::addRow("%d bits", bits) << bits;
}

void TestGl::chestAgreesWithCpu() {
  NEED_GL();
  QFETCH(int, bits);
  for (const PictureCase& c : pictureCases()) {
    if (c.name != std::string("chest CT, bench scene bone")) continue;
    const VolumePtr volume = caseVolume(c.volume);
    NEED_VOLUME(volume);
    RenderOptions options;
    options.size = {48, 40};
    options.step = 1;
    options.precision = bits;
    RenderCaches& caches = caches_.try_emplace(c.volume, volume).first->second;
    return compareResamplers(caches, c.scene, options);
  }
  QFAIL("there is no such case");
}

void TestGl::longRaysOfOneShaderAgreeWithCpu_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<double>("step");
  const auto row = [](const char* name, double step, Change change) {
    QTest::newRow(name) << change << step;
  };
  row("100,000 steps", 1.0 / 1024, [](Scene&) {});
  row("64 lights at 2000 steps", 1.0 / 20, [](Scene& s) { s.lights.resize(64, s.lights[0]); });
  row("mip of 100,000 steps", 1.0 / 1024, [](Scene& s) { s.mode = Mode::mip; });
  row("average of 100,000 steps", 1.0 / 1024, [](Scene& s) { s.mode = Mode::average; });
}

// llvmpipe ends a shader after 65,536 loop iterations. The visible matter lies beyond them.
void TestGl::longRaysOfOneShaderAgreeWithCpu() {
  NEED_GL();
  QFETCH(Change, change);
  QFETCH(double, step);
  RenderCaches caches(volumeOf({3, 100, 3}, glm::dmat3(1), [](glm::dvec3 x) { return 10 * x.y; }));
  Scene scene;
  scene.transferFunction.points = {
      {0, {0.2, 0.5, 1}, 0}, {900, {0.2, 0.5, 1}, 1e-3}, {990, {1, 0.6, 0.3}, 0.5}};
  scene.shading.gradientFloor = 1;
  scene.lights[0].intensity = 0.05;
  scene.camera = Camera{.target = glm::dvec3(0), .height = 2};
  change(scene);
  RenderOptions options;
  options.size = {2, 2};
  options.step = step;
  const auto cpu = planAndDraw(caches, scene, options);
  options.method = Method::gpu;
  const auto gpu = planAndDraw(caches, scene, options);
  QVERIFY2(gpu.ok(), gpu.ok() ? "" : gpu.message().c_str());
  const PictureError e = compare(gpu->picture, cpu->picture);
  QVERIFY2(e.maximum <= 0.1, qPrintable(inWords(e)));
}

VOLUMEN_TEST(TestGl);
#include "tst_gl.moc"
