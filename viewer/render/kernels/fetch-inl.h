// Values of a grid of voxels at positions, for kernels that take sample by sample; compiled once a CPU
// target.
#if defined(VOLUMEN_RENDER_KERNELS_FETCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_FETCH_INL_H_
#undef VOLUMEN_RENDER_KERNELS_FETCH_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_FETCH_INL_H_
#endif

#include <algorithm>

#include "viewer/render/kernels/math-inl.h"
#include "viewer/render/rays.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The cells of a vector of positions clamped to the grid (SCENE 2): first voxel and place inside, 0..1.
struct CellVector {
  VI index;
  VF fx, fy, fz;
};

/// The strides of a grid; along an axis of one voxel the neighbour is the voxel itself.
struct Strides {
  glm::ivec3 size;
  int next, row, slice;

  explicit Strides(glm::ivec3 n)
      : size(n), next(n.x > 1 ? 1 : 0), row(n.y > 1 ? n.x : 0), slice(n.z > 1 ? n.x * n.y : 0) {}

  HWY_INLINE CellVector CellsAt(const V3& p) const {
    const auto axis = [](VF x, int n, VF& place) {
      const VF inside = hn::Min(hn::Max(x, hn::Zero(DF())), Set(float(n - 1)));
      const VI low = hn::Min(hn::ConvertTo(DI(), inside), SetI(n > 1 ? n - 2 : 0));
      place = hn::Sub(inside, hn::ConvertTo(DF(), low));
      return low;
    };
    CellVector c;
    const VI i = axis(p.x, size.x, c.fx), j = axis(p.y, size.y, c.fy), k = axis(p.z, size.z, c.fz);
    c.index = hn::Add(hn::Add(i, hn::Mul(j, SetI(size.x))), hn::Mul(k, SetI(size.x * size.y)));
    return c;
  }
};

/// Trilinear interpolation of one value a voxel; rowAt(index, fx): that between a voxel and its neighbour
/// along i.
template <class RowAt>
HWY_INLINE VF Interpolate(const Strides& s, const CellVector& c, const RowAt& rowAt) {
  const auto row = [&](int offset) { return rowAt(hn::Add(c.index, SetI(offset)), c.fx); };
  return Lerp(Lerp(row(0), row(s.row), c.fy), Lerp(row(s.slice), row(s.slice + s.row), c.fy), c.fz);
}

#if HWY_TARGET == HWY_SCALAR
/// Four values of a voxel as floats.
struct Four {
  float v[4];
};
template <class T>
HWY_INLINE Four LoadFour(const T* voxel) {
  return {{float(voxel[0]), float(voxel[1]), float(voxel[2]), float(voxel[3])}};
}
HWY_INLINE Four LerpFour(const Four& a, const Four& b, float f) {
  Four x;
  for (int n = 0; n < 4; ++n) x.v[n] = a.v[n] + f * (b.v[n] - a.v[n]);
  return x;
}
HWY_INLINE void StoreFour(const Four& x, float* out) { std::copy_n(x.v, 4, out); }
#else
using D4 = hn::Full128<float>;
using Four = hn::Vec<D4>;
HWY_INLINE Four LoadFour(const float* voxel) { return hn::LoadU(D4(), voxel); }
HWY_INLINE Four LoadFour(const std::int16_t* voxel) {
  const hn::Half<hn::Full128<std::int16_t>> d16;
  return hn::ConvertTo(D4(), hn::PromoteTo(hn::Full128<std::int32_t>(), hn::LoadU(d16, voxel)));
}
HWY_INLINE Four LerpFour(Four a, Four b, float f) {
  return hn::Add(a, hn::Mul(hn::Set(D4(), f), hn::Sub(b, a)));
}
HWY_INLINE void StoreFour(Four x, float* out) { hn::StoreU(x, D4(), out); }
#endif

/// The same for four values a voxel, lane by lane into out[4 * lane]: much faster than gathers.
template <class T>
HWY_INLINE void InterpolateFour(const Strides& s, const CellVector& c, const T* voxels, float* out) {
  constexpr int most = HWY_MAX_BYTES / 4;
  HWY_ALIGN std::int32_t index[most];
  HWY_ALIGN float fx[most], fy[most], fz[most];
  hn::Store(c.index, DI(), index);
  hn::Store(c.fx, DF(), fx);
  hn::Store(c.fy, DF(), fy);
  hn::Store(c.fz, DF(), fz);
  for (int lane = 0; lane < int(hn::Lanes(DF())); ++lane) {
    const T* cell = voxels + std::size_t(4) * std::size_t(index[lane]);
    const auto row = [&](int offset) {
      const T* a = cell + std::size_t(4) * std::size_t(offset);
      return LerpFour(LoadFour(a), LoadFour(a + 4 * s.next), fx[lane]);
    };
    const Four near = LerpFour(row(0), row(s.row), fy[lane]);
    const Four far = LerpFour(row(s.slice), row(s.slice + s.row), fy[lane]);
    StoreFour(LerpFour(near, far, fz[lane]), out + 4 * lane);
  }
}

/// Where the n-th samples (SCENE 9) of the rays from `first` on lie.
HWY_INLINE V3 SamplePosition(const RayRow& r, int first, int n) {
  const DF df;
  const auto load = [&](const std::vector<float>& v) { return hn::LoadU(df, v.data() + first); };
  const MF last = hn::RebindMask(df, hn::Eq(hn::LoadU(DI(), r.steps.data() + first), SetI(n + 1)));
  const VF middle = hn::IfThenElse(last, load(r.lastMiddle), Set(float(n) + 0.5f));
  return Add({load(r.startX), load(r.startY), load(r.startZ)},
             Scale({load(r.moveX), load(r.moveY), load(r.moveZ)}, middle));
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
