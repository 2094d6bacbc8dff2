#pragma once

#include <charconv>
#include <string>

namespace volumen {

/// Returns the shortest decimal text that reads back as the same double.
inline std::string numberText(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

/// Returns the shortest text that reads back (via double) as the same float: 0.1, not 0.10000000149011612.
inline std::string numberText(float value) {
  char text[32];
  char* const end = std::to_chars(text, text + sizeof text, value).ptr;
  double readBack = 0;
  std::from_chars(text, end, readBack);
  return float(readBack) == value ? std::string(text, end) : numberText(double(value));
}

}  // namespace volumen
