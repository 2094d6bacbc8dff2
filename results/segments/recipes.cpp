#include "results/segments/recipes.h"

#include <algorithm>

#include "io/files/output_file.h"
#include "io/files/recipe_file.h"
#include "results/series/series_facts.h"

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

std::vector<const Recipe*> recipesFor(const std::string& modality) {
  std::vector<const Recipe*> found;
  for (const Recipe& recipe : builtInRecipes())
    if (std::ranges::find(recipe.modalities, modality) != recipe.modalities.end()) found.push_back(&recipe);
  return found;
}

std::vector<std::string> notesOf(const Recipe& recipe, const Series& series) {
  std::vector<std::string> notes;
  const std::vector<std::string>& all = recipe.modalities;
  const std::string& modality = series.modality;
  if (!all.empty() && !modality.empty() && std::ranges::find(all, modality) == all.end())
    notes.push_back("The recipe \"" + recipe.name + "\" is for " + all.front() + ", the series is " +
                    modality + ": look at what it found.");
  if (recipe.needsContrast && series.format == "DICOM" && !namesContrast(series))
    notes.push_back("The header names no contrast agent: the recipe \"" + recipe.name +
                    "\" is for series with one, look at what it found.");
  return notes;
}

}  // namespace volumen
