#pragma once

#include <string>
#include <vector>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// The dimension indices of a multi-frame picture (PS3.3 C.7.6.17).
struct Dimensions {
  std::vector<std::uint32_t> pointers;  ///< the attribute that each dimension indexes

  explicit Dimensions(const DataSet& data);
  /// Returns the position of a frame in its stack, from 1: InStackPositionNumber, else the index of a spatial
  /// dimension; 0 if neither is given.
  std::uint32_t inStack(const DataSet& data, DataSet::Scope frameContent) const;
  /// Returns the indices of all other dimensions: "2, 1".
  std::string others(const DataSet& data, DataSet::Scope frameContent) const;
};

}  // namespace volumen::dicom
