#include "ui/views/contour_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "results/segments/region_colours.h"

namespace volumen {

namespace {

constexpr double cosineParallel = 0.999;

bool isClosed(const Contour& contour) {
  return contour.type == Contour::Type::closedPlanar || contour.type == Contour::Type::closedPlanarXor;
}

// Returns the normal of the plane of a closed contour (Newell); 0 if it has no area.
glm::dvec3 areaNormal(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0);
  for (std::size_t n = 0; n < points.size(); ++n)
    sum += glm::cross(points[n] - points[0], points[(n + 1) % points.size()] - points[0]);
  const double length = glm::length(sum);
  return length > 0 ? sum / length : glm::dvec3(0);
}

/// Projects the contours of one region onto a plane.
class Cutter {
 public:
  Cutter(const SlicePlane& plane, double reachMm, ContourLines& out)
      : plane_(plane), normal_(plane.normal()), reachMm_(reachMm), out_(out) {}

  void add(const Contour& contour) {
    if (contour.points.empty()) return;
    if (contour.type == Contour::Type::point) return addPoint(contour.points.front());
    const auto [low, high] = std::ranges::minmax(awayOf(contour.points));
    const bool isParallel = high - low < reachMm_ && liesAlong(contour);
    if (isParallel) {
      if (std::min(std::abs(low), std::abs(high)) <= reachMm_) addLine(contour);
    } else if (low <= 0 && high >= 0) {
      cut(contour);
    }
  }

 private:
  std::vector<double> awayOf(const std::vector<glm::dvec3>& points) const {
    std::vector<double> away(points.size());
    std::ranges::transform(points, away.begin(),
                           [&](glm::dvec3 p) { return glm::dot(p - plane_.centre, normal_); });
    return away;
  }

  bool liesAlong(const Contour& contour) const {
    return !isClosed(contour) || std::abs(glm::dot(areaNormal(contour.points), normal_)) > cosineParallel;
  }

  QPointF at(glm::dvec3 p) const {
    const glm::dvec2 pixel = plane_.pixelFromPatient(p);
    return {pixel.x, pixel.y};
  }

  void addPoint(glm::dvec3 p) {
    if (std::abs(glm::dot(p - plane_.centre, normal_)) <= reachMm_) out_.points.push_back(at(p));
  }

  void addLine(const Contour& contour) {
    QPolygonF line;
    for (const glm::dvec3& p : contour.points) line << at(p);
    if (isClosed(contour)) line << line.front();
    out_.lines.push_back(std::move(line));
  }

  // Adds the intersections of a line with the plane; for closed contours the chords inside.
  void cut(const Contour& contour) {
    const std::vector<glm::dvec3>& p = contour.points;
    const std::vector<double> away = awayOf(p);
    std::vector<QPointF> through;
    for (std::size_t n = 0; n + (isClosed(contour) ? 0 : 1) < p.size(); ++n) {
      const std::size_t next = (n + 1) % p.size();
      if ((away[n] < 0) == (away[next] < 0)) continue;
      through.push_back(at(p[n] + (p[next] - p[n]) * (away[n] / (away[n] - away[next]))));
    }
    if (!isClosed(contour))
      return void(out_.points.insert(out_.points.end(), through.begin(), through.end()));
    const glm::dvec3 along = glm::cross(normal_, areaNormal(p));
    const QPointF axis(glm::dot(along, plane_.right), glm::dot(along, plane_.down));
    std::ranges::sort(through, {}, [&](QPointF q) { return QPointF::dotProduct(q, axis); });
    for (std::size_t n = 0; n + 1 < through.size(); n += 2)
      out_.cuts.emplace_back(through[n], through[n + 1]);
  }

  const SlicePlane& plane_;
  const glm::dvec3 normal_;
  const double reachMm_;
  ContourLines& out_;
};

}  // namespace

std::vector<ContourLines> contourLines(const StructureSet& contours, const RegionsLook& look,
                                       const std::string& frameOfReferenceUid, const SlicePlane& plane,
                                       double reachMm) {
  std::vector<ContourLines> all;
  for (const RegionOfInterest& region : contours.regions) {
    const std::string& frame =
        region.frameOfReferenceUid.empty() ? look.frameOfReferenceUid : region.frameOfReferenceUid;
    if (!look.shows(region.number) || frame.empty() || frame != frameOfReferenceUid) continue;
    ContourLines& lines = all.emplace_back();
    lines.colour = regionColour(region.colour, region.number);
    Cutter cutter(plane, reachMm, lines);
    for (const Contour& contour : region.contours) cutter.add(contour);
  }
  return all;
}

}  // namespace volumen
