#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/study/identity.h"

namespace volumen {

/// DICOM keywords and values.
using IdentityFields = std::vector<std::pair<std::string, std::string>>;

/// Returns the fields that identify a series in files other than DICOM: patient, patient ID, study date,
/// number, description and UID of the series. Empty values are left out, and each value is one line.
IdentityFields identityFields(const SeriesIdentity& series);

}  // namespace volumen
