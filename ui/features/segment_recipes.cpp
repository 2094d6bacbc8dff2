#include <QPointer>

#include "results/segments/recipes.h"
#include "results/segments/segment_maps.h"
#include "results/text/text.h"
#include "ui/controller/file_jobs.h"
#include "ui/controller/segment_recipes.h"
#include "ui/controller/segment_target.h"
#include "ui/features/feature.h"
#include "ui/panels/steps_dialog.h"
#include "ui/widgets/path_dialog.h"

namespace volumen {

namespace {

// Runs segment recipes, also from files. Saves recorded steps as a recipe, edits them and runs them again.
// The actions are in the menu of the Segments panel.
class SegmentRecipes : public Feature {
 public:
  explicit SegmentRecipes(Workbench& bench);

 private:
  void askWhatToRun();
  void runFile(const QString& path);
  void askWhereToSave();
  void save(const RecordedRecipe& made, const QString& which, const QString& path);
  void showSteps();
  void run(const Recipe& recipe);
  void runAgain(const Recipe& recipe, int map, StepsDialog* dialog);
  const SegmentMap* recorded();

  FileJobs files_;
};

SegmentRecipes::SegmentRecipes(Workbench& bench) : Feature(bench), files_(bench.document.jobs) {
  const auto add = [&](const char* name, const QString& text, void (SegmentRecipes::*act)()) {
    bench_.addAction({name,
                      text,
                      {},
                      "",
                      false,
                      [this, act](bool) { (this->*act)(); },
                      {{"segmentsMenu", 20}, {"recipeMenu"}}});
  };
  add("openRecipe", tr("Open recipe..."), &SegmentRecipes::askWhatToRun);
  add("saveRecipe", tr("Save steps as a recipe..."), &SegmentRecipes::askWhereToSave);
  add("recipeSteps", tr("Steps..."), &SegmentRecipes::showSteps);
  connect(&files_, &FileJobs::failed, this, [this](const QString& sentence) { warnUntilDone(sentence); });
  connect(&bench_, &Workbench::recipeWanted, this, &SegmentRecipes::run);
}

// Adds the recipe's segments to the series that the panel shows.
void SegmentRecipes::run(const Recipe& recipe) {
  const QString why = whyNoSegments(session_);
  if (!why.isEmpty()) return warn(why);
  const Series& series = session_.series()->series;
  SegmentWork work = workOf(recipe, keyOf(series), wholeVolume(session_), session_.maskOf(keyOf(series)));
  QStringList notes;
  for (const std::string& note : notesOf(recipe, series)) notes << shownText(note);
  if (!notes.isEmpty()) work.done = [this, notes] { warnUntilDone(notes.join(QLatin1Char(' '))); };
  bench_.document.segments.change(work);
}

// Recorded steps state themselves what they omit. The panel may show another map by now.
void SegmentRecipes::runAgain(const Recipe& recipe, int map, StepsDialog* dialog) {
  const QString why = whyNoSegments(session_);
  if (!why.isEmpty()) return dialog->showRefused(why);
  const SeriesKey series = keyOf(session_.series()->series);
  SegmentWork work = workOf(recipe, series, wholeVolume(session_), {}, RecipeUse::again);
  if (segmentMapOf(session_.workspace(), series, map)) work.map = map;
  work.done = [shown = QPointer(dialog)] {
    if (shown) shown->showDone();
  };
  work.refused = [shown = QPointer(dialog)](const QString& sentence) {
    if (shown) shown->showRefused(sentence);
  };
  bench_.document.segments.change(work);
}

void SegmentRecipes::askWhatToRun() {
  if (const QString why = whyNoSegments(session_); !why.isEmpty()) return warn(why);
  const auto* dialog = openPathDialog(bench_.dialogParent(), {"openRecipeDialog",
                                                              tr("Open a recipe"),
                                                              tr("Recipes (*.json);;All files (*)"),
                                                              {},
                                                              QFileDialog::ExistingFile});
  connect(dialog, &QFileDialog::fileSelected, this, &SegmentRecipes::runFile);
}

void SegmentRecipes::runFile(const QString& path) {
  files_.open(
      tr("Reading the recipe"), [path] { return recipeFromFile(path.toStdString()); },
      [this](const Recipe& recipe) { run(recipe); });
}

// Returns the shown segments that have recorded steps, or null after reporting why there are none.
const SegmentMap* SegmentRecipes::recorded() {
  const QString why = whyNoSegments(session_);
  const SegmentMap* map = segmentsShown(session_);
  if (!why.isEmpty() || !map)
    warn(map || !why.isEmpty() ? why : tr("There is no segment yet."));
  else if (recordedRecipe(*map, {}).recipe.segments.empty())
    warn(tr("No segment here was made by steps alone: what was painted, cut or opened is in no recipe."));
  else
    return map;
  return nullptr;
}

// Saves the steps as they are now, whatever happens while the file dialog is open.
void SegmentRecipes::askWhereToSave() {
  const SegmentMap* map = recorded();
  if (!map) return;
  const RecordedRecipe made = recordedRecipe(*map, session_.series()->series.modality);
  const QString which = allSegmentsShown(session_).size() > 1
                            ? tr(" (the steps of %1 alone)").arg(mapName(map->number))
                            : QString();
  const auto* dialog =
      openPathDialog(bench_.dialogParent(), {"saveRecipeDialog", tr("Save the steps as a recipe"),
                                             tr("Recipes (*.json)"), QStringLiteral("recipe.json")});
  connect(dialog, &QFileDialog::fileSelected, this,
          [this, made, which](const QString& path) { save(made, which, path); });
}

void SegmentRecipes::save(const RecordedRecipe& made, const QString& which, const QString& path) {
  QStringList names;
  for (const std::string& name : made.missing) names << shownText(name);
  const QString saved =
      names.isEmpty()
          ? tr("Saved %1").arg(path)
          : tr("Saved %1. Made by hand and not in it: %2.").arg(path, names.join(QStringLiteral(", ")));
  files_.save(
      tr("Saving the recipe"),
      [path, recipe = made.recipe] { return writeRecipe(path.toStdString(), recipe); },
      [this, saved, which] { tell(saved + which); });
}

void SegmentRecipes::showSteps() {
  if (!recorded()) return;
  auto* dialog = new StepsDialog(session_, bench_.dialogParent());
  connect(dialog, &StepsDialog::runWanted, this,
          [this, dialog](const Recipe& recipe, int map) { runAgain(recipe, map, dialog); });
  dialog->show();
}

}  // namespace

std::unique_ptr<Feature> makeSegmentRecipes(Workbench& bench) {
  return std::make_unique<SegmentRecipes>(bench);
}

}  // namespace volumen
