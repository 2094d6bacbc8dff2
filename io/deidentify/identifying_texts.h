#pragma once

#include <QString>
#include <string>
#include <vector>

#include "io/deidentify/folded_text.h"
#include "io/deidentify/profile.h"
#include "io/dicom/data_set.h"

namespace volumen {

/// The names and identifiers of the patient, of other persons and of places in a data set, unless the profile
/// keeps their attribute. No other attribute may contain them.
class IdentifyingTexts {
 public:
  IdentifyingTexts(const dicom::DataSet& data, const ConfidentialityProfile& profile);

  /// Returns whether a text holds one of them. Case, accents and all between the letters of a name do not
  /// count. Whole names are found in either order, single parts from four letters on (a family name from
  /// three, in ideographs from two).
  bool isIn(const std::string& text) const;

 private:
  /// A name or a part of one, in each way to compare umlauts.
  struct Name {
    QString spelled, dropped;
    bool isInWords = false;  ///< it is found inside longer words, too
    bool isParted = false;   ///< it is found only with something between its letters
  };
  void addName(const QString& name);
  void addWhole(const QStringList& parts);
  void addPart(const QString& part, bool isFamily);

  std::vector<QString> texts_;  // in lower case
  std::vector<Name> names_;
};

}  // namespace volumen
