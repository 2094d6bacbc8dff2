#include "ui/panels/steps_dialog.h"

#include <QFontDatabase>
#include <QHBoxLayout>
#include <QVBoxLayout>

#include "results/segments/segment_maps.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

StepsDialog::StepsDialog(Session& session, QWidget* parent)
    : QDialog(parent),
      session_(session),
      text_(new QPlainTextEdit),
      note_(plainLabel()),
      run_(new QPushButton(tr("Run again"))),
      reset_(new QPushButton(tr("Discard changes"))) {
  setObjectName(QStringLiteral("stepsDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(560, 600);
  text_->setObjectName(QStringLiteral("stepsText"));
  text_->setAccessibleName(tr("Steps"));
  text_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  note_->setObjectName(QStringLiteral("stepsNote"));
  note_->setWordWrap(true);
  run_->setObjectName(QStringLiteral("stepsRun"));
  reset_->setObjectName(QStringLiteral("stepsReset"));
  auto* buttons = new QHBoxLayout;
  buttons->addStretch();
  buttons->addWidget(reset_);
  buttons->addWidget(run_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(text_, 1);
  column->addWidget(note_);
  column->addLayout(buttons);
  connect(run_, &QPushButton::clicked, this, &StepsDialog::run);
  connect(reset_, &QPushButton::clicked, this, &StepsDialog::showSteps);
  connect(text_, &QPlainTextEdit::textChanged, this, &StepsDialog::showProblem);
  const auto follow = [this] {
    if (!text_->document()->isModified()) showSteps();
  };
  connect(&session_, &Session::workspaceChanged, this,
          [follow](const Workspace& before, const Workspace& after) {
            if (before.segmentMaps != after.segmentMaps) follow();
          });
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
