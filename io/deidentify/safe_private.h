#pragma once

#include <cstdint>
#include <set>

#include "io/dicom/data_set.h"

namespace volumen {

/// Returns the numbers of the private elements of a scope that are known to hold no identity (PS3.15 table
/// E.3.10-1, those of b values, SUV and rescaling), by creator and element, with the elements that reserve
/// their blocks.
std::set<std::uint32_t> safePrivateElements(const dicom::DataSet& data, dicom::DataSet::Scope scope);

}  // namespace volumen
