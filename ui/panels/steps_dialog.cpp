#include "ui/panels/steps_dialog.h"

#include <QFontDatabase>

#include "results/segments/segment_maps.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

StepsDialog::StepsDialog(Session& session, QWidget* parent)
    : QDialog(parent),
      session_(session),
      text_(new QPlainTextEdit),
      note_(wrappedLabel(QStringLiteral("stepsNote"))),
      run_(buttonOf<QPushButton>(QStringLiteral("stepsRun"), tr("Run again"), [this] { run(); })) {
  setObjectName(QStringLiteral("stepsDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(560, 600);
  text_->setObjectName(QStringLiteral("stepsText"));
  text_->setAccessibleName(tr("Steps"));
  text_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  auto* reset =
      buttonOf<QPushButton>(QStringLiteral("stepsReset"), tr("Discard changes"), [this] { showSteps(); });
  stack(this, {{text_, 1}, note_, lineOf({{}, reset, run_}, -1)}, 8, -1);
  connect(text_, &QPlainTextEdit::textChanged, this, &StepsDialog::showProblem);
  const auto follow = [this] {
    if (!text_->document()->isModified()) showSteps();
  };
  whenChanged(session_, this, follow, &Workspace::segmentMaps);
  connect(&session_, &Session::changed, this,
          [follow](const SessionState& before, const SessionState& after) {
            if (before.series != after.series) follow();
          });
  showSteps();
}

void StepsDialog::showSteps() {
  const SegmentMap* map = segmentsShown(session_);
  if (map) map_ = map->number;
  const bool isOneOfSeveral = allSegmentsShown(session_).size() > 1;
  setWindowTitle(isOneOfSeveral ? tr("Steps of the segments of %1").arg(mapName(map->number))
                                : tr("Steps of the segments"));
  const RecordedRecipe recorded =
      map ? recordedRecipe(*map, session_.series()->series.modality) : RecordedRecipe{};
  text_->setPlainText(recorded.recipe.segments.empty() ? QString()
                                                       : QString::fromStdString(recipeJson(recorded.recipe)));
  text_->document()->setModified(false);
  QStringList missing;
  for (const std::string& name : recorded.missing) missing << shownText(name);
  text_->setPlaceholderText(tr("No segment here was made by steps alone."));
  showProblem();
  if (!missing.isEmpty())
    note_->setText(tr("Made by hand, not by these: %1.").arg(missing.join(QStringLiteral(", "))));
}

void StepsDialog::showProblem() {
  const std::string text = text_->toPlainText().toStdString();
  const bool isThere = !text.empty() && segmentsShown(session_);
  const auto recipe = readRecipe(text);
  note_->setText(text.empty() || recipe ? QString() : shownText(recipe.message()));
  run_->setEnabled(isThere && recipe);
}

void StepsDialog::run() {
  const auto recipe = readRecipe(text_->toPlainText().toStdString());
  if (!recipe) return;
  ran_ = text_->toPlainText();
  Q_EMIT runWanted(*recipe, map_);
}

// Keeps text typed in the meantime.
void StepsDialog::showDone() {
  if (text_->toPlainText() == ran_) showSteps();
}

void StepsDialog::showRefused(const QString& why) {
  if (text_->toPlainText() == ran_) note_->setText(why);
}

}  // namespace volumen
