#pragma once

#include <cctype>
#include <string>

#include "viewer/recipe/recipe.h"

namespace volumen {

/// Returns the name of a built-in recipe on the command line, such as "lungs-and-airways".
inline std::string recipeWord(const Recipe& recipe) {
  std::string word;
  for (const char c : recipe.name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      word += char(std::tolower(static_cast<unsigned char>(c)));
    else if (!word.empty() && word.back() != '-')
      word += '-';
  while (word.ends_with('-')) word.pop_back();
  return word;
}

}  // namespace volumen
