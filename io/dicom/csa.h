#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// The values of each field of a Siemens CSA header, as text.
using CsaFields = std::map<std::string, std::vector<std::string>>;

/// Reads a CSA header of either version. What is damaged ends it: the fields in front of that are kept.
CsaFields readCsa(Bytes bytes);

/// The image header (0029,xx10) of the private block that "SIEMENS CSA HEADER" reserves; empty where there is
/// none.
CsaFields readCsaImageHeader(const DataSet& data);

}  // namespace volumen::dicom
