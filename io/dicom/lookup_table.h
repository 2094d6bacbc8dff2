#pragma once

#include <cstdint>
#include <vector>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// A look-up table (PS3.3 C.11.1.1, C.11.2.1.1, C.7.6.3.1.5): the entry of `first` is the first; inputs
/// beyond either end take the entry there.
struct LookupTable {
  double first = 0;
  int bits = 16;      ///< of an entry, 8 .. 16, as the length and the values of the data have it
  int saidBits = 16;  ///< as the descriptor has it
  std::vector<std::uint16_t> entries;

  std::uint16_t at(double input) const;
  /// The bits that its largest entry needs.
  int usedBits() const;
  /// The largest entry that `bits` can hold.
  double top() const { return double((1u << bits) - 1); }
};

/// The tags of a table: its descriptor and its data, or its data in segments (0: never so).
struct LookupTags {
  std::uint32_t descriptor = 0, data = 0, segments = 0;
};

/// Reads a table. Where its data have entries of 8 bits and the descriptor says more, or a palette more and
/// it says 8, they are read as they are, and `data` has a remark. `isSigned`: whether inputs may be negative
/// (a descriptor of VR SS says so itself). An Error says which of its attributes is missing, wrong or too
/// short.
Result<LookupTable> readLookupTable(const DataSet& data, DataSet::Scope scope, LookupTags tags,
                                    bool isSigned);

}  // namespace volumen::dicom
