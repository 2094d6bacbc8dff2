#pragma once

#include <string>
#include <vector>

#include "io/deidentify/profile.h"
#include "io/dicom/data_set.h"

namespace volumen {

/// The names and identifiers of a data set's patient, and of persons and places named in it, as far as their
/// own attributes do not stay: texts that must not stand in another attribute.
class IdentifyingTexts {
 public:
  IdentifyingTexts(const dicom::DataSet& data, const ConfidentialityProfile& profile);
  /// Returns whether a text holds one of them, in upper or lower case.
  bool isIn(const std::string& text) const;

 private:
  std::vector<std::string> texts_;
};

}  // namespace volumen
