#pragma once

#include <string>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen::dicom {

/// One line of an attribute list. Text is UTF-8 and may hold control characters, as the file does.
struct AttributeLine {
  int depth = 0;      ///< sequence depth; 0 for the data set itself
  std::string tag;    ///< "(0010,0010)"; "Item 1" for an item of a sequence
  std::string name;   ///< "PatientName"; empty if the dictionary does not know it
  std::string vr;     ///< "PN"; empty for items
  std::string value;  ///< text and numbers, at most some hundred characters; "1024 bytes" for other values
};

/// Returns all attributes of a DICOM file up to its pixel data in file order, with those of a sequence after
/// it. An Error is a sentence without the file's name and says why the file cannot be read.
Result<std::vector<AttributeLine>> listAttributes(const std::string& path);

}  // namespace volumen::dicom
