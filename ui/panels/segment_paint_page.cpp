#include "ui/panels/segment_paint_page.h"

#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/panels/part_fields.h"
#include "ui/widgets/plain_text.h"
#include "viewer/segment/between_slices.h"

namespace volumen {

namespace {

constexpr double mostCutMm = 1000;

Result<StepsWanted> stepsBetween(const SegmentMap& map, int number, const CancelToken&) {
  const std::optional<int> axis = axisOfPaintedSlices(maskOf(*map.labels, std::uint8_t(number)));
  if (!axis) return Error{"The current segment has no empty slices between painted ones."};
  const std::string across(1, "ijk"[*axis]);
  return StepsWanted{{{"betweenSlices", stepNameOf(number), {{"across", across}}}}, {number}};
}

}  // namespace

SegmentPaintPage::SegmentPaintPage(SegmentEditing& editing, QWidget* parent)
    : QWidget(parent),
      editing_(editing),
      session_(editing.session()),
      erases_(new QCheckBox(tr("Erase"))),
      shape_(narrowChoice("brushShape", tr("Brush"))),
      mm_(new QDoubleSpinBox),
      inRange_(new QCheckBox(tr("Only values from the curve"))),
      beside_(narrowChoice("paintBeside", tr("Where to paint"))),
      other_(narrowChoice("paintOther", tr("Other segment"))),
      cutMm_(new QDoubleSpinBox),
      fill_(new QToolButton) {
  erases_->setObjectName(QStringLiteral("paintErases"));
  erases_->setToolTip(toolTipOf(tr("What is painted is erased; with Ctrl held too.")));
  shape_->addItems({tr("Disc"), tr("Ball")});
  shape_->setToolTip(toolTipOf(tr("A disc in the slice, or a ball through several.")));
  mm_->setObjectName(QStringLiteral("brushMm"));
  mm_->setAccessibleName(tr("Diameter of the brush"));
  mm_->setToolTip(toolTipOf(tr("Diameter in the patient; + and - in a slice change it by 20 %.")));
  mm_->setRange(Brush::leastMm, Brush::mostMm);
  mm_->setDecimals(1);
  mm_->setSuffix(tr(" mm"));
  mm_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  mm_->setMinimumWidth(70);
  inRange_->setObjectName(QStringLiteral("paintInRange"));
  inRange_->setToolTip(toolTipOf(tr("Only voxels of the range on the page From the curve.")));
  beside_->addItems({tr("Anywhere"), tr("Inside"), tr("Outside")});
  beside_->setToolTip(
      toolTipOf(tr("Where to paint: inside another segment, whose voxels are taken, or outside.")));
  fill_->setObjectName(QStringLiteral("segmentFillBetween"));
  fill_->setText(tr("Fill between slices"));
  makeLayout();
  connectFields();
  showBrush();
  showSegments();
}

void SegmentPaintPage::makeLayout() {
  auto* tools = new QHBoxLayout;
  tools->addWidget(toolButton("segmentBrush", "paintTool"));
  tools->addWidget(toolButton("segmentOutline", "outlineTool"));
  tools->addWidget(erases_);
  tools->addStretch();
  auto* size = new QHBoxLayout;
  size->addWidget(shape_, 1);
  size->addWidget(mm_, 1);
  auto* where = new QHBoxLayout;
  where->addWidget(beside_, 1);
  where->addWidget(other_, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addLayout(tools);
  column->addLayout(size);
  column->addWidget(inRange_, 0, Qt::AlignLeft);
  column->addLayout(where);
  column->addLayout(lastRow());
  column->addStretch();
}

QHBoxLayout* SegmentPaintPage::lastRow() {
  cutMm_->setObjectName(QStringLiteral("cutMm"));
  cutMm_->setAccessibleName(tr("Depth of a cut in a slice"));
  cutMm_->setToolTip(
      toolTipOf(tr("How far on either side of the slice is cut; 0: all slices. In 3D all is cut.")));
  cutMm_->setRange(0, mostCutMm);
  cutMm_->setDecimals(1);
  cutMm_->setPrefix(QStringLiteral("\u00b1"));
  cutMm_->setSuffix(tr(" mm"));
  cutMm_->setSpecialValueText(tr("All slices"));
  cutMm_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  cutMm_->setMinimumWidth(70);
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  row->addWidget(toolButton("segmentCut", "segmentScissorsTool"));
  row->addWidget(cutMm_, 1);
  row->addWidget(fill_);
  return row;
}

void SegmentPaintPage::connectFields() {
  connect(shape_, &QComboBox::activated, this, [this](int n) {
    session_.prefer([n](Preferences& preferences) { preferences.brush.ball = n == 1; });
  });
  connect(mm_, &QDoubleSpinBox::valueChanged, this, [this](double mm) {
    session_.prefer([mm](Preferences& preferences) { preferences.brush.diameterMm = mm; });
  });
  connect(&session_, &Session::preferencesChanged, this,
          [this](const Preferences& before, const Preferences& after) {
            if (before.brush != after.brush) showBrush();
          });
  bindOption(erases_, editing_, &SegmentOptions::erases);
  bindOption(inRange_, editing_, &SegmentOptions::paintsInRange);
  bindOption(beside_, editing_, &SegmentOptions::beside);
  bindOption(cutMm_, editing_, &SegmentOptions::cutWithinMm);
  connect(other_, &QComboBox::currentIndexChanged, this, [this] {
    editing_.choose([this](SegmentOptions& o) { o.other = other_->currentData().toInt(); });
  });
  connect(&editing_, &SegmentEditing::optionsChanged, this, &SegmentPaintPage::showOther);
  connect(fill_, &QToolButton::clicked, this, &SegmentPaintPage::fillBetween);
}

// Shows a rounded diameter, while painting uses the exact one.
void SegmentPaintPage::showBrush() {
  const QSignalBlocker quiet(mm_);
  const Brush& brush = session_.preferences().brush;
  shape_->setCurrentIndex(brush.ball ? 1 : 0);
  mm_->setValue(brush.diameterMm);
}

void SegmentPaintPage::showOther() {
  const QSignalBlocker quiet(other_);
  const SegmentOptions& options = editing_.options();
  const Segment* other = otherSegmentShown(session_, options.other);
  other_->setCurrentIndex(other ? other_->findData(other->number) : -1);
  other_->setEnabled(other && options.beside != PaintBeside::anywhere);
}

void SegmentPaintPage::showSegments() {
  showOthers();
  const QString why = whyNotChanged(session_);
  fill_->setEnabled(why.isEmpty());
  fill_->setToolTip(
      toolTipOf(QStringList{tr("Fills the slices between painted ones, by signed distances."), why}));
}

void SegmentPaintPage::showOthers() {
  const QSignalBlocker quiet(other_);
  const SegmentMap* map = segmentsShown(session_);
  const Segment* current = segmentShown(session_);
  other_->clear();
  if (map)
    for (const Segment& segment : map->segments)
      if (&segment != current) other_->addItem(shownText(segment.label), segment.number);
  other_->setToolTip(toolTipOf(other_->count() > 0 ? tr("The segment to paint inside or outside")
                                                   : noOtherSegment(session_)));
  showOther();
}

void SegmentPaintPage::fillBetween() {
  SegmentWork work = workShown(session_, tr("Fill between slices"), tr("Filling between slices"));
  work.number = segmentShown(session_)->number;
  work.steps = stepsBetween;
  editing_.change(work);
}

}  // namespace volumen
