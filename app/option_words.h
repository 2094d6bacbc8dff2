#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// The words of an option and their meanings, in the order of its help.
template <class T>
using OptionWords = std::vector<std::pair<std::string, T>>;

template <class T>
std::vector<std::string> keys(const OptionWords<T>& words) {
  std::vector<std::string> out;
  for (const auto& word : words) out.push_back(word.first);
  return out;
}

/// Returns the meaning of a word; the command line has been checked for it.
template <class T>
T meaning(const OptionWords<T>& words, const std::string& word) {
  return std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.first == word; })->second;
}

/// Returns the word of a meaning.
template <class T>
std::string wordOf(const OptionWords<T>& words, T meant) {
  return std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.second == meant; })->first;
}

/// Parses the value of --size, "WIDTHxHEIGHT". The Error states the problem.
Result<glm::ivec2> sizeOf(const std::string& text);

/// Parses `count` numbers separated by commas, the value of `option`. The Error shows `example`.
Result<std::vector<double>> numbersOf(const std::string& option, const std::string& text, std::size_t count,
                                      const std::string& example);

}  // namespace volumen
