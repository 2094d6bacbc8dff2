#pragma once

#include <string>
#include <vector>

#include "io/deidentify/file_parts.h"
#include "io/deidentify/profile.h"
#include "io/deidentify/pseudonyms.h"

namespace volumen {

/// A data set as it is scanned, up to its pixels.
struct ScannedDataSet {
  dicom::Bytes bytes;
  const std::vector<dicom::Element>& elements;
  dicom::Encoding encoding;
};

/// How a data set is written again.
struct Rewriting {
  Retained retained;
  bool isFaceless = false;  ///< the face is taken from its pixels, which follow: it becomes DERIVED
};

/// Writes the elements of a data set to `parts` as PS3.15 E.1 asks, items of sequences too, in the encoding
/// that they have. What neither the table nor DCMTK's dictionary knows is left out, as are lengths of groups.
/// Texts that hold the patient's name or an identifier elsewhere become dummies. What was done is written
/// into the data set (E.1.1, items 8 to 10). The Error, without the file's name: what cannot be written.
Status rewriteDataSet(const ScannedDataSet& data, const Rewriting& how, const Pseudonyms& pseudonyms,
                      FileParts& parts);

}  // namespace volumen
