#pragma once

#include <nlohmann/json.hpp>

#include "viewer/volume/result.h"

namespace volumen {

struct DerivedObject;

/// What `info` says of an object that refers to pictures (resources/docs/import.md).
nlohmann::ordered_json derivedToJson(const DerivedObject& object);

/// All that is read of it. The Error is a sentence that names its file.
Result<nlohmann::ordered_json> contentsToJson(const DerivedObject& object);

}  // namespace volumen
