#pragma once

#include <string>
#include <vector>

#include "io/export/dicom_elements.h"
#include "viewer/segment/code.h"

namespace volumen {

/// A content item of a structured report (PS3.3 C.17.3) and the items below it.
struct ContentItem {
  const char* relationship = "";  ///< to the item above: "CONTAINS"; empty for the document itself
  const char* type = "";          ///< value type: "NUM"
  Code name{};                    ///< concept name; may be empty for images
  DicomElements value{};          ///< the elements that hold the value
  std::vector<ContentItem> content{};
};

/// Returns the item and all items below it as elements of a data set.
DicomElements elementsOf(const ContentItem& root);

/// Returns a container. `templateId` is its template of DCMR, or empty.
ContentItem containerItem(const char* relationship, const Code& name, const char* templateId = "");
ContentItem conceptItem(const char* relationship, const Code& name, const Code& value);
ContentItem textItem(const char* relationship, const Code& name, const std::string& text);
ContentItem uidItem(const char* relationship, const Code& name, const std::string& uid);

}  // namespace volumen
