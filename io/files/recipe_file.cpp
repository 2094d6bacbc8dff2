#include "io/files/recipe_file.h"

#include "io/regular_file.h"

namespace volumen {

Result<std::string> recipeText(const std::string& path) {
  constexpr std::uint64_t mostBytes = 64 << 20;
  return wholeText(path, mostBytes, "a recipe");
}

}  // namespace volumen
