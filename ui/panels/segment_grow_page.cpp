#include "ui/panels/segment_grow_page.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "results/text/text.h"
#include "ui/controller/lesion.h"
#include "ui/controller/segment_edits.h"
#include "ui/panels/part_fields.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

QComboBox* explainedChoice(const char* name, const QString& label, const QStringList& items) {
  QComboBox* box = narrowChoice(name, label);
  box->setToolTip(toolTipOf(label));
  box->addItems(items);
  return box;
}

// Returns the button of the lesion tool with its threshold.
QHBoxLayout* lesionRow(SegmentEditing& editing) {
  QStringList texts;
  for (const LesionThreshold& threshold : lesionThresholds()) texts << thresholdText(threshold);
  QComboBox* box =
      explainedChoice("lesionThreshold",
                      SegmentGrowPage::tr("From which value on voxels in the sphere are the lesion"), texts);
  QObject::connect(box, &QComboBox::currentIndexChanged, box, [&editing](int n) {
    editing.choose([n](SegmentOptions& o) { o.lesionThreshold = lesionThresholds()[std::size_t(n)]; });
  });
  auto* row = new QHBoxLayout;
  row->addWidget(toolButton("segmentLesion", "lesionTool"));
  row->addWidget(box, 1);
  return row;
}

}  // namespace

SegmentGrowPage::SegmentGrowPage(SegmentEditing& editing, QWidget* parent)
    : QWidget(parent),
      editing_(editing),
      region_(explainedChoice("growRegion",
                              tr("Where is grown: about the seeds is a tenth of their box more on all "
                                 "sides, at least 3 voxels"),
                              {tr("about them"), tr("everywhere")})),
      grow_(new QPushButton(tr("Grow from seeds"))),
      preview_(new QCheckBox(tr("Preview"))) {
  grow_->setObjectName(QStringLiteral("segmentGrow"));
  preview_->setObjectName(QStringLiteral("growPreview"));
  makeLayout();
  connect(grow_, &QPushButton::clicked, &editing_, &SegmentEditing::grow);
  bindOption(preview_, editing_, &SegmentOptions::previewsGrowth);
  bindOption(region_, editing_, &SegmentOptions::growthRegion);
  showSegments();
}

void SegmentGrowPage::makeLayout() {
  auto* lines = new QHBoxLayout;
  lines->addWidget(toolButton("segmentTrace", "levelTraceTool"));
  lines->addWidget(toolButton("segmentSmartBrush", "smartBrushTool"));
  lines->addStretch();
  auto* seeds = new QHBoxLayout;
  seeds->addWidget(grow_);
  seeds->addWidget(region_, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  for (QHBoxLayout* row : {lesionRow(editing_), lines, seeds}) column->addLayout(row);
  column->addWidget(preview_, 0, Qt::AlignLeft);
  column->addStretch();
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
