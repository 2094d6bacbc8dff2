#include "viewer/recipe/scissors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

using ScissorsPlaces = std::vector<glm::dvec3>;

// Returns a unit vector perpendicular to a unit vector.
glm::dvec3 unitAcross(glm::dvec3 unit) {
  const glm::dvec3 a = glm::abs(unit);
  const glm::dvec3 least = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                           : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                    : glm::dvec3(0, 0, 1);
  return glm::normalize(glm::cross(unit, least));
}

// Returns the lasso through these points, seen from the first point of the line of sight.
Result<Lasso> lassoThrough(const ScissorsPlaces& outline, const ScissorsPlaces& sight, bool perspective) {
  if (outline.size() < 3) return Error{"outline must be three places or more"};
  if (sight.size() != 2 || !(glm::distance(sight[0], sight[1]) > 0))
    return Error{"sight must be two places, one behind the other"};
  const glm::dvec3 forward = glm::normalize(sight[1] - sight[0]);
  Lasso lasso;
  lasso.origin = sight[0];
  lasso.right = unitAcross(forward);
  lasso.down = glm::cross(forward, lasso.right);
  lasso.perspective = perspective;
  for (const glm::dvec3& place : outline) {
    const glm::dvec3 d = place - lasso.origin;
    const double depth = perspective ? glm::dot(d, forward) : 1;
    if (!(depth > 0)) return Error{"outline must lie before the first place of sight, the eye"};
    lasso.points.push_back(glm::dvec2(glm::dot(d, lasso.right), glm::dot(d, lasso.down)) / depth);
  }
  return lasso;
}

}  // namespace

Step scissorsStep(const std::string& segment, const Lasso& lasso, double withinMm) {
  ScissorsPlaces outline;
  const glm::dvec3 middle = lasso.perspective ? lasso.origin + lasso.forward() : lasso.origin;
  for (const glm::dvec2 p : lasso.points) outline.push_back(middle + p.x * lasso.right + p.y * lasso.down);
  return {"scissors",
          segment,
          {{"outline", outline},
           {"sight", ScissorsPlaces{lasso.origin, lasso.origin + lasso.forward()}},
           {"perspective", lasso.perspective},
           {"keep", !lasso.inside},
           {"withinMm", withinMm}}};
}

Result<BitMask> leftByScissors(const StepInput& in) {
  Result<Lasso> lasso = lassoThrough(in.places("outline"), in.places("sight"), in.flag("perspective"));
  if (!lasso) return lasso.error();
  lasso->inside = !in.flag("keep");
  return leftBy(in.own(), *lasso, in.number("withinMm"), in.cancel);
}

}  // namespace volumen
