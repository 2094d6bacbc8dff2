#include "viewer/segment/components.h"

#include <algorithm>

namespace volumen {

namespace {

// Labelled voxels in a row, and a run of the same component (itself: the first of it).
struct Run {
  int begin, end;
  std::size_t parent;
};

class Runs {
 public:
  explicit Runs(const DenseLabels& map) : size_(map.geometry.size) {
    const std::size_t rows = std::size_t(size_.y) * size_.z;
    firstOfRow_.reserve(rows + 1);
    for (std::size_t row = 0; row < rows; ++row) addRow(map.labels.data() + row * size_.x);
    firstOfRow_.push_back(runs_.size());
    for (std::size_t row = 0; row < rows; ++row) {
      if (row % size_.y > 0) join(row - 1, row);
      if (row >= std::size_t(size_.y)) join(row - size_.y, row);
    }
  }

  // The first run of the largest component; runs_.size() where there is none.
  std::size_t largest() {
    std::vector<std::int64_t> voxels(runs_.size());
    for (std::size_t n = 0; n < runs_.size(); ++n) voxels[root(n)] += runs_[n].end - runs_[n].begin;
    return std::size_t(std::max_element(voxels.begin(), voxels.end()) - voxels.begin());
  }

  void write(std::size_t component, std::vector<std::uint8_t>& labels) {
    std::fill(labels.begin(), labels.end(), 0);
    for (std::size_t row = 0; row + 1 < firstOfRow_.size(); ++row)
      for (std::size_t n = firstOfRow_[row]; n < firstOfRow_[row + 1]; ++n)
        if (root(n) == component)
          std::fill(labels.begin() + std::ptrdiff_t(row * size_.x + runs_[n].begin),
                    labels.begin() + std::ptrdiff_t(row * size_.x + runs_[n].end), 1);
  }

 private:
  void addRow(const std::uint8_t* row) {
    firstOfRow_.push_back(runs_.size());
    const std::uint8_t* const end = row + size_.x;
    for (const std::uint8_t* at = std::find(row, end, 1); at != end; at = std::find(at, end, 1)) {
      const std::uint8_t* const first = at;
      while (at != end && *at == 1) ++at;
      runs_.push_back({int(first - row), int(at - row), runs_.size()});
    }
  }

  std::size_t root(std::size_t n) {
    while (runs_[n].parent != n) n = runs_[n].parent = runs_[runs_[n].parent].parent;
    return n;
  }

  // Joins what touches in two neighbouring rows.
  void join(std::size_t row, std::size_t other) {
    std::size_t a = firstOfRow_[row], b = firstOfRow_[other];
    while (a < firstOfRow_[row + 1] && b < firstOfRow_[other + 1]) {
      if (std::max(runs_[a].begin, runs_[b].begin) < std::min(runs_[a].end, runs_[b].end)) {
        const std::size_t first = root(a), second = root(b);
        runs_[std::max(first, second)].parent = std::min(first, second);
      }
      if (runs_[a].end < runs_[b].end)
        ++a;
      else
        ++b;
    }
  }

  glm::ivec3 size_;
  std::vector<Run> runs_;
  std::vector<std::size_t> firstOfRow_;  // and the number of runs
};

}  // namespace

DenseLabels largestComponent(DenseLabels map) {
  Runs runs(map);
  runs.write(runs.largest(), map.labels);
  return map;
}

}  // namespace volumen
