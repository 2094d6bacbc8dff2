#include "ui/controller/recipe_files.h"

#include "io/files/output_file.h"
#include "io/files/recipe_file.h"

namespace volumen {

Result<Recipe> recipeFromFile(const std::string& path) {
  const auto text = recipeText(path);
  if (!text) return text.error();
  Result<Recipe> recipe = readRecipe(*text);
  if (!recipe) return Error{path + ": " + recipe.message()};
  return recipe;
}

Status writeRecipe(const std::string& path, const Recipe& recipe) {
  return writeWholeFile(path, recipeJson(recipe));
}

}  // namespace volumen
