#include "ui/panels/segments_panel.h"

#include <QAction>
#include <QButtonGroup>
#include <QLocale>

#include "results/segments/recipes.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/controller/segment_target.h"
#include "ui/panels/tool_button.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/series_segments.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

SegmentsPanel::SegmentsPanel(SegmentEditing& editing, const SegmentNumbers& numbers, QWidget* parent)
    : QWidget(parent),
      session_(editing.session()),
      numbers_(numbers),
      list_(new SegmentList(editing, numbers)),
      result_(wrappedLabel(QStringLiteral("segmentResult"))),
      in3d_(flagField({QStringLiteral("segmentsIn3d"), tr("In 3D")})),
      tissue_(new SegmentTissue(session_)),
      export_(buttonOf<QPushButton>(QStringLiteral("segmentSave"), tr("Export..."))),
      numbersButton_(buttonOf(QStringLiteral("segmentNumbersButton"), tr("Numbers..."),
                              [this] { Q_EMIT numbersWanted(); })),
      recipes_(buttonOf(QStringLiteral("segmentRecipes"), tr("Recipe"))),
      range_(new SegmentRange(editing)),
      paint_(new SegmentPaintPage(editing)),
      steps_(new SegmentStepsPage(editing)),
      growth_(new SegmentGrowPage(editing)),
      pages_(new QStackedWidget) {
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  recipes_->setPopupMode(QToolButton::InstantPopup);
  recipes_->setMenu(new QMenu(recipes_));
  recipeMenu()->setObjectName(QStringLiteral("recipeMenu"));
  recipeMenu()->setToolTipsVisible(true);
  makeLayout();
  connect(range_, &SegmentRange::making, this, [this] { result_->setText(tr("Segmenting...")); });
  connect(range_, &SegmentRange::rangeShown, this, &SegmentsPanel::rangeShown);
  connect(in3d_, &QCheckBox::clicked, this, [this](bool on) {
    session_.endGesture();
    session_.change(on ? tr("Segments in 3D") : tr("Segments in slices alone"),
                    withSegmentsIn3d(session_.workspace(), keyOf(session_.series()->series), on));
  });
  connect(&editing.jobs(), &SegmentJobs::ended, this, &SegmentsPanel::showSegments);
  connect(range_, &SegmentRange::previewChanged, this, &SegmentsPanel::previewChanged);
  connect(&numbers_, &SegmentNumbers::changed, this, [this] {
    list_->showSegments();
    showResult();
  });
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series == after.series) return;
    fillRecipes();
    showSegments();
  });
  whenChanged(session_, this, &SegmentsPanel::showSegments, &Workspace::segmentMaps);
  whenChanged(session_, this, &SegmentsPanel::showResult, &Preferences::petUnit);
  fillRecipes();
  showSegments();
}

QToolButton* SegmentsPanel::pageButton(const char* name, const QString& text, QWidget* page) {
  auto* button = buttonOf(QLatin1String(name), text, [this, page] { showPage(page); });
  button->setCheckable(true);
  button->setAutoRaise(true);  // as in a tool bar, only the chosen one has a frame
  page->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Ignored);
  pages_->addWidget(page);
  return button;
}

// Only the shown page determines the panel's height. All pages determine its width, so that nothing moves
// sideways.
void SegmentsPanel::showPage(QWidget* page) {
  pages_->currentWidget()->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Ignored);
  page->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  pages_->setCurrentWidget(page);
}

void SegmentsPanel::makeLayout() {
  auto* group = new QButtonGroup(this);
  std::vector<LayoutPart> row;
  for (QToolButton* button :
       {pageButton("segmentFromCurve", tr("From the curve"), range_),
        pageButton("segmentPaint", tr("Paint"), paint_), pageButton("segmentGrowing", tr("Grow"), growth_),
        pageButton("segmentChange", tr("Change"), steps_)}) {
    group->addButton(button);
    row.push_back(button);
  }
  group->buttons().front()->setChecked(true);
  showPage(range_);
  row.push_back({});
  stack(this,
        {{list_, 1},
         result_,
         lineOf({in3d_, recipes_, numbersButton_, export_, {}}),
         lineOf(row),
         pages_,
         {},
         tissue_},
        4, 2);
}

// Lists one-click recipes for the series in view.
void SegmentsPanel::fillRecipes() {
  const std::string modality = session_.series() ? session_.series()->series.modality : std::string();
  const std::vector<const Recipe*> offered = recipesFor(modality);
  QList<QAction*> entries;
  for (const Recipe* recipe : offered) {
    auto* const action = new QAction(shownText(recipe->name), recipeMenu());
    connect(action, &QAction::triggered, this, [this, recipe] { Q_EMIT recipeChosen(*recipe); });
    action->setObjectName(QStringLiteral("recipe") + shownText(recipe->name));
    action->setToolTip(toolTipOf(shownText(recipe->description)));
    entries << action;
  }
  builtIn_.show(*recipeMenu(), entries);
  recipes_->setToolTip(
      toolTipOf(QStringList{tr("Segments by a list of steps, by one click."),
                            offered.empty() ? tr("Built-in ones are for CT and MR.") : QString()}));
}

void SegmentsPanel::setToolActions(const std::map<const Tool*, QAction*>& actions) {
  for (auto* button : findChildren<ToolButton*>()) button->setDefaultAction(actions.at(&button->tool));
}

void SegmentsPanel::setExportAction(QAction* action) {
  const auto show = [this, action] {
    export_->setEnabled(action->isEnabled());
    export_->setToolTip(action->toolTip());
  };
  connect(action, &QAction::changed, export_, show);
  connect(export_, &QPushButton::clicked, action, &QAction::trigger);
  show();
}

void SegmentsPanel::showSegments() {
  setEnabled(session_.series() != nullptr);
  list_->showSegments();
  range_->showSegments();
  paint_->showSegments();
  steps_->showSegments();
  showIn3d();
  tissue_->showSegments();
  growth_->showSegments();
  numbersButton_->setEnabled(segmentsShown(session_) != nullptr);
  numbersButton_->setToolTip(toolTipOf(
      numbersButton_->isEnabled()
          ? tr("A table of all segments of the series: volumes, area, values, axes; two are compared.")
          : tr("There is no segment yet.")));
  showResult();
}

void SegmentsPanel::showIn3d() {
  const SegmentMap* map = segmentsShown(session_);
  in3d_->setEnabled(map != nullptr);
  in3d_->setChecked(!map || map->in3d);
  in3d_->setToolTip(toolTipOf(map ? tr("Segments that are shown are surfaces in 3D, too; else they are in "
                                       "slices alone. Projections and OpenGL show none.")
                                  : tr("There is no segment yet.")));
}

void SegmentsPanel::showResult() {
  const bool isThere = segmentShown(session_) != nullptr;
  const SegmentNumbersKey key = isThere ? currentValuesKey(session_) : SegmentNumbersKey{};
  const auto *counted = numbers_.find({key.labels}), *measured = numbers_.find(key);
  if (!isThere || !counted || !counted->value || !measured || !measured->value)
    return result_->setText(session_.series() ? whyNoSegments(session_) : QString());
  const SegmentValues& s = measured->value->values;
  const std::int64_t voxels = counted->value->voxels[std::size_t(key.number)];
  const VoxelGeometry& grid = key.labels->geometry();
  const ValueScale scale = shownScale(session_.series()->series);
  const QString unit = shownText(scale.unit);
  const int decimals = valueDecimals(*session_.series()) - 1;
  const auto value = [&](double v) {
    return QStringLiteral("%1 %2").arg(v * scale.factor, 0, 'f', decimals).arg(unit).trimmed();
  };
  QStringList parts;
  const double ml = double(voxels) * grid.voxelVolume() / 1000;
  if (grid.calibrated) parts << tr("%1 ml").arg(ml, 0, 'f', ml < 100 ? 2 : 0);
  if (s.voxels > 0) parts << tr("mean %1").arg(value(s.mean));
  const QString text =
      parts.join(QStringLiteral(", ")) + tr(" (%1 voxels)").arg(QLocale().toString(qlonglong(voxels)));
  result_->setText(grid.calibrated ? text.trimmed()
                                   : tr("Not calibrated, no volume in ml: %1").arg(text.trimmed()));
  result_->setToolTip(
      toolTipOf(s.voxels > 0 ? tr("Values from %1 to %2").arg(value(s.min), value(s.max)) : QString()));
}

}  // namespace volumen
