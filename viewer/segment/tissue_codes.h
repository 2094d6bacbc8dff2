#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "viewer/segment/code.h"

namespace volumen {

/// What a segment can be: its code and its category's (SNOMED CT, as PS3.16 CID 7150 and 7166 and the lists
/// of 3D Slicer have them), and the colour that it is shown in, sRGB.
struct TissueCode {
  Code category, type;
  glm::u8vec3 colour{0};
  bool paired = false;  ///< there is a right and a left one
};

/// All that are offered, by category.
std::span<const TissueCode> tissueCodes();
/// The categories, each once.
std::span<const Code> tissueCategories();
/// "Tissue": what a segment is of which no more is said.
const TissueCode& anyTissue();

/// By its code's meaning, upper and lower case alike; null where there is none of that name.
const TissueCode* tissueNamed(std::string_view name);
/// By value and scheme; SRT and SNM3 of old objects are other values, and not known.
const TissueCode* tissueOf(const Code& type);

/// The modifiers of what is on one side.
const Code& rightSide();
const Code& leftSide();

}  // namespace volumen
