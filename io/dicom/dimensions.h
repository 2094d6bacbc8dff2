#pragma once

#include <string>
#include <vector>

#include "io/dicom/data_set.h"

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

}  // namespace volumen::dicom
