#include "ui/panels/segment_grow_page.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "results/text/text.h"
#include "ui/controller/lesion.h"
#include "ui/controller/segment_edits.h"
#include "ui/panels/sources.h"
#include "ui/panels/tool_button.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

QComboBox* explainedChoice(const QString& name, const QString& label, const QStringList& items) {
  return choiceField({name, label, label}, items, 6);
}

}  // namespace

SegmentGrowPage::SegmentGrowPage(SegmentEditing& editing, QWidget* parent)
    : QWidget(parent),
      editing_(editing),
      grow_(buttonOf<QPushButton>(QStringLiteral("segmentGrow"), tr("Grow from seeds"),
                                  [&editing] { editing.grow(); })),
      preview_(flagField({QStringLiteral("growPreview"), tr("Preview")})) {
  const Source<SegmentOptions> options = optionsSource(editing);
  const auto& thresholds = lesionThresholds();
  QStringList texts;
  for (const LesionThreshold& threshold : thresholds) texts << thresholdText(threshold);
  auto* lesion = explainedChoice(QStringLiteral("lesionThreshold"),
                                 tr("From which value on voxels in the sphere are the lesion"), texts);
  auto* region = explainedChoice(QStringLiteral("growRegion"),
                                 tr("Where is grown: about the seeds is a tenth of their box more on all "
                                    "sides, at least 3 voxels"),
                                 {tr("about them"), tr("everywhere")});
  options.bind(preview_, {}, at(&SegmentOptions::previewsGrowth));
  stack(this, {lineOf({new ToolButton(QStringLiteral("segmentLesion"), "lesion"),
                       {options.bind(lesion, {},
                                     among(at(&SegmentOptions::lesionThreshold),
                                           {thresholds.begin(), thresholds.end()})),
                        1}}),
               lineOf({new ToolButton(QStringLiteral("segmentTrace"), "levelTrace"),
                       new ToolButton(QStringLiteral("segmentSmartBrush"), "smartBrush"),
                       {}}),
               lineOf({grow_, {options.bind(region, {}, ordinal(at(&SegmentOptions::growthRegion))), 1}}),
               lineOf({preview_, {}}),
               {}});
  showSegments();
}

void SegmentGrowPage::showSegments() {
  const Result<SegmentWork> growth = growthOf(editing_.session(), editing_.options().growthRegion);
  const QString why = growth ? QString() : shownText(growth.message());
  grow_->setEnabled(why.isEmpty());
  preview_->setEnabled(why.isEmpty());
  grow_->setToolTip(toolTipOf(
      why.isEmpty()
          ? tr("Gives each voxel to the segment from which the path of the smallest changes of value "
               "leads to it. Hidden and locked segments stay as they are.")
          : why));
  preview_->setToolTip(
      toolTipOf(why.isEmpty() ? tr("Shows in slices what would be grown, anew after each change.") : why));
}

}  // namespace volumen
