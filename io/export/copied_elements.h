#pragma once

#include <cstdint>
#include <span>

namespace volumen {

/// Returns whether a top-level element of a picture also holds for a slice that is made of it.
bool isCopied(std::uint32_t tag);

/// An attribute whose tag in functional groups differs from that in single-frame images.
struct RenamedElement {
  std::uint32_t from, to;
};

/// Returns all attributes with two tags.
std::span<const RenamedElement> renamedElements();

}  // namespace volumen
