#pragma once

#include <cstdint>
#include <span>

namespace volumen {

/// Returns true for the tags of top-level elements that a slice takes over from the images it is made of.
bool isCopied(std::uint32_t tag);

/// An attribute that has the tag `from` in functional groups and `to` in single-frame images.
struct RenamedElement {
  std::uint32_t from, to;
};

/// Returns all attributes with different tags in functional groups and single-frame images.
std::span<const RenamedElement> renamedElements();

}  // namespace volumen
