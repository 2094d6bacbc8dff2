#pragma once

#include <string>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen::dicom {

/// An attribute as a person reads it. Text is UTF-8 and may hold control characters, as the file does.
struct AttributeLine {
  int depth = 0;      ///< in sequences; 0: of the data set itself
  std::string tag;    ///< "(0010,0010)"; "Item 1" for an item of a sequence
  std::string name;   ///< "PatientName"; empty where the dictionary does not know it
  std::string vr;     ///< "PN"; empty for items
  std::string value;  ///< text and numbers, at most some hundred characters; "1024 bytes" of what is neither
};

/// All attributes of a DICOM file up to its pixel data, in file order, those of sequences behind their
/// sequence. An Error where it cannot be read, a sentence without the file's name.
Result<std::vector<AttributeLine>> listAttributes(const std::string& path);

}  // namespace volumen::dicom
