#pragma once

#include <string>
#include <vector>

#include "io/dicom/frame_scopes.h"

namespace volumen::dicom {

/// What the dimensions of a multi-frame picture (PS3.3 C.7.6.17) index.
struct Dimensions {
  std::vector<std::uint32_t> pointers;  ///< the attribute of each

  explicit Dimensions(const DataSet& data);
  /// Where in its stack a frame lies, from 1: InStackPositionNumber, or the index of a dimension that runs
  /// along places; 0 where neither is given.
  std::uint32_t inStack(const DataSet& data, DataSet::Scope frameContent) const;
  /// The indices of all other dimensions: "2, 1".
  std::string others(const DataSet& data, DataSet::Scope frameContent) const;
};

/// How many attributes may tell apart the pictures of one place.
extern const std::size_t partCount;

/// What may tell apart the pictures of one place, `partCount` of them, as text, in the order in which it is
/// tried: time point, kind of picture, acquisition, diffusion weight, trigger time, diffusion direction,
/// other dimensions.
std::vector<std::string> readParts(const DataSet& data, const FrameScopes& at, const Dimensions& dimensions);

/// How a volume is named that one of these parts tells from others.
struct PartName {
  std::string timePoint, label;  ///< as Series has them
};

/// The name of value `n` of the different values that part `part` has.
PartName partName(std::size_t part, const std::vector<std::string>& values, std::size_t n);

/// A number in the fewest digits.
std::string realText(double value);
/// That in an FD; empty where there is none.
std::string realText(const DataSet& data, std::uint32_t tag, DataSet::Scope scope);

/// Functional groups that say what a frame shows.
inline constexpr std::uint32_t frameContentGroup = 0x00209111, mrEchoGroup = 0x00189114,
                               mrDiffusionGroup = 0x00189117;

}  // namespace volumen::dicom
