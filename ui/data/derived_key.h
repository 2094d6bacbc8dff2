#pragma once

#include <compare>
#include <memory>
#include <string>

#include "io/study/derived_object.h"

namespace volumen {

/// Identifies an object that refers to pictures: its file, and its id there.
struct DerivedKey {
  std::string path, id;
  auto operator<=>(const DerivedKey&) const = default;
  bool empty() const { return path.empty() && id.empty(); }
};

inline DerivedKey keyOf(const DerivedObject& object) { return {object.path, object.id}; }

using DerivedObjectPtr = std::shared_ptr<const DerivedObject>;

}  // namespace volumen
