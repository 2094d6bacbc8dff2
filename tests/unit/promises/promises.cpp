#include "tests/unit/promises/promises.h"

#include <algorithm>
#include <stdexcept>

#include "viewer/render/reference.h"

namespace volumen::tests {
namespace {

template <class T>
T orThrow(Result<T> result) {
  if (!result) throw std::runtime_error(result.message());
  return std::move(*result);
}

}  // namespace

QString inWords(const PictureError& e) {
  return QStringLiteral("maximum %1, 99th percentile %2, PSNR %3 dB")
      .arg(e.maximum, 0, 'f', 2)
      .arg(e.percentile99, 0, 'f', 2)
      .arg(e.psnrDb, 0, 'f', 1);
}

std::vector<DrawWay> drawWays() {
  static const bool gl = makeEglContext().ok();
  std::vector<DrawWay> ways;
  const auto add = [&](const char* name, auto ask) { ask(ways.emplace_back(DrawWay{name, {}}).options); };
  add("planes", [](RenderOptions&) {});
  add("planes, 32 bits", [](RenderOptions& o) { o.precision = 32; });
  add("blend", [](RenderOptions& o) { o.method = Method::blend; });
  if (gl) add("planes, OpenGL", [](RenderOptions& o) { o.resampler = Resampler::gl; });
  return ways;
}

Truth::Truth(RenderCaches& caches, Scene scene, glm::ivec2 size)
    : caches_(caches), scene_(std::move(scene)), size_(size) {}

Picture Truth::drawn(RenderOptions options) {
  options.size = size_;
  const Plan plan = orThrow(makePlan(scene_, caches_.facts(), options));
  complete_ = plan.scene;
  return orThrow(render(plan, caches_)).picture;
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

double Truth::illConditionedShare() {
  return double(std::count(use().begin(), use().end(), 0)) / double(use().size());
}

}  // namespace volumen::tests
