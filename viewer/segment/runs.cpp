#include "viewer/segment/runs.h"

#include <algorithm>
#include <bit>

#include "viewer/segment/bit_rows.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Union-find over runs: `part` is the parent, always an earlier run; a root is its own parent.
class Joining {
 public:
  Joining(JoinedRuns& joined, glm::ivec3 size) : runs_(joined.runs), first_(joined.firstOfRow), size_(size) {}

  // Unites runs of row (j, k) with touching runs of the row a step away, if that lies in slice `fromSlice` or
  // later.
  void join(int j, int k, RowStep step, int fromSlice) {
    const int otherJ = j + step.dj, otherK = k + step.dk;
    if (otherJ < 0 || otherJ >= size_.y || otherK < fromSlice) return;
    const std::size_t row = rowOf(j, k), other = rowOf(otherJ, otherK);
    std::size_t a = first_[row], b = first_[other];
    while (a < first_[row + 1] && b < first_[other + 1]) {
      if (runs_[a].begin < runs_[b].end + step.reach && runs_[b].begin < runs_[a].end + step.reach)
        unite(std::uint32_t(a), std::uint32_t(b));
      if (runs_[a].end < runs_[b].end)
        ++a;
      else
        ++b;
    }
  }

 private:
  std::size_t rowOf(int j, int k) const { return std::size_t(k) * std::size_t(size_.y) + std::size_t(j); }
  std::uint32_t root(std::uint32_t n) {
    while (runs_[n].part != n) n = runs_[n].part = runs_[runs_[n].part].part;
    return n;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    runs_[std::max(a, b)].part = std::min(a, b);
  }

  std::vector<VoxelRun>& runs_;
  const std::vector<std::size_t>& first_;
  glm::ivec3 size_;
};

std::size_t runsIn(bits::Row row) {
  std::uint64_t before = 0;
  int count = 0;
  for (const std::uint64_t word : row) {
    count += std::popcount(word & ~(word << 1 | before));
    before = word >> 63;
  }
  return std::size_t(count);
}

void findRuns(const BitMask& mask, JoinedRuns& joined) {
  const glm::ivec3 size = mask.size();
  const std::int64_t rows = std::int64_t(size.y) * size.z;
  const auto row = [&](std::int64_t n) { return mask.row(int(n % size.y), int(n / size.y)); };
  auto& first = joined.firstOfRow;
  parallelFor(rows, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) first[std::size_t(n) + 1] = runsIn(row(n));
  });
  for (std::size_t n = 1; n < first.size(); ++n) first[n] += first[n - 1];
  joined.runs.resize(first.back());
  parallelFor(rows, 0, [&](std::int64_t begin, std::int64_t end) {
    std::size_t next = first[std::size_t(begin)];
    for (std::int64_t n = begin; n < end; ++n)
      bits::forEachRun(row(n), size.x, [&](int from, int to) {
        joined.runs[next] = {from, to, std::uint32_t(next)};
        ++next;
      });
  });
}

}  // namespace

JoinedRuns joinedRuns(const BitMask& mask, std::span<const RowStep> steps, const CancelToken& cancel) {
  const glm::ivec3 size = mask.size();
  const std::size_t rows = std::size_t(size.y) * std::size_t(size.z);
  JoinedRuns joined{{}, std::vector<std::size_t>(rows + 1), 0};
  findRuns(mask, joined);
  Joining joining(joined, size);
  const int slab = std::max(1, size.z / (4 * allowedThreads()));
  parallelFor((size.z + slab - 1) / slab, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) {
      const int low = int(n) * slab;
      for (int k = low; k < std::min(low + slab, size.z) && !cancel.cancelled(); ++k)
        for (int j = 0; j < size.y; ++j)
          for (const RowStep step : steps) joining.join(j, k, step, low);
    }
  });
  for (int k = slab; k < size.z && !cancel.cancelled(); k += slab)
    for (int j = 0; j < size.y; ++j)
      for (const RowStep step : steps)
        if (step.dk < 0) joining.join(j, k, step, 0);
  if (cancel.cancelled()) return {{}, std::vector<std::size_t>(rows + 1), 0};
  // Parents come earlier, so they already have their number.
  for (std::size_t n = 0; n < joined.runs.size(); ++n) {
    std::uint32_t& part = joined.runs[n].part;
    part = part == n ? joined.parts++ : joined.runs[part].part;
  }
  return joined;
}

BitMask maskOfRuns(const JoinedRuns& joined, const VoxelGeometry& geometry, const std::vector<bool>& chosen) {
  BitMask mask(geometry);
  const glm::ivec3 size = geometry.size;
  parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      const auto to = mask.row(int(row % size.y), int(row / size.y));
      for (std::size_t n = joined.firstOfRow[std::size_t(row)]; n < joined.firstOfRow[std::size_t(row) + 1];
           ++n)
        if (chosen[joined.runs[n].part]) bits::setRun(to, joined.runs[n].begin, joined.runs[n].end);
    }
  });
  return mask;
}

}  // namespace volumen
