#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "viewer/measure/measure.h"
#include "viewer/scene/json_fields.h"

namespace volumen {

/// Reads a list of shapes (resources/docs/measure.md). Missing fields, unknown ones and what checkShape()
/// refuses are refused with a sentence that names the field ("[2].plane.right must be ...").
Result<std::vector<Shape>> shapesFromJson(const std::string& text);

/// Reads one shape of such a list or of a larger file; what is wrong is kept by `fields`. checkShape() is the
/// caller's.
Shape readShape(JsonFields fields);

/// A shape as readShape() reads it; what has its default is left out.
nlohmann::ordered_json shapeToJson(const Shape& shape);

/// The list that shapesFromJson() reads: the same shapes, to the bit.
std::string shapesToJson(const std::vector<Shape>& shapes);

/// The shape's numbers with its kind and name, as the same page lists them.
nlohmann::ordered_json measuredToJson(const Shape& shape, const Result<Measured>& measured);

}  // namespace volumen
