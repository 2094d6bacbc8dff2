#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// The words that an option may have and what they mean, in the order of its help.
template <class T>
using OptionWords = std::vector<std::pair<std::string, T>>;

template <class T>
std::vector<std::string> keys(const OptionWords<T>& words) {
  std::vector<std::string> out;
  for (const auto& word : words) out.push_back(word.first);
  return out;
}

/// Of a word that the command line was checked for.
template <class T>
T meaning(const OptionWords<T>& words, const std::string& word) {
  return std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.first == word; })->second;
}

/// The word of one of the meanings.
template <class T>
std::string wordOf(const OptionWords<T>& words, T meant) {
  return std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.second == meant; })->first;
}

/// The value of --size, "WIDTHxHEIGHT"; an Error says what is wrong with it.
Result<glm::ivec2> sizeOf(const std::string& text);

/// `count` numbers with commas between them, as `option` takes them; an Error shows `example`.
Result<std::vector<double>> numbersOf(const std::string& option, const std::string& text, std::size_t count,
                                      const std::string& example);

}  // namespace volumen
