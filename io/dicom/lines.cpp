#include "io/dicom/lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace volumen::dicom {
namespace {

/// Where a slice lies along the normal, and in its plane along rows and columns, mm.
struct Place {
  double along = 0;
  glm::dvec2 inPlane{0};
};

std::vector<Place> placesOf(const Entries& entries) {
  const Orientation o = *entries[0].slice().orientation;
  std::vector<Place> places;
  for (const Entry& e : entries) {
    const glm::dvec3 p = *e.slice().position;
    places.push_back({e.placed.alongNormal, {glm::dot(p, o.row), glm::dot(p, o.column)}});
  }
  return places;
}

/// Slices on lines of one slope.
struct Lines {
  std::vector<std::size_t> lineOf;     // of each slice
  std::vector<glm::dvec2> intercepts;  // the mean of each line
};

/// Puts each slice on the first line that it is near; only the latest are tried, so that pictures scattered
/// in their planes take no minutes.
Lines linesOfSlope(const std::vector<Place>& places, glm::dvec2 slope, double most) {
  constexpr std::size_t tried = 64;
  Lines lines;
  std::vector<double> counts;
  for (const Place& p : places) {
    const glm::dvec2 intercept = p.inPlane - p.along * slope;
    const std::size_t end = lines.intercepts.size();
    std::size_t at = end > tried ? end - tried : 0;
    while (at < end && glm::length(intercept - lines.intercepts[at]) > most) ++at;
    if (at == end) {
      lines.intercepts.push_back(intercept);
      counts.push_back(1);
    } else {
      lines.intercepts[at] += (intercept - lines.intercepts[at]) / ++counts[at];
    }
    lines.lineOf.push_back(at);
  }
  return lines;
}

/// Slopes, mm in the plane per mm along the normal, that the lines may have, the likeliest first.
std::vector<glm::dvec2> likelySlopes(const std::vector<Place>& places, double same) {
  constexpr std::size_t most = 16, neighbours = 4;
  std::vector<glm::dvec2> slopes;
  const auto add = [&](const Place& a, const Place& b) {
    if (b.along - a.along > same && slopes.size() < most)
      slopes.push_back((b.inPlane - a.inPlane) / (b.along - a.along));
  };
  add(places.front(), places.back());
  slopes.emplace_back(0);
  const std::size_t step = std::max<std::size_t>(1, places.size() / 4);
  for (std::size_t n = 0; n < places.size(); n += step)
    for (std::size_t m = n + 1; m < std::min(places.size(), n + neighbours); ++m) add(places[n], places[m]);
  return slopes;
}

/// The least-squares slope of the slices on the longest line.
glm::dvec2 fittedSlope(const std::vector<Place>& places, const Lines& lines) {
  std::vector<std::size_t> counts(lines.intercepts.size());
  for (const std::size_t line : lines.lineOf) ++counts[line];
  const auto longest = std::size_t(std::ranges::max_element(counts) - counts.begin());
  Place mean;
  for (std::size_t n = 0; n < places.size(); ++n)
    if (lines.lineOf[n] == longest) {
      mean.along += places[n].along / double(counts[longest]);
      mean.inPlane += places[n].inPlane / double(counts[longest]);
    }
  glm::dvec2 together(0);
  double spread = 0;
  for (std::size_t n = 0; n < places.size(); ++n)
    if (lines.lineOf[n] == longest) {
      const double along = places[n].along - mean.along;
      together += along * (places[n].inPlane - mean.inPlane);
      spread += along * along;
    }
  return spread > 0 ? together / spread : glm::dvec2(0);
}

/// The fewest lines that hold all slices.
Lines fewestLines(const std::vector<Place>& places, double same, double most) {
  Lines best;
  const auto tryOut = [&](glm::dvec2 slope) {
    Lines lines = linesOfSlope(places, slope, most);
    if (best.lineOf.empty() || lines.intercepts.size() < best.intercepts.size()) best = std::move(lines);
  };
  for (const glm::dvec2 slope : likelySlopes(places, same)) {
    tryOut(slope);
    if (best.intercepts.size() == 1) return best;
  }
  tryOut(fittedSlope(places, best));
  return best;
}

}  // namespace

double mostOffLineMm(const Slice& slice) {
  return std::max(1.0, std::min(slice.spacing->x, slice.spacing->y));
}

StackDirection stackDirection(std::span<const PlacedSlice> slices) {
  const Slice& first = slices[0].slice;
  const glm::dvec3 normal = glm::normalize(glm::cross(first.orientation->row, first.orientation->column));
  if (slices.size() < 2) return {normal, false};
  const glm::dvec3 whole = *slices.back().slice.position - *first.position;
  const double length = glm::dot(whole, normal);
  const glm::dvec3 sideways = whole - length * normal;
  if (!(length > 0)) return {normal, false};
  double worst = 0;
  for (const PlacedSlice& s : slices) {
    const glm::dvec3 from = *s.slice.position - *first.position;
    worst = std::max(worst, glm::length(from - glm::dot(from, normal) / length * whole));
  }
  const bool agreed = worst <= 0.1 * glm::length(sideways);
  if (!agreed) return {normal, false};
  return {glm::normalize(whole), slices.size() > 2};
}

std::vector<Entries> byLine(const Entries& entries, double& apartMm) {
  apartMm = 0;
  const Slice& first = entries[0].slice();
  if (!isPlaced(first) || entries.size() < 2) return {entries};
  const std::vector<Place> places = placesOf(entries);
  const Lines lines = fewestLines(places, samePlaceMm(entries), mostOffLineMm(first));
  std::vector<Entries> stacks(lines.intercepts.size());
  for (std::size_t n = 0; n < entries.size(); ++n) stacks[lines.lineOf[n]].push_back(entries[n]);
  for (const glm::dvec2 line : lines.intercepts)
    apartMm = std::max(apartMm, glm::length(line - lines.intercepts[0]));
  return stacks;
}

}  // namespace volumen::dicom
