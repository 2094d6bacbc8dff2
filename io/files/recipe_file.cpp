#include "io/files/recipe_file.h"

#include "io/regular_file.h"

namespace volumen {

namespace {
constexpr std::uint64_t mostRecipeBytes = 64 << 20;
}

Result<std::string> recipeText(const std::string& path) {
  const auto file = RegularFile::open(path);
  if (!file) return Error{path + " cannot be read: " + file.message() + "."};
  if (file->size() > mostRecipeBytes) return Error{path + " is too large for a recipe."};
  const auto bytes = file->read(0, file->size());
  if (!bytes) return Error{path + " cannot be read: " + bytes.message() + "."};
  return std::string(bytes->begin(), bytes->end());
}

}  // namespace volumen
