#pragma once

#include <string>
#include <vector>

#include "io/deidentify/profile.h"
#include "io/dicom/data_set.h"

namespace volumen {

/// The names and identifiers of the patient, of other persons and of places in a data set, unless the profile
/// keeps their attribute. No other attribute may contain them.
class IdentifyingTexts {
 public:
  IdentifyingTexts(const dicom::DataSet& data, const ConfidentialityProfile& profile);
  /// Returns whether a text holds one of them, in upper or lower case.
  bool isIn(const std::string& text) const;

 private:
  std::vector<std::string> texts_;
};

}  // namespace volumen
