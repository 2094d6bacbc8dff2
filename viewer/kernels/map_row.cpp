// Shades the nodes of a reflectance map.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/map_row.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/kernels/map_row.h"
#include "viewer/kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

void ShadeMapRow(const Lighting& lighting, const MapRow& row, float* nodes) {
  const DF df;
  const int lanes = int(hn::Lanes(df));
  const V3 viewer = Broadcast(lighting.viewer);
  const int floats = ReflectanceMap::floatsANode(lighting.coloured), kept = lighting.coloured ? 6 : 2;
  HWY_ALIGN float parts[6 * HWY_MAX_BYTES / sizeof(float)];
  for (int first = 0; first < row.n; first += lanes) {
    const VF doubled = hn::Mul(hn::Iota(df, float(first)), Set(2));
    VF component[3];
    component[row.axis] = Set(row.sign);
    component[(row.axis + 1) % 3] =
        hn::Div(hn::Mul(hn::Add(doubled, Set(float(1 - row.n))), Set(row.sign)), Set(row.span));
    component[(row.axis + 2) % 3] = Set(row.sign * row.v);
    const V3 direction{component[0], component[1], component[2]};
    const DS shade = ShadePhong<false>(
        lighting, Scale(direction, hn::Div(Set(1), hn::Sqrt(Dot(direction, direction)))), viewer);
    const VF made[6] = {shade.d.x, shade.s.x, shade.d.y, shade.s.y, shade.d.z, shade.s.z};
    for (int c = 0; c < 6; ++c) hn::StoreU(made[c], df, parts + c * lanes);
    for (int n = 0; n < lanes && first + n < row.n; ++n)
      for (int c = 0; c < kept; ++c) nodes[(first + n) * floats + c] = parts[c * lanes + n];
  }
}

MapRowKernel ChooseMapRow() { return ShadeMapRow; }

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ChooseMapRow);
MapRowKernel chooseMapRowKernel() { return HWY_DYNAMIC_DISPATCH(ChooseMapRow)(); }

}  // namespace volumen
#endif  // HWY_ONCE
