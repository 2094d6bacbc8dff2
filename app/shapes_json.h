#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "viewer/measure/measure.h"

namespace volumen {

/// Reads a list of shapes (resources/docs/measure.md). Missing fields, unknown ones and what checkShape()
/// refuses are refused with a sentence that names the field ("[2].plane.right must be ...").
Result<std::vector<Shape>> shapesFromJson(const std::string& text);

/// The shape's numbers with its kind and name, as the same page lists them.
nlohmann::ordered_json measuredToJson(const Shape& shape, const Result<Measured>& measured);

}  // namespace volumen
