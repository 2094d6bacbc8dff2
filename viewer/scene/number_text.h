#pragma once

#include <charconv>
#include <string>

namespace volumen {

/// Returns the shortest decimal text that reads back as the same double.
inline std::string numberText(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

/// Returns the double with the fewest digits that rounds to the same float: 0.1, not 0.10000000149011612.
inline double shortestDouble(float value) {
  char text[32];
  double readBack = 0;
  std::from_chars(text, std::to_chars(text, text + sizeof text, value).ptr, readBack);
  return float(readBack) == value ? readBack : double(value);
}

/// Returns the shortest text that reads back (via double) as the same float.
inline std::string numberText(float value) { return numberText(shortestDouble(value)); }

}  // namespace volumen
