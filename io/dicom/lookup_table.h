#pragma once

#include <cstdint>
#include <vector>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// A look-up table (PS3.3 C.11.1.1, C.11.2.1.1, C.7.6.3.1.5). `first` is the input of the first entry. Inputs
/// beyond either end take the entry there.
struct LookupTable {
  double first = 0;
  int bits = 16;      ///< bits of an entry, 8 .. 16, as the length and values of the data imply
  int saidBits = 16;  ///< bits that the descriptor states
  std::vector<std::uint16_t> entries;

  std::uint16_t at(double input) const;
  /// Returns the number of bits that the largest entry needs.
  int usedBits() const;
  /// Returns the largest entry that `bits` can hold.
  double top() const { return double((1u << bits) - 1); }
};

/// Tags of the descriptor, the data and the segmented data (0 if never segmented).
struct LookupTags {
  std::uint32_t descriptor = 0, data = 0, segments = 0;
};

/// Reads a table. If 8-bit entries are declared wider, or wider entries of a palette as 8 bits, they are read
/// as stored, with a remark in `data`. `isSigned` says that inputs may be negative; a descriptor of VR SS
/// implies it. An Error names the attribute that is missing, wrong or too short.
Result<LookupTable> readLookupTable(const DataSet& data, DataSet::Scope scope, LookupTags tags,
                                    bool isSigned);

}  // namespace volumen::dicom
