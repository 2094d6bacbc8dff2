#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "viewer/segment/segmented.h"

namespace volumen {

/// Returns one of ten distinct colours; `number` wraps around.
glm::u8vec3 tenColour(int number);
/// Returns the first of the ten colours, starting at `first`, that is not taken; colour `first` if all are.
glm::u8vec3 freeTenColour(int first, const std::function<bool(glm::u8vec3)>& isTaken);

/// Gives each segment without a colour a free one of the ten, starting at that of its number.
void addColours(std::span<Segmented> maps);

/// New names: of segments that had none, and of segments that had the name of an earlier one.
struct NamesGiven {
  std::vector<std::string> unnamed, alike;
};
/// Gives unnamed segments a name by their number ("Segment 3") and renames duplicates (freeName()). All names
/// are unique afterwards.
NamesGiven addNames(std::span<Segmented> maps);

}  // namespace volumen
