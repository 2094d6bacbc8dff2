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
  HWY_ALIGN float around[kCapacity];  ///< the change of extinction that Parting::around is a share of
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
      hn::StoreU(hn::LoadU(DF(), from + n), DF(), to + ready.size);
    };
    copy(s.x, ready.x), copy(s.y, ready.y), copy(s.z, ready.z);
    copy(s.steps, ready.steps), copy(s.units, ready.units);
    copy(s.front, ready.front), copy(s.middle, ready.middle), copy(s.back, ready.back);
    hn::StoreU(hn::LoadU(DI(), s.ray + n), DI(), ready.ray + ready.size);
    ready.size += count;
  }

  /// Appends interval n, its halves in so many parts, not both 0; 0: as it is.
  template <class Array>
  HWY_INLINE void Add(const Array& s, int n, int first, int second) {
    CutHalf(s, n, -0.25f, first, s.front[n], s.middle[n]);
    CutHalf(s, n, 0.25f, second, s.middle[n], s.back[n]);
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

  /// Most halves come to few parts: long vectors would store mostly what nobody asked for.
  using Few = hn::CappedTag<float, 4>;
  static constexpr int kFew = int(hn::MaxLanes(Few()));

  /// Appends `count` parts, or one, of the half of interval n around `along` shares of the interval behind
  /// its middle, front to back, all between the half's densities.
  template <class Array>
  HWY_INLINE void CutHalf(const Array& s, int n, float along, int count, float front, float back) {
    if (count > 0) NoteNodes(s, n, along, count);
    const Few few;
    auto& r = ready;
    const int parts = std::max(count, 1);
    const float part = 0.5f / float(parts), middle = 0.5f * (front + back);
    for (int k = 0; k < parts; k += kFew) {
      const int at = r.size + k;
      StorePlaces(s, n, float(k) + 0.5f - 0.5f * float(parts), part, along, r, at);
      hn::StoreU(hn::Set(few, part * s.steps[n]), few, r.steps + at);
      hn::StoreU(hn::Set(few, part * s.units[n]), few, r.units + at);
      hn::StoreU(hn::Set(few, front), few, r.front + at);
      hn::StoreU(hn::Set(few, middle), few, r.middle + at);
      hn::StoreU(hn::Set(few, back), few, r.back + at);
      const hn::RebindToSigned<Few> fewInts;
      hn::StoreU(hn::Set(fewInts, s.ray[n]), fewInts, r.ray + at);
    }
    r.size += parts;
  }

  /// Notes where densities are wanted for `count` parts of a half: in their middles and between them.
  template <class Array>
  HWY_INLINE void NoteNodes(const Array& s, int n, float along, int count) {
    cuts_.push_back({ready.size, count, nodes_.size});
    const int wanted = 2 * count - 1;
    for (int k = 0; k < wanted; k += kFew)
      StorePlaces(s, n, float(k + 1 - count), 0.25f / float(count), along, nodes_, nodes_.size + k);
    nodes_.size += wanted;
  }

  /// Stores the places along + apart first, along + apart (first + 1), ... shares of interval n behind its
  /// middle.
  template <class Array, class Places>
  HWY_INLINE void StorePlaces(const Array& s, int n, float first, float apart, float along, Places& to,
                              int at) const {
    const Few few;
    const auto index = hn::Add(hn::Iota(few, 0), hn::Set(few, first));
    const auto shares = hn::Add(hn::Set(few, along), hn::Mul(index, hn::Set(few, apart)));
    const auto behind = hn::Mul(shares, hn::Set(few, s.steps[n]));
    const int ray = s.ray[n];
    const auto store = [&](float middle, float move, float* p) {
      hn::StoreU(hn::Add(hn::Set(few, middle), hn::Mul(behind, hn::Set(few, move))), few, p + at);
    };
    store(s.x[n], rays_.moveX[ray], to.x);
    store(s.y[n], rays_.moveY[ray], to.y);
    store(s.z[n], rays_.moveZ[ray], to.z);
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
