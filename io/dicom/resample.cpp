#include "io/dicom/resample.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "viewer/volume/buffer.h"

namespace volumen::dicom {
namespace {

template <class Value>
void fillSlice(const Value* a, const Value* b, double weight, Value* out, std::size_t count) {
  for (std::size_t n = 0; n < count; ++n) {
    const double value = double(a[n]) + weight * (double(b[n]) - double(a[n]));
    if constexpr (std::is_integral_v<Value>)
      out[n] = Value(std::floor(value + 0.5));
    else
      out[n] = Value(value);
  }
}

}  // namespace

VoxelValues resampleSlices(const VoxelValues& acquired, std::size_t sliceVoxels,
                           const std::vector<Stack::Source>& sources) {
  return std::visit(
      [&](const auto& values) -> VoxelValues {
        auto out = zeros<typename std::decay_t<decltype(values)>::value_type>(sliceVoxels * sources.size());
        tbb::parallel_for(std::size_t(0), sources.size(), [&](std::size_t k) {
          const auto* below = values.data() + std::size_t(sources[k].below) * sliceVoxels;
          auto* slice = out.data() + k * sliceVoxels;
          if (sources[k].weight == 0)
            std::copy_n(below, sliceVoxels, slice);
          else
            fillSlice(below, below + sliceVoxels, sources[k].weight, slice, sliceVoxels);
        });
        return out;
      },
      acquired);
}

}  // namespace volumen::dicom
