#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "viewer/segment/code.h"

namespace volumen {

/// A segment type: its code and category (SNOMED CT, from PS3.16 CID 7150 and 7166 and the lists of 3D
/// Slicer) and its display colour, sRGB.
struct TissueCode {
  Code category, type;
  glm::u8vec3 colour{0};
  bool paired = false;  ///< True if it exists on the right and the left
};

/// Returns all types on offer, by category.
std::span<const TissueCode> tissueCodes();
/// Returns the categories, each once.
std::span<const Code> tissueCategories();
/// Returns "Tissue", the type of segments without further details.
const TissueCode& anyTissue();

/// Returns the type with this code meaning, ignoring case; null if there is none.
const TissueCode* tissueNamed(std::string_view name);
/// Returns the type with this value and scheme; null if unknown. SRT and SNM3 codes of old objects have other
/// values and are unknown.
const TissueCode* tissueOf(const Code& type);

/// Return the laterality modifiers.
const Code& rightSide();
const Code& leftSide();

}  // namespace volumen
