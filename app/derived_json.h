#pragma once

#include <nlohmann/json.hpp>

#include "viewer/volume/result.h"

namespace volumen {

struct DerivedObject;

/// Returns the JSON that `info` prints for an object that refers to images (resources/docs/import.md).
nlohmann::ordered_json derivedToJson(const DerivedObject& object);

/// Reads an object and returns its contents. The Error names its file.
Result<nlohmann::ordered_json> contentsToJson(const DerivedObject& object);

}  // namespace volumen
