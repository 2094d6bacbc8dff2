#include "ui/controller/recipe_files.h"

#include "io/files/output_file.h"
#include "io/files/recipe_file.h"

namespace volumen {

namespace {

Result<Recipe> recipeFrom(const std::string& path) {
  const auto text = recipeText(path);
  if (!text) return text.error();
  Result<Recipe> recipe = readRecipe(*text);
  if (!recipe) return Error{path + ": " + recipe.message()};
  return recipe;
}

Status writeRecipe(const std::string& path, const Recipe& recipe) {
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  if (Status s = file->write(recipeJson(recipe)); !s) return s;
  return file->commit();
}

}  // namespace

RecipeFiles::RecipeFiles(Jobs& jobs, QObject* parent) : QObject(parent), open_(&jobs), save_(&jobs) {
  save_.keepToTheEnd();
}

RecipeFiles::~RecipeFiles() { save_.wait(); }

void RecipeFiles::open(const QString& path) {
  open_.run(
      tr("Reading the recipe"), [path](const Job&) { return recipeFrom(path.toStdString()); },
      [this](const Result<Recipe>& recipe) {
        if (recipe)
          Q_EMIT opened(*recipe);
        else
          Q_EMIT failed(QString::fromStdString(recipe.message()));
      });
}

void RecipeFiles::save(const QString& path, const Recipe& recipe) {
  save_.run(
      tr("Saving the recipe"), [path, recipe](const Job&) { return writeRecipe(path.toStdString(), recipe); },
      [this, path](const Status& status) {
        if (status)
          Q_EMIT saved(path);
        else
          Q_EMIT failed(QString::fromStdString(status.message()));
      });
}

}  // namespace volumen
