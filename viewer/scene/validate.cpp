#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "viewer/scene/number_text.h"
#include "viewer/scene/scene_json.h"

namespace volumen {

namespace {

// Keeps the first broken rule (picture.md 8, table of allowed values) as a sentence.
class Rules {
 public:
  std::string problem;

  void require(bool kept, const std::string& path, const std::string& sentence) {
    if (!kept && problem.empty()) problem = path + " " + sentence + ".";
  }
  void finite(const std::string& path, double value) {
    require(std::isfinite(value), path, "must be a finite number");
  }
  void finite(const std::string& path, const glm::dvec3& v) {
    for (int a = 0; a < 3; ++a) finite(path + "[" + std::to_string(a) + "]", v[a]);
  }
  void positive(const std::string& path, double value) {
    finite(path, value);
    require(value > 0, path, "must be > 0, not " + numberText(value));
  }
  // The square of a length must be an ordinary number.
  void length(const std::string& path, double value) {
    positive(path, value);
    within(path, value, 1e-30, 1e30);
  }
  void notNegative(const std::string& path, double value) {
    finite(path, value);
    require(value >= 0, path, "must be >= 0, not " + numberText(value));
  }
  void within(const std::string& path, double value, double low, double high) {
    finite(path, value);
    require(low <= value && value <= high, path,
            "must be in " + numberText(low) + " .. " + numberText(high) + ", not " + numberText(value));
  }
  void colour(const std::string& path, const glm::dvec3& v) {
    for (int a = 0; a < 3; ++a) within(path + "[" + std::to_string(a) + "]", v[a], 0, 1);
  }
  // A direction may have any length whose square is an ordinary number.
  void direction(const std::string& path, const glm::dvec3& v) {
    finite(path, v);
    require(v != glm::dvec3(0), path, "must not be zero");
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    require(largest >= 1e-100 && largest <= 1e100, path, "must have a length of 1e-100 .. 1e100");
  }
  void count(const std::string& path, std::size_t size, std::size_t least, std::size_t most,
             const char* what) {
    require(least <= size && size <= most, path,
            "must hold " + std::to_string(least) + " to " + std::to_string(most) + " " + what + ", not " +
                std::to_string(size));
  }
};

std::string item(const char* list, std::size_t n) {
  return std::string(list) + "[" + std::to_string(n) + "]";
}

template <class Number>
void inOrder(Rules& rules, const char* list, const char* field, std::size_t n, Number before, Number value) {
  rules.require(before <= value, item(list, n) + "." + field,
                "must not be below " + item(list, n - 1) + "." + field + " = " + numberText(before) +
                    ", but is " + numberText(value));
}

void check(Rules& rules, const TransferFunction& curve) {
  static constexpr const char* points = "transferFunction.points";
  static constexpr const char* factors = "transferFunction.gradientOpacity";
  rules.positive("transferFunction.unitDistance", curve.unitDistance);
  rules.count(points, curve.points.size(), 1, 256, "points");
  rules.count(factors, curve.gradientOpacity.size(), 0, 256, "points");
  if (!rules.problem.empty()) return;
  for (std::size_t n = 0; n < curve.points.size(); ++n) {
    const CurvePoint& p = curve.points[n];
    rules.finite(item(points, n) + ".value", double(p.value));
    rules.colour(item(points, n) + ".colour", p.colour);
    rules.within(item(points, n) + ".opacity", p.opacity, 0, 1);
    if (n) inOrder(rules, points, "value", n, curve.points[n - 1].value, p.value);
  }
  for (std::size_t n = 0; n < curve.gradientOpacity.size(); ++n) {
    const GradientOpacityPoint& p = curve.gradientOpacity[n];
    rules.finite(item(factors, n) + ".gradient", p.gradient);
    rules.within(item(factors, n) + ".factor", p.factor, 0, 1);
    if (n) inOrder(rules, factors, "gradient", n, curve.gradientOpacity[n - 1].gradient, p.gradient);
  }
}

void check(Rules& rules, const Shading& shading) {
  rules.require(shading.sides == 1 || shading.sides == 2, "shading.sides",
                "must be 1 or 2, not " + std::to_string(shading.sides));
  if (shading.gradientFloor) rules.positive("shading.gradientFloor", *shading.gradientFloor);
  rules.notNegative("shading.ambient", shading.ambient);
  rules.notNegative("shading.diffuse", shading.diffuse);
  rules.notNegative("shading.specular", shading.specular);
  rules.within("shading.shininess", shading.shininess, 1, 10000);
}

void check(Rules& rules, const std::vector<Light>& lights) {
  rules.count("lights", lights.size(), 0, 64, "lights");
  if (!rules.problem.empty()) return;
  for (std::size_t n = 0; n < lights.size(); ++n) {
    rules.direction(item("lights", n) + ".direction", lights[n].direction);
    rules.colour(item("lights", n) + ".colour", lights[n].colour);
    rules.notNegative(item("lights", n) + ".intensity", lights[n].intensity);
  }
}

void check(Rules& rules, const Camera& camera) {
  if (camera.target)
    for (int a = 0; a < 3; ++a)
      rules.within("camera.target[" + std::to_string(a) + "]", (*camera.target)[a], -1e30, 1e30);
  rules.direction("camera.direction", camera.direction);
  rules.direction("camera.up", camera.up);
  if (!rules.problem.empty()) return;
  const double sine = glm::length(glm::cross(glm::normalize(camera.direction), glm::normalize(camera.up)));
  rules.require(sine > 1e-9, "camera.up", "is parallel to camera.direction");
  rules.length("camera.height", camera.height);
  rules.within("camera.fov", camera.fov, 0.1, 170);
  rules.length("camera.distance", camera.distance);
}

void check(Rules& rules, const Clip& clip) {
  for (int a = 0; a < 3; ++a) {
    const double low = clip.boxLow[a], high = clip.boxHigh[a];
    rules.require(0 <= low && low <= high && high <= 1, item("clip.box", std::size_t(a)),
                  "must be [low, high] with 0 <= low <= high <= 1, not [" + numberText(low) + ", " +
                      numberText(high) + "]");
  }
  rules.count("clip.planes", clip.planes.size(), 0, 6, "planes");
  for (std::size_t n = 0; n < clip.planes.size(); ++n) {
    rules.direction(item("clip.planes", n) + ".normal", clip.planes[n].normal);
    rules.finite(item("clip.planes", n) + ".offset", clip.planes[n].offset);
  }
}

void check(Rules& rules, const std::vector<SegmentSurface>& segments) {
  rules.count("segments", segments.size(), 0, 255, "segments");
  for (std::size_t n = 0; n < segments.size(); ++n) {
    rules.require(segments[n].field != nullptr, item("segments", n) + ".field", "must be set");
    rules.colour(item("segments", n) + ".colour", segments[n].colour);
    rules.within(item("segments", n) + ".opacity", segments[n].opacity, 0, 1);
  }
}

}  // namespace

Status validateScene(const Scene& scene) {
  Rules rules;
  if (scene.window) {
    rules.finite("window.centre", scene.window->centre);
    rules.finite("window.width", scene.window->width);
    rules.require(scene.window->width != 0, "window.width", "must not be 0");
  }
  check(rules, scene.transferFunction);
  check(rules, scene.shading);
  check(rules, scene.lights);
  if (scene.camera) check(rules, *scene.camera);
  check(rules, scene.clip);
  if (!scene.background.transparent) rules.colour("background", scene.background.colour);
  check(rules, scene.segments);
  if (!rules.problem.empty()) return Error{rules.problem};
  return {};
}

}  // namespace volumen
