#pragma once

#include <QString>
#include <string>
#include <vector>

#include "io/deidentify/folded_text.h"
#include "io/deidentify/profile.h"
#include "io/dicom/data_set.h"

namespace volumen {

/// The names and identifiers of the patient, other persons and places in a data set. Attributes that the
/// profile keeps are not among them. No other attribute may contain them.
class IdentifyingTexts {
 public:
  IdentifyingTexts(const dicom::DataSet& data, const ConfidentialityProfile& profile);

  /// Returns true if a text contains one of them. Case and accents do not count, nor do blanks and signs
  /// between letters. Whole names are found in either order. Single parts of names are found if they have at
  /// least 4 letters. Family names need 3 letters, or 2 ideographs. Identifiers need 4 characters. Those of
  /// 4 or 5 digits alone are found only as they are written.
  bool isIn(const std::string& text) const;

 private:
  /// A name, a part of one or an identifier, folded in each way to compare umlauts.
  struct Name {
    QString spelled, dropped;
    bool isInWords = false;  ///< true if it is also found inside longer words
    bool isParted = false;   ///< true if it is found only with something between its letters
  };
  void addId(const QString& id);
  void addName(const QString& name);
  void addWhole(const QStringList& parts);
  void addPart(const QString& part, bool isFamily);

  std::vector<QString> texts_;  // identifiers as written, in lower case
  std::vector<Name> ids_;
  std::vector<Name> names_;
};

}  // namespace volumen
