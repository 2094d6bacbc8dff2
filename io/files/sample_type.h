#pragma once

#include <cstddef>
#include <cstdint>

namespace volumen {

/// Sample types shared by NRRD, NIfTI and MetaImage.
enum class SampleType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Calls f(T{}) with the C++ type of `type`.
template <class F>
auto withSampleType(SampleType type, F&& f) {
  switch (type) {
    case SampleType::int8:
      return f(std::int8_t{});
    case SampleType::uint8:
      return f(std::uint8_t{});
    case SampleType::int16:
      return f(std::int16_t{});
    case SampleType::uint16:
      return f(std::uint16_t{});
    case SampleType::int32:
      return f(std::int32_t{});
    case SampleType::uint32:
      return f(std::uint32_t{});
    case SampleType::int64:
      return f(std::int64_t{});
    case SampleType::uint64:
      return f(std::uint64_t{});
    case SampleType::float32:
      return f(float{});
    case SampleType::float64:
      break;
  }
  return f(double{});
}

inline std::size_t bytesOf(SampleType type) {
  return withSampleType(type, [](auto sample) { return sizeof sample; });
}

}  // namespace volumen
