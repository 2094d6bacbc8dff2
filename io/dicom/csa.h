#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// The fields of a Siemens CSA header with their values as text.
using CsaFields = std::map<std::string, std::vector<std::string>>;

/// Reads a CSA header of either version. Damage ends the reading; the fields before it are kept.
CsaFields readCsa(Bytes bytes);

/// Returns the image header (0029,xx10) of the private block of "SIEMENS CSA HEADER"; empty if there is none.
CsaFields readCsaImageHeader(const DataSet& data);

}  // namespace volumen::dicom
