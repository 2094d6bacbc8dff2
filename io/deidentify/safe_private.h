#pragma once

#include <cstdint>
#include <map>

#include "io/dicom/data_set.h"

namespace volumen {

/// Returns the private elements of a scope that are known to be safe, and the elements that reserve their
/// blocks: by their number in DataSet, the VR of the list. The list is the part of PS3.15 table E.3.10-1 on
/// CT, MR and PET. Elements whose values do not fit that VR are left out. Texts and codes may still hold a
/// name.
std::map<std::uint32_t, std::uint16_t> safePrivateElements(const dicom::DataSet& data,
                                                           dicom::DataSet::Scope scope);

/// Returns the VR of a private element, which is the one of the list if the element is UN or says none.
std::uint16_t vrOfPrivate(const dicom::Element& e, std::uint16_t listed);

}  // namespace volumen
