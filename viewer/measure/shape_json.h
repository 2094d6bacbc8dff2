#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "viewer/measure/measure.h"
#include "viewer/scene/json_fields.h"

namespace volumen {

/// Reads a list of shapes (resources/docs/measure.md). Missing and unknown fields and shapes that
/// checkShape() refuses yield an Error that names the field ("[2].plane.right must be ...").
Result<std::vector<Shape>> shapesFromJson(const std::string& text);

/// Reads or writes one shape of such a list or of a larger file, without fields that have their default. The
/// caller must call checkShape().
void shapeFields(JsonFields object, Shape& shape);

/// Returns the list that shapesFromJson() reads; it restores the shapes exactly. Each shape names its series
/// by the names and texts of `series`, which no reader needs.
std::string shapesToJson(const std::vector<Shape>& shapes,
                         const std::vector<std::pair<std::string, std::string>>& series = {});

/// Returns the shape's numbers with its kind and name, as listed on the same page.
nlohmann::ordered_json measuredToJson(const Shape& shape, const Result<Measured>& measured);

}  // namespace volumen
