#include "tests/unit/promises/promises.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "tests/fixtures/need_gl.h"
#include "viewer/plan/rule_lines.h"
#include "viewer/reference/reference.h"

namespace volumen::tests {
namespace {

template <class T>
T orThrow(Result<T> result) {
  if (!result) throw std::runtime_error(result.message());
  return std::move(*result);
}

}  // namespace

DraftError draftErrorOf(const Picture& draft, const Picture& standard) {
  constexpr int edge = draftPromise.blockEdge;
  const glm::ivec2 blocks = standard.size / edge;
  double squares = 0;
  glm::dvec4 all(0);
  for (int by = 0; by < blocks.y; ++by)
    for (int bx = 0; bx < blocks.x; ++bx) {
      glm::dvec4 mean(0);
      for (int n = 0; n < edge * edge; ++n) {
        const int x = bx * edge + n % edge, y = by * edge + n / edge;
        for (int c = 0; c < 4; ++c)
          mean[c] += 255 * (double(draft.row(y)[4 * x + c]) - double(standard.row(y)[4 * x + c]));
      }
      mean /= edge * edge;
      squares += glm::dot(mean, mean) / componentsThatDiffer(standard.transparent);
      all += mean;
    }
  const double count = double(blocks.x) * blocks.y;
  const glm::dvec4 off = glm::abs(all / count);
  return {std::sqrt(squares / count), std::max({off.r, off.g, off.b, off.a})};
}

QString inWords(const DraftError& e) {
  return QStringLiteral("RMSE of blocks %1, mean colour off by %2").arg(e.rmseOfBlocks).arg(e.meanColour);
}

std::vector<DrawWay> promisedWays() {
  std::vector<DrawWay> ways = drawWays();
  std::erase_if(ways, [](const DrawWay& way) { return !way.promised || way.slow; });
  return ways;
}

std::vector<DrawWay> drawWays() {
  std::vector<DrawWay> ways;
  const auto add = [&](const char* name, bool promised, auto ask) -> DrawWay& {
    DrawWay& way = ways.emplace_back(DrawWay{name, {}, promised});
    ask(way.options);
    return way;
  };
  add("planes", true, [](RenderOptions&) {});
  add("planes, 32 bits", true, [](RenderOptions& o) { o.precision = 32; });
  add("blend", true, [](RenderOptions& o) { o.method = Method::blend; });
  add("preshaded", false, [](RenderOptions& o) { o.method = Method::preshaded; });
  if (!whyNoGl().isEmpty()) return ways;
  add("planes, OpenGL", true, [](RenderOptions& o) { o.resampler = Resampler::gl; });
  add("blend, OpenGL", true, [](RenderOptions& o) {
    o.method = Method::blend;
    o.resampler = Resampler::gl;
  }).slow = true;
  add("gpu", true, [](RenderOptions& o) { o.method = Method::gpu; }).slow = true;
  return ways;
}

bool DrawWay::usesOpenGl() const { return resamplerOf(options) == Resampler::gl; }

bool DrawWay::mayRefuse(const Scene& scene, const Volume& volume) const {
  const glm::ivec3 size = volume.size();
  return (usesOpenGl() && std::max({size.x, size.y, size.z}) > 2048) ||
         (options.method == Method::preshaded && scene.mode != Mode::composite);
}

Truth::Truth(RenderCaches& caches, Scene scene, glm::ivec2 size)
    : caches_(caches), scene_(std::move(scene)), size_(size) {}

Rendered Truth::rendered(RenderOptions options) {
  options.size = size_;
  const Plan plan = orThrow(makePlan(scene_, caches_.facts(), options));
  complete_ = plan.scene;
  return orThrow(render(plan, caches_));
}

const Picture& Truth::reference() {
  RenderOptions options;
  options.method = Method::reference;
  if (!reference_) reference_ = drawn(options);
  return *reference_;
}

const std::vector<std::uint8_t>& Truth::use() {
  reference();
  if (!use_) use_ = orThrow(wellConditioned(*complete_, *caches_.volume(), size_));
  return *use_;
}

PictureError Truth::errorOf(const Picture& picture, const Promise& promise) {
  const PictureError everywhere = compare(picture, reference());
  return promise.keptBy(everywhere) ? everywhere : errorOf(picture);
}

PictureError Truth::errorOf(const Picture& picture) { return compare(picture, reference(), use()); }

std::vector<double> Truth::errorOfPixels(const Picture& picture) {
  std::vector<double> errors(use().size(), 0);
  for (std::size_t n = 0; n < 4 * errors.size(); ++n)
    if (use()[n / 4])
      errors[n / 4] =
          std::max(errors[n / 4], 255 * std::abs(double(picture.rgba[n]) - double(reference().rgba[n])));
  return errors;
}

double Truth::illConditionedShare() {
  return double(std::count(use().begin(), use().end(), 0)) / double(use().size());
}

}  // namespace volumen::tests
