#include "io/dicom/lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace volumen::dicom {
namespace {

/// Position of a slice along the normal, and in its plane along rows and columns, mm.
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

/// Lines of one slope, and the slices on them.
struct Lines {
  std::vector<std::size_t> lineOf;     // index of each slice's line
  std::vector<glm::dvec2> intercepts;  // mean intercept of each line
};

/// Assigns each slice to the first line near it. Only the latest lines are tried, or pictures scattered in
/// their planes would take minutes.
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

/// Returns candidate slopes of the lines, most likely first: mm in the plane per mm along the normal.
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

/// Returns the least-squares slope of the slices on the line with most slices.
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

/// Runs of slices between sideways jumps, and the slope within them.
struct Runs {
  std::vector<std::size_t> runOf;  // index of each slice's run
  std::size_t count = 1;
  glm::dvec2 slope{0};
};

/// Returns the median sideways step, mm per mm along the normal.
glm::dvec2 usualSlope(const std::vector<Place>& places, double same) {
  std::vector<double> x, y;
  for (std::size_t n = 1; n < places.size(); ++n)
    if (const double along = places[n].along - places[n - 1].along; along > same) {
      x.push_back((places[n].inPlane.x - places[n - 1].inPlane.x) / along);
      y.push_back((places[n].inPlane.y - places[n - 1].inPlane.y) / along);
    }
  return x.empty() ? glm::dvec2(0) : glm::dvec2(lowerMedian(x), lowerMedian(y));
}

/// Returns the common least-squares slope of all runs.
glm::dvec2 slopeWithin(const std::vector<Place>& places, const Runs& runs) {
  std::vector<Place> sums(runs.count);
  std::vector<double> counts(runs.count);
  for (std::size_t n = 0; n < places.size(); ++n) {
    sums[runs.runOf[n]].along += places[n].along;
    sums[runs.runOf[n]].inPlane += places[n].inPlane;
    ++counts[runs.runOf[n]];
  }
  glm::dvec2 together(0);
  double spread = 0;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const std::size_t run = runs.runOf[n];
    const double along = places[n].along - sums[run].along / counts[run];
    together += along * (places[n].inPlane - sums[run].inPlane / counts[run]);
    spread += along * along;
  }
  return spread > 0 ? together / spread : glm::dvec2(0);
}

/// Splits slices where the stack jumps sideways by more than `most`. Returns a single run if that is only
/// jitter. Real jumps are few, and much larger than the slices' distances from the lines of their runs.
Runs runsBetweenJumps(const std::vector<Place>& places, double same, double most) {
  Runs runs{std::vector<std::size_t>(places.size()), 1, usualSlope(places, same)};
  double leastJump = 0;
  for (std::size_t n = 1; n < places.size(); ++n) {
    const Place &a = places[n - 1], &b = places[n];
    const double jump = glm::length(b.inPlane - a.inPlane - (b.along - a.along) * runs.slope);
    if (jump > most) leastJump = runs.count++ == 1 ? jump : std::min(leastJump, jump);
    runs.runOf[n] = runs.count - 1;
  }
  const Runs one{std::vector<std::size_t>(places.size()), 1, {}};
  if (runs.count == 1 || 4 * (runs.count - 1) > places.size() - 1) return one;
  runs.slope = slopeWithin(places, runs);
  constexpr double tremble = 0.25;  // fraction of the smallest jump
  std::vector<glm::dvec2> starts(runs.count);
  for (std::size_t n = 0; n < places.size(); ++n) {
    const glm::dvec2 intercept = places[n].inPlane - places[n].along * runs.slope;
    glm::dvec2& start = starts[runs.runOf[n]];
    if (n == 0 || runs.runOf[n] != runs.runOf[n - 1]) start = intercept;
    if (glm::length(intercept - start) > 2 * tremble * leastJump) return one;
  }
  return runs;
}

/// Returns a line for each run; runs on the same line share it.
Lines linesOfRuns(const std::vector<Place>& places, const Runs& runs, double most) {
  std::vector<glm::dvec2> means(runs.count);
  std::vector<double> counts(runs.count);
  for (std::size_t n = 0; n < places.size(); ++n) {
    means[runs.runOf[n]] += places[n].inPlane - places[n].along * runs.slope;
    ++counts[runs.runOf[n]];
  }
  Lines lines;
  std::vector<std::size_t> lineOfRun;
  for (std::size_t run = 0; run < runs.count; ++run) {
    const glm::dvec2 intercept = means[run] / counts[run];
    const auto at = std::ranges::find_if(
        lines.intercepts, [&](glm::dvec2 line) { return glm::length(intercept - line) <= most; });
    lineOfRun.push_back(std::size_t(at - lines.intercepts.begin()));
    if (at == lines.intercepts.end()) lines.intercepts.push_back(intercept);
  }
  for (const std::size_t run : runs.runOf) lines.lineOf.push_back(lineOfRun[run]);
  return lines;
}

/// Returns the fewest lines that hold all slices.
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
  const glm::dvec3 whole = *slices.back().slice->position - *first.position;
  const double length = glm::dot(whole, normal);
  const glm::dvec3 sideways = whole - length * normal;
  if (!(length > 0)) return {normal, false};
  double worst = 0;
  for (const PlacedSlice& s : slices) {
    const glm::dvec3 from = *s.slice->position - *first.position;
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
  const double same = samePlaceMm(entries), most = mostOffLineMm(first);
  const Runs runs = runsBetweenJumps(places, same, most);
  const Lines lines = runs.count > 1 ? linesOfRuns(places, runs, most) : fewestLines(places, same, most);
  std::vector<Entries> stacks(lines.intercepts.size());
  for (std::size_t n = 0; n < entries.size(); ++n) stacks[lines.lineOf[n]].push_back(entries[n]);
  for (const glm::dvec2 line : lines.intercepts)
    apartMm = std::max(apartMm, glm::length(line - lines.intercepts[0]));
  return stacks;
}

}  // namespace volumen::dicom
