#include "viewer/segment/pixel_outlines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>

namespace volumen {
namespace {

/// Traces the edges of pixels. Each edge has its pixel on the right: parts run clockwise on screen, holes
/// anticlockwise.
class OutlineTracer {
 public:
  OutlineTracer(std::span<const std::uint8_t> pixels, glm::ivec2 size)
      : pixels_(pixels), size_(size), nodeAt_(std::size_t(size.x + 1) * std::size_t(size.y + 1), none) {}

  std::vector<std::vector<glm::ivec2>> run() {
    unused_.resize(nodeAt_.size());
    for (int y = 0; y <= size_.y; ++y)
      for (int x = 0; x <= size_.x; ++x) unused_[at({x, y})] = edgesFrom({x, y});
    std::vector<std::size_t> parts, holes;
    for (int y = 0; y <= size_.y; ++y)
      for (int x = 0; x <= size_.x; ++x)
        for (int direction = 0; direction < 4; ++direction)
          if (unused_[at({x, y})] >> direction & 1) {
            // Rows are searched from the top: the first edge of a part leads to the right, of a hole down.
            const std::size_t first = trace({x, y}, direction);
            (direction == right ? parts : holes).push_back(first);
          }
    joinHoles(holes);
    std::vector<std::vector<glm::ivec2>> outlines;
    for (const std::size_t part : parts) outlines.push_back(turnsOf(part));
    return outlines;
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  enum Direction { right, down, left, up };
  static constexpr glm::ivec2 steps[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  struct Node {
    glm::ivec2 point;
    std::size_t next;
  };

  std::size_t at(glm::ivec2 corner) const {
    return std::size_t(corner.y) * std::size_t(size_.x + 1) + std::size_t(corner.x);
  }
  bool isSet(int x, int y) const {
    return x >= 0 && y >= 0 && x < size_.x && y < size_.y &&
           pixels_[std::size_t(y) * std::size_t(size_.x) + std::size_t(x)] != 0;
  }
  /// Returns the directions of edges that begin at a corner, one bit each.
  std::uint8_t edgesFrom(glm::ivec2 c) const {
    const bool nw = isSet(c.x - 1, c.y - 1), ne = isSet(c.x, c.y - 1), sw = isSet(c.x - 1, c.y),
               se = isSet(c.x, c.y);
    return std::uint8_t((se && !ne) << right | (sw && !se) << down | (nw && !sw) << left | (ne && !nw) << up);
  }

  /// Follows edges until they close. Where two pixels touch at a corner, it stays with the same pixel.
  std::size_t trace(glm::ivec2 corner, int direction) {
    const std::size_t first = nodes_.size();
    do {
      unused_[at(corner)] &= std::uint8_t(~(1 << direction));
      nodeAt_[at(corner)] = nodes_.size();
      nodes_.push_back({corner, nodes_.size() + 1});
      corner += steps[direction];
      const std::uint8_t edges = edgesFrom(corner);
      for (const int turn : {1, 0, 3})
        if (edges >> (direction + turn) % 4 & 1) {
          direction = (direction + turn) % 4;
          break;
        }
    } while (unused_[at(corner)] >> direction & 1);
    nodes_.back().next = first;
    return first;
  }

  /// Joins each hole to what lies left of its leftmost point, which belongs to its part or to a hole that is
  /// joined already.
  void joinHoles(const std::vector<std::size_t>& holes) {
    std::vector<std::size_t> leftmost;
    for (const std::size_t hole : holes) leftmost.push_back(leftmostOf(hole));
    std::ranges::sort(leftmost, {}, [&](std::size_t n) { return nodes_[n].point.x; });
    for (const std::size_t hole : leftmost) {
      glm::ivec2 corner = nodes_[hole].point - glm::ivec2(1, 0);
      while (edgesFrom(corner) == 0) --corner.x;
      const std::size_t outer = nodeAt_[at(corner)];
      // outer -> (second copy of the hole's point) -> hole ... -> its point -> (second copy of outer) -> on
      nodes_.push_back({nodes_[hole].point, nodes_[hole].next});
      nodes_.push_back({corner, nodes_[outer].next});
      nodes_[outer].next = nodes_.size() - 2;
      nodes_[hole].next = nodes_.size() - 1;
    }
  }

  std::size_t leftmostOf(std::size_t first) const {
    std::size_t best = first;
    for (std::size_t n = nodes_[first].next; n != first; n = nodes_[n].next) {
      const glm::ivec2 p = nodes_[n].point, b = nodes_[best].point;
      if (p.x < b.x || (p.x == b.x && p.y < b.y)) best = n;
    }
    return best;
  }

  std::vector<glm::ivec2> turnsOf(std::size_t first) const {
    std::vector<glm::ivec2> all, turns;
    std::size_t n = first;
    do {
      all.push_back(nodes_[n].point);
      n = nodes_[n].next;
    } while (n != first);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const glm::ivec2 from = glm::ivec2(glm::sign(all[i] - all[(i + all.size() - 1) % all.size()])),
                       to = glm::ivec2(glm::sign(all[(i + 1) % all.size()] - all[i]));
      if (from != to) turns.push_back(all[i]);
    }
    return turns;
  }

  std::span<const std::uint8_t> pixels_;
  glm::ivec2 size_;
  std::vector<std::size_t> nodeAt_;  ///< the latest node of each corner
  std::vector<std::uint8_t> unused_;
  std::vector<Node> nodes_;
};

/// Evenly spaced rows of a picture or of a bounding box.
struct Rows {
  double first = 0, step = 1;
  int count = 0;

  /// Returns the rows from `low` on, but not from `high` on.
  std::pair<int, int> between(double low, double high) const {
    const auto rowFrom = [&](double y) {
      return int(std::clamp(std::ceil((y - first) / step), 0.0, double(count)));
    };
    return {rowFrom(low), rowFrom(high)};
  }
};

/// Calls `use` with each edge from its lower to its higher y, so that both directions of an edge are the
/// same.
template <class Edge>
void forEdges(const Outlines& outlines, const Edge& use) {
  for (const auto& outline : outlines)
    for (std::size_t n = 0; n < outline.size(); ++n) {
      const glm::dvec2 a = outline[n], b = outline[(n + 1) % outline.size()];
      a.y < b.y ? use(a, b) : use(b, a);
    }
}

/// Returns the sorted crossings of each row; nothing if they are too many.
std::optional<std::vector<std::vector<double>>> crossings(const Outlines& outlines, const Rows& rows) {
  constexpr std::int64_t most = 1 << 24;
  std::int64_t count = 0;
  forEdges(outlines, [&](glm::dvec2 a, glm::dvec2 b) {
    const auto [begin, end] = rows.between(a.y, b.y);
    count += end - begin;
  });
  if (count > most) return {};
  std::vector<std::vector<double>> all(std::size_t(rows.count));
  forEdges(outlines, [&](glm::dvec2 a, glm::dvec2 b) {
    const auto [begin, end] = rows.between(a.y, b.y);
    for (int row = begin; row < end; ++row)
      all[std::size_t(row)].push_back(a.x +
                                      (rows.first + row * rows.step - a.y) * ((b.x - a.x) / (b.y - a.y)));
  });
  for (auto& row : all) std::ranges::sort(row);
  return all;
}

}  // namespace

std::vector<std::vector<glm::ivec2>> pixelOutlines(std::span<const std::uint8_t> pixels, glm::ivec2 size) {
  return OutlineTracer(pixels, size).run();
}

std::vector<std::uint8_t> filledEvenOdd(const Outlines& outlines, glm::ivec2 size) {
  const auto found = crossings(outlines, {0, 1, size.y});
  if (!found) return {};
  std::vector<std::uint8_t> pixels(std::size_t(size.x) * std::size_t(size.y));
  const auto columnFrom = [&](double x) {
    return std::ptrdiff_t(std::clamp(std::ceil(x), 0.0, double(size.x)));
  };
  for (int y = 0; y < size.y; ++y) {
    const std::vector<double>& xs = (*found)[std::size_t(y)];
    const auto row = pixels.begin() + std::ptrdiff_t(y) * size.x;
    for (std::size_t n = 0; n + 1 < xs.size(); n += 2)
      std::fill(row + columnFrom(xs[n]), row + columnFrom(xs[n + 1]), std::uint8_t(1));
  }
  return pixels;
}

double evenOddArea(const Outlines& outlines) {
  constexpr double fewest = 64, most = 8192, aPixel = 8;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& outline : outlines)
    for (const glm::dvec2 p : outline) low = std::min(low, p.y), high = std::max(high, p.y);
  if (!(high > low)) return 0;
  const double perPixel = std::ceil(std::max(aPixel, fewest / (high - low)));
  const int count = int(std::min(std::ceil((high - low) * perPixel), most));
  const double step = (high - low) / count;
  const auto found = crossings(outlines, {low + step / 2, step, count});
  double length = 0;
  if (!found) return 0;
  for (const std::vector<double>& xs : *found)
    for (std::size_t n = 0; n + 1 < xs.size(); n += 2) length += xs[n + 1] - xs[n];
  return length * step;
}

}  // namespace volumen
