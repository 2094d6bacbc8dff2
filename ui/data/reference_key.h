#pragma once

#include <compare>
#include <memory>
#include <string>

#include "io/study/reference.h"

namespace volumen {

/// Names an object that refers to pictures: its file and what it is called there.
struct ReferenceKey {
  std::string path, id;
  auto operator<=>(const ReferenceKey&) const = default;
  bool empty() const { return path.empty() && id.empty(); }
};

inline ReferenceKey keyOf(const Reference& object) { return {object.path, object.id}; }

using ReferencePtr = std::shared_ptr<const Reference>;

}  // namespace volumen
