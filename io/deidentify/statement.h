#pragma once

#include <string>
#include <vector>

#include "io/deidentify/file_parts.h"
#include "io/deidentify/profile.h"
#include "io/deidentify/rewrite_data_set.h"

namespace volumen {

/// The edition of the table of attributes that the program contains.
inline constexpr const char* profileEdition = "PS3.15 E.1-1 2026c";

/// A code with its meaning, of scheme DCM.
struct MethodCode {
  const char *value, *meaning;
};

/// An element that states how a data set was de-identified: a text, or a sequence of codes if it has any.
struct StatementElement {
  std::uint32_t tag;
  std::uint16_t vr;
  std::string value;
  std::vector<MethodCode> codes;
};

/// Returns the elements that say how a data set was de-identified, in order of their tags (PS3.3 C.7.1.1,
/// C.12.1, codes of CID 7050).
std::vector<StatementElement> statementElements(const Rewriting& how);

void addStatement(const StatementElement& element, dicom::Encoding encoding, FileParts& parts);

/// Returns whether a SOP class is an image of one frame or an older multi-frame one, in which dates of series
/// and acquisition are optional.
bool isClassicImage(const std::string& sopClass);

}  // namespace volumen
