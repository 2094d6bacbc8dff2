#include "viewer/segment/surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <new>
#include <numeric>
#include <utility>

#include "viewer/segment/cell_triangles.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using Word = std::uint64_t;
constexpr float surfaceLevel = 0.5f;
// Fraction of an edge: keeps crossings around a point apart despite rounding.
constexpr double nearestToPoint = 0.02;

// First point and triangle of a row of cells, or their counts. A row owns the crossings of edges that start
// at its points: along x, then y, then z.
struct RowPlace {
  std::uint32_t points[3]{};
  std::uint32_t triangles = 0;
};

class SurfaceMaker {
 public:
  SurfaceMaker(const OccupancyField& field, const CancelToken& cancel)
      : field_(field),
        cancel_(cancel),
        size_(field.size()),
        words_(std::size_t(size_.x) / 64 + 1),  // one word more, so that each bit has a next one
        inside_(words_ * std::size_t(size_.y) * std::size_t(size_.z)),
        places_(std::size_t(size_.y) * std::size_t(size_.z)),
        mirrored_(glm::determinant(field.geometry.patientFromVoxelStep) < 0) {}

  Status make() {
    forEachRow([&](int j, int k) { findInside(j, k); });
    forEachRow([&](int j, int k) { countRow(j, k); });
    if (!placeRows()) return Error{"The surface has 2^31 triangles or more: take a smaller part of it."};
    forEachRow([&](int j, int k) { makePoints(j, k); });
    forEachRow([&](int j, int k) { makeTriangles(j, k); });
    return ended();
  }
  // Moves the points along their edges so that the surface encloses `volume` mm^3.
  Status enclose(double volume);
  Surface& surface() { return surface_; }

 private:
  Status ended() const { return cancel_.cancelled() ? Status(Error{"cancelled"}) : Status(); }
  template <class Work>
  void forEachRow(const Work& work) const {
    parallelFor(std::int64_t(places_.size()), 0, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t n = begin; n < end && !cancel_.cancelled(); ++n)
        work(int(n % size_.y), int(n / size_.y));
    });
  }

  std::size_t rowOf(int j, int k) const { return std::size_t(k) * std::size_t(size_.y) + std::size_t(j); }
  const Word* insideRow(int j, int k) const { return inside_.data() + rowOf(j, k) * words_; }
  const float* valueRow(int j, int k) const {
    return field_.values.data() + rowOf(j, k) * std::size_t(size_.x);
  }
  bool hasCells(int j, int k) const { return j + 1 < size_.y && k + 1 < size_.z; }

  void findInside(int j, int k);
  void countRow(int j, int k);
  bool placeRows();
  void makePoints(int j, int k);
  void makeTriangles(int j, int k);

  // Returns the bits of word w that have a next one in the row.
  Word withNext(std::size_t w) const {
    const int left = size_.x - 1 - int(w) * 64;
    return left >= 64 ? ~Word(0) : left <= 0 ? 0 : (Word(1) << left) - 1;
  }
  // Returns word w of a row shifted by one, so that each bit holds the next one.
  Word behind(const Word* row, std::size_t w) const {
    return row[w] >> 1 | (w + 1 < words_ ? row[w + 1] << 63 : 0);
  }
  // Return the crossed edges along x, y, z that start at the points of word w.
  Word crossedX(int j, int k, std::size_t w) const {
    const Word* row = insideRow(j, k);
    return (row[w] ^ behind(row, w)) & withNext(w);
  }
  Word crossedY(int j, int k, std::size_t w) const {
    return j + 1 < size_.y ? insideRow(j, k)[w] ^ insideRow(j + 1, k)[w] : 0;
  }
  Word crossedZ(int j, int k, std::size_t w) const {
    return k + 1 < size_.z ? insideRow(j, k)[w] ^ insideRow(j, k + 1)[w] : 0;
  }
  // Returns the cells of word w with corners both inside and outside.
  Word crossedCells(int j, int k, std::size_t w) const;
  // Returns the set of inside corners of a cell, the index into cellTriangles().
  std::size_t cornersOf(glm::ivec3 cell) const;

  glm::vec3 crossing(glm::ivec3 point, int axis, float here, float there) const;

  const OccupancyField& field_;
  const CancelToken& cancel_;
  glm::ivec3 size_;
  std::size_t words_;  // number of words in a row
  std::vector<Word> inside_;
  std::vector<RowPlace> places_;
  bool mirrored_;
  double level_ = surfaceLevel;  // field value at the points
  Surface surface_;
};

template <class Visit>
void forEachBit(Word bits, std::size_t w, const Visit& visit) {
  for (; bits; bits &= bits - 1) visit(int(w) * 64 + std::countr_zero(bits));
}

void SurfaceMaker::findInside(int j, int k) {
  const float* values = valueRow(j, k);
  Word* row = inside_.data() + rowOf(j, k) * words_;
  for (int i = 0; i < size_.x; i += 64) {
    Word bits = 0;
    for (int n = std::min(64, size_.x - i); n-- > 0;) bits = bits << 1 | Word(values[i + n] >= surfaceLevel);
    row[i / 64] = bits;
  }
}

Word SurfaceMaker::crossedCells(int j, int k, std::size_t w) const {
  Word any = 0, all = ~Word(0);
  for (const Word* row :
       {insideRow(j, k), insideRow(j + 1, k), insideRow(j, k + 1), insideRow(j + 1, k + 1)}) {
    any |= row[w] | behind(row, w);
    all &= row[w] & behind(row, w);
  }
  return any & ~all & withNext(w);
}

std::size_t SurfaceMaker::cornersOf(glm::ivec3 cell) const {
  const auto pair = [&](int j, int k) {
    const Word* row = insideRow(j, k);
    const std::size_t w = std::size_t(cell.x) / 64;
    const int bit = cell.x % 64;
    return bit < 63 ? row[w] >> bit & 3 : row[w] >> 63 | (row[w + 1] & 1) << 1;
  };
  return std::size_t(pair(cell.y, cell.z) | pair(cell.y + 1, cell.z) << 2 | pair(cell.y, cell.z + 1) << 4 |
                     pair(cell.y + 1, cell.z + 1) << 6);
}

void SurfaceMaker::countRow(int j, int k) {
  RowPlace& count = places_[rowOf(j, k)];
  for (std::size_t w = 0; w < words_; ++w) {
    count.points[0] += std::uint32_t(std::popcount(crossedX(j, k, w)));
    count.points[1] += std::uint32_t(std::popcount(crossedY(j, k, w)));
    count.points[2] += std::uint32_t(std::popcount(crossedZ(j, k, w)));
    if (!hasCells(j, k)) continue;
    forEachBit(crossedCells(j, k, w), w, [&](int i) {
      count.triangles += cellTriangles()[cornersOf({i, j, k})].count;
    });
  }
}

// Turns counts into start indices. Returns false if there are too many triangles.
bool SurfaceMaker::placeRows() {
  std::uint64_t points = 0, triangles = 0;
  for (RowPlace& place : places_) {
    for (std::uint32_t& first : place.points) points += std::exchange(first, std::uint32_t(points));
    triangles += std::exchange(place.triangles, std::uint32_t(triangles));
    if (points > std::numeric_limits<std::uint32_t>::max() || triangles >= std::uint64_t(1) << 31)
      return false;
  }
  if (cancel_.cancelled()) return true;
  surface_.points.resize(points);
  surface_.triangles.resize(triangles);
  return true;
}

glm::vec3 SurfaceMaker::crossing(glm::ivec3 point, int axis, float here, float there) const {
  const double part = (level_ - double(here)) / (double(there) - double(here));
  glm::dvec3 x(point + field_.box.low);
  x[axis] += std::clamp(part, nearestToPoint, 1 - nearestToPoint);
  return glm::vec3(field_.geometry.patientFromVoxel(x));
}

void SurfaceMaker::makePoints(int j, int k) {
  const RowPlace& place = places_[rowOf(j, k)];
  const float* here = valueRow(j, k);
  glm::vec3* next[3];
  for (int a = 0; a < 3; ++a) next[a] = surface_.points.data() + place.points[a];
  for (std::size_t w = 0; w < words_; ++w) {
    forEachBit(crossedX(j, k, w), w, [&](int i) {
      *next[0]++ = crossing({i, j, k}, 0, here[i], here[i + 1]);
    });
    forEachBit(crossedY(j, k, w), w, [&](int i) {
      *next[1]++ = crossing({i, j, k}, 1, here[i], valueRow(j + 1, k)[i]);
    });
    forEachBit(crossedZ(j, k, w), w, [&](int i) {
      *next[2]++ = crossing({i, j, k}, 2, here[i], valueRow(j, k + 1)[i]);
    });
  }
}

// Numbers the crossings of edges along one axis that start in one row, while cells are visited in order.
struct CrossingRun {
  std::uint32_t first = 0;
  Word crossed = 0;  // crossed edges of the current word, as bits
  std::uint32_t at(int bit) const {
    const Word before = bit < 64 ? (Word(1) << bit) - 1 : ~Word(0);
    return first + std::uint32_t(std::popcount(crossed & before));
  }
};

void SurfaceMaker::makeTriangles(int j, int k) {
  if (!hasCells(j, k)) return;
  const auto place = [&](int dj, int dk) -> const RowPlace& { return places_[rowOf(j + dj, k + dk)]; };
  // Along x at (y, z) = (0, 0), (1, 0), (0, 1), (1, 1); along y at z = 0, 1; along z at y = 0, 1.
  std::array<CrossingRun, 8> runs{{{place(0, 0).points[0]},
                                   {place(1, 0).points[0]},
                                   {place(0, 1).points[0]},
                                   {place(1, 1).points[0]},
                                   {place(0, 0).points[1]},
                                   {place(0, 1).points[1]},
                                   {place(0, 0).points[2]},
                                   {place(1, 0).points[2]}}};
  std::array<std::uint32_t, 3>* next = surface_.triangles.data() + place(0, 0).triangles;
  const int second = mirrored_ ? 2 : 1;
  std::array<std::uint32_t, 12> ofEdge;
  for (std::size_t w = 0; w < words_; ++w) {
    const std::array crossed{crossedX(j, k, w),         crossedX(j + 1, k, w), crossedX(j, k + 1, w),
                             crossedX(j + 1, k + 1, w), crossedY(j, k, w),     crossedY(j, k + 1, w),
                             crossedZ(j, k, w),         crossedZ(j + 1, k, w)};
    for (std::size_t r = 0; r < runs.size(); ++r) runs[r].crossed = crossed[r];
    forEachBit(crossedCells(j, k, w), w, [&](int i) {
      const CellTriangles& cell = cellTriangles()[cornersOf({i, j, k})];
      for (unsigned left = cell.crossed; left; left &= left - 1) {
        const auto edge = std::size_t(std::countr_zero(left));
        ofEdge[edge] = edge < 4 ? runs[edge].at(i % 64) : runs[2 + edge / 2].at(i % 64 + int(edge % 2));
      }
      for (std::size_t t = 0; t < cell.count; ++t) {
        const auto& corners = cell.triangles[t];
        (*next)[0] = ofEdge[corners[0]];
        (*next)[std::size_t(second)] = ofEdge[corners[1]];
        (*next)[std::size_t(3 - second)] = ofEdge[corners[2]];
        ++next;
      }
    });
    for (CrossingRun& run : runs) run.first += std::uint32_t(std::popcount(run.crossed));
  }
}

// Uses the secant method: the lower the level, the larger the volume.
Status SurfaceMaker::enclose(double volume) {
  constexpr double farthest = 0.05, near = 1e-4;
  constexpr int mostSteps = 6;
  double last = level_, lastOff = volumeOf(surface_) - volume;
  level_ += std::copysign(0.01, lastOff);
  for (int n = 0; n < mostSteps && std::abs(lastOff) > near * volume && !cancel_.cancelled(); ++n) {
    forEachRow([&](int j, int k) { makePoints(j, k); });
    const double off = volumeOf(surface_) - volume, step = off * (level_ - last) / (off - lastOff);
    if (!std::isfinite(step)) break;
    last = std::exchange(level_, std::clamp(level_ - step, surfaceLevel - farthest, surfaceLevel + farthest));
    lastOff = off;
  }
  return ended();
}

// Sums over all triangles in parts of fixed length, added in order.
template <class Term>
double summed(const Surface& surface, const Term& term) {
  constexpr std::size_t part = 1 << 14;
  const std::size_t count = surface.triangles.size();
  std::vector<double> sums((count + part - 1) / part);
  parallelFor(std::int64_t(sums.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    for (auto n = std::size_t(begin); n < std::size_t(end); ++n)
      for (std::size_t t = n * part; t < std::min(count, (n + 1) * part); ++t) {
        const auto& corners = surface.triangles[t];
        sums[n] += term(glm::dvec3(surface.points[corners[0]]), glm::dvec3(surface.points[corners[1]]),
                        glm::dvec3(surface.points[corners[2]]));
      }
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace

Result<Surface> surfaceOf(const OccupancyField& field, const CancelToken& cancel) try {
  SurfaceMaker maker(field, cancel);
  if (const Status made = maker.make(); !made) return made.error();
  return std::move(maker.surface());
} catch (const std::bad_alloc&) {
  return Error{"There is not enough memory for the surface."};
}

Result<Surface> volumePreservingSurface(const OccupancyField& field, const CancelToken& cancel) try {
  SurfaceMaker maker(field, cancel);
  if (const Status made = maker.make(); !made) return made.error();
  if (const Status moved = maker.enclose(volumeOf(field, cancel)); !moved) return moved.error();
  return std::move(maker.surface());
} catch (const std::bad_alloc&) {
  return Error{"There is not enough memory for the surface."};
}

double volumeOf(const Surface& surface) {
  if (surface.points.empty()) return 0;
  const glm::dvec3 o(surface.points.front());  // nearby origin, for precision
  return summed(surface, [o](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return glm::dot(a - o, glm::cross(b - o, c - o)) / 6;
  });
}

double areaOf(const Surface& surface) {
  return summed(surface, [](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return glm::length(glm::cross(b - a, c - a)) / 2;
  });
}

}  // namespace volumen
