#pragma once

#include <cstdint>
#include <set>

#include "io/dicom/data_set.h"

namespace volumen {

/// Returns which private elements of a scope are known to hold no identity: their numbers in DataSet, with
/// those of the elements that reserve their blocks. The list is the part of PS3.15 table E.3.10-1 on CT, MR
/// and PET.
std::set<std::uint32_t> safePrivateElements(const dicom::DataSet& data, dicom::DataSet::Scope scope);

}  // namespace volumen
