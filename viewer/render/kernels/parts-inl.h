// Intervals of rays, and cutting them into parts, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_PARTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_PARTS_INL_H_
#undef VOLUMEN_RENDER_KERNELS_PARTS_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_PARTS_INL_H_
#endif

#include <algorithm>
#include <vector>

#include "viewer/render/kernels/grid-inl.h"
#include "viewer/render/kernels/math-inl.h"
#include "viewer/render/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Intervals of rays on their way, in the order of each ray's steps.
template <int kCapacity>
struct Intervals {
  HWY_ALIGN float x[kCapacity], y[kCapacity], z[kCapacity];              ///< middle, not clamped to the grid
  HWY_ALIGN float steps[kCapacity];                                      ///< length in steps
  HWY_ALIGN float units[kCapacity];                                      ///< length in unit distances
  HWY_ALIGN float front[kCapacity], middle[kCapacity], back[kCapacity];  ///< densities
  HWY_ALIGN float around[kCapacity];  ///< CurveTable::variation over the densities of the cells at both ends
  HWY_ALIGN std::int32_t ray[kCapacity];
  int size = 0;

  /// Makes what stands in the last vector behind the last interval harmless: places inside the volume.
  HWY_INLINE void Pad() {
    const DF df;
    for (float* values : {x, y, z, steps, units, front, middle, back, around})
      hn::StoreU(hn::Zero(df), df, values + size);
    hn::StoreU(hn::Zero(DI()), DI(), ray + size);
  }
};

template <class Array>
HWY_INLINE V3 PlaceOf(const Array& s, int n) {
  const DF df;
  return {hn::Load(df, s.x + n), hn::Load(df, s.y + n), hn::Load(df, s.z + n)};
}

/// Intervals and parts of intervals that are ready to be integrated but for densities in and between them.
class PartQueue {
 public:
  explicit PartQueue(const RayRow& rays) : rays_(rays) {}

  static constexpr int kEnough = 512, kReady = kEnough + kLanes * TraceFrame::mostParts + 2 * kLanes;
  Intervals<kReady> ready;

  bool IsFull() const { return ready.size > kEnough; }

  /// Appends the intervals n .. n + count as they are.
  template <class Array>
  HWY_INLINE void AddWhole(const Array& s, int n, int count) {
    const auto copy = [&](const float* from, float* to) {
      hn::StoreU(hn::Load(DF(), from + n), DF(), to + ready.size);
    };
    copy(s.x, ready.x), copy(s.y, ready.y), copy(s.z, ready.z);
    copy(s.steps, ready.steps), copy(s.units, ready.units);
    copy(s.front, ready.front), copy(s.middle, ready.middle), copy(s.back, ready.back);
    hn::StoreU(hn::Load(DI(), s.ray + n), DI(), ready.ray + ready.size);
    ready.size += count;
  }

  /// Appends interval n, its halves in so many parts; 0: as they are.
  template <class Array>
  HWY_INLINE void Add(const Array& s, int n, int first, int second) {
    if (first + second == 0) {
      Cut(s, n, 0, 1, 1, s.front[n], s.middle[n], s.back[n]);
    } else {
      CutHalf(s, n, -0.25f, first, s.front[n], s.middle[n]);
      CutHalf(s, n, 0.25f, second, s.middle[n], s.back[n]);
    }
  }

  /// Sets the densities in and between parts; how many it sampled.
  template <class Store>
  HWY_INLINE int Sample(const Grid& grid) {
    for (float* values : {nodes_.x, nodes_.y, nodes_.z})
      hn::StoreU(hn::Zero(DF()), DF(), values + nodes_.size);
    for (int n = 0; n < nodes_.size; n += kLanes)
      hn::Store(Store::Density(grid, grid.CellAt(grid.Clamped(PlaceOf(nodes_, n)))), DF(),
                nodes_.density + n);
    for (const CutPiece& c : cuts_) SetDensities(c);
    ready.Pad();
    return nodes_.size;
  }

  HWY_INLINE void Clear() {
    cuts_.clear();
    nodes_.size = 0;
    ready.size = 0;
  }

 private:
  /// A half of an interval in parts, and the nodes in and between them.
  struct CutPiece {
    int first, count, firstNode;
  };
  /// Places where densities are wanted.
  struct Nodes {
    HWY_ALIGN float x[2 * kReady], y[2 * kReady], z[2 * kReady], density[2 * kReady];
    int size = 0;
  };

  /// Appends the parts of a half of interval n, around `along` shares of the interval behind its middle,
  /// between the densities front and back.
  template <class Array>
  HWY_INLINE void CutHalf(const Array& s, int n, float along, int count, float front, float back) {
    if (count > 0) NoteNodes(s, n, along, count);
    Cut(s, n, along, 0.5f, std::max(count, 1), front, 0.5f * (front + back), back);
  }

  /// Appends `count` parts of a share of interval n around `along` shares behind its middle, front to back,
  /// all with these densities.
  template <class Array>
  HWY_INLINE void Cut(const Array& s, int n, float along, float share, int count, float front, float middle,
                      float back) {
    const DF df;
    auto& r = ready;
    const float part = share / float(count);
    for (int k = 0; k < count; k += kLanes) {
      const int at = r.size + k;
      StorePlaces(s, n, Shares(k, 0.5f - 0.5f * float(count), part, along), r, at);
      hn::StoreU(Set(part * s.steps[n]), df, r.steps + at);
      hn::StoreU(Set(part * s.units[n]), df, r.units + at);
      hn::StoreU(Set(front), df, r.front + at);
      hn::StoreU(Set(middle), df, r.middle + at);
      hn::StoreU(Set(back), df, r.back + at);
      hn::StoreU(SetI(s.ray[n]), DI(), r.ray + at);
    }
    r.size += count;
  }

  /// Notes where densities are wanted for `count` parts of a half: in their middles and between them.
  template <class Array>
  HWY_INLINE void NoteNodes(const Array& s, int n, float along, int count) {
    cuts_.push_back({ready.size, count, nodes_.size});
    const int wanted = 2 * count - 1;
    for (int k = 0; k < wanted; k += kLanes)
      StorePlaces(s, n, Shares(k, float(1 - count), 0.25f / float(count), along), nodes_, nodes_.size + k);
    nodes_.size += wanted;
  }

  /// along + apart (k + first), along + apart (k + 1 + first), ...
  static HWY_INLINE VF Shares(int k, float first, float apart, float along) {
    const VF index = hn::Add(hn::Iota(DF(), 0), Set(float(k) + first));
    return hn::Add(Set(along), hn::Mul(index, Set(apart)));
  }
  /// Stores the places so many shares of interval n behind its middle.
  template <class Array, class Places>
  HWY_INLINE void StorePlaces(const Array& s, int n, VF shares, Places& to, int at) const {
    const DF df;
    const VF behind = hn::Mul(shares, Set(s.steps[n]));
    const int ray = s.ray[n];
    hn::StoreU(hn::Add(Set(s.x[n]), hn::Mul(behind, Set(rays_.moveX[ray]))), df, to.x + at);
    hn::StoreU(hn::Add(Set(s.y[n]), hn::Mul(behind, Set(rays_.moveY[ray]))), df, to.y + at);
    hn::StoreU(hn::Add(Set(s.z[n]), hn::Mul(behind, Set(rays_.moveZ[ray]))), df, to.z + at);
  }

  /// Each part's densities from those of the nodes: in its middle and, but for the first and the last, at its
  /// ends.
  HWY_INLINE void SetDensities(const CutPiece& c) {
    auto& r = ready;
    const float* density = nodes_.density + c.firstNode;
    for (int part = 0; part < c.count; ++part) {
      const int at = c.first + part;
      r.middle[at] = density[2 * part];
      if (part + 1 < c.count) r.back[at] = r.front[at + 1] = density[2 * part + 1];
    }
  }

  const RayRow& rays_;
  std::vector<CutPiece> cuts_;
  Nodes nodes_;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
