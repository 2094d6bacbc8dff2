#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "viewer/segment/segmented.h"

namespace volumen {

/// The colour of a number: one of ten that are far apart, then they begin again.
glm::u8vec3 tenColour(int number);
/// The first of the ten from that of a number on that is not taken; that of the number where all are.
glm::u8vec3 freeTenColour(int first, const std::function<bool(glm::u8vec3)>& isTaken);

/// Gives each segment without a colour the next of the ten that no other one has, by its number.
void addColours(std::span<Segmented> maps);

/// The names that segments have got in place of none, and of one that another segment has.
struct NamesGiven {
  std::vector<std::string> unnamed, alike;
};
/// Gives segments without a name one, "Segment 3" by their number, and those that are called as one before
/// them another one (freeName()): no two are called alike then.
NamesGiven addNames(std::span<Segmented> maps);

}  // namespace volumen
