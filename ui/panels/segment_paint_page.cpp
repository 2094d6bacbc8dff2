#include "ui/panels/segment_paint_page.h"

#include <QSignalBlocker>

#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/panels/sources.h"
#include "ui/panels/tool_button.h"
#include "ui/widgets/plain_text.h"
#include "viewer/segment/between_slices.h"

namespace volumen {

namespace {

constexpr double mostCutMm = 1000;
constexpr int leastLetters = 6;  // of lists

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
      other_(choiceField({QStringLiteral("paintOther"), tr("Other segment")}, {}, leastLetters)),
      fill_(buttonOf(QStringLiteral("segmentFillBetween"), tr("Fill between slices"),
                     [this] { fillBetween(); })) {
  const Source<SegmentOptions> options = optionsSource(editing);
  const Source<Preferences> preferences = preferencesSource(session_);
  const auto flag = [&](const FieldText& text, bool SegmentOptions::*option) {
    return options.bind(flagField(text), {}, at(option));
  };
  const auto choice = [](const FieldText& text, const QStringList& items) {
    return choiceField(text, items, leastLetters);
  };
  auto* shape = choice(
      {QStringLiteral("brushShape"), tr("Brush"), tr("A disc in the slice, or a ball through several.")},
      {tr("Disc"), tr("Ball")});
  // Shows a rounded diameter, while painting uses the exact one.
  auto* mm = numberField(
      {QStringLiteral("brushMm"), tr("Diameter of the brush"),
       tr("Diameter in the patient; + and - in a slice change it by 20 %.")},
      {.low = Brush::leastMm, .high = Brush::mostMm, .decimals = 1, .suffix = tr(" mm"), .isLive = true});
  auto* beside = choice({QStringLiteral("paintBeside"), tr("Where to paint"),
                         tr("Where to paint: inside another segment, whose voxels are taken, or outside.")},
                        {tr("Anywhere"), tr("Inside"), tr("Outside")});
  auto* cutMm =
      numberField({QStringLiteral("cutMm"), tr("Depth of a cut in a slice"),
                   tr("How far on either side of the slice is cut; 0: all slices. In 3D all is cut.")},
                  {.low = 0,
                   .high = mostCutMm,
                   .decimals = 1,
                   .suffix = tr(" mm"),
                   .prefix = QStringLiteral("\u00b1"),
                   .atLow = tr("All slices"),
                   .isLive = true});
  stack(
      this,
      {lineOf({new ToolButton(QStringLiteral("segmentBrush"), "paint"),
               new ToolButton(QStringLiteral("segmentOutline"), "outline"),
               flag({QStringLiteral("paintErases"), tr("Erase"),
                     tr("What is painted is erased; with Ctrl held too.")},
                    &SegmentOptions::erases),
               {}}),
       lineOf({{preferences.bind(shape, {}, among(at(&Preferences::brush, &Brush::ball), {false, true})), 1},
               {preferences.bind(mm, {}, at(&Preferences::brush, &Brush::diameterMm)), 1}}),
       lineOf({flag({QStringLiteral("paintInRange"), tr("Only values from the curve"),
                     tr("Only voxels of the range on the page From the curve.")},
                    &SegmentOptions::paintsInRange),
               {}}),
       lineOf({{options.bind(beside, {}, ordinal(at(&SegmentOptions::beside))), 1}, {other_, 1}}),
       lineOf({new ToolButton(QStringLiteral("segmentCut"), "segmentScissors"),
               {options.bind(cutMm, {}, at(&SegmentOptions::cutWithinMm)), 1},
               fill_}),
       {}});
  connect(other_, &QComboBox::currentIndexChanged, this, [this] {
    editing_.choose([this](SegmentOptions& o) { o.other = other_->currentData().toInt(); });
  });
  connect(&editing_, &SegmentEditing::optionsChanged, this, &SegmentPaintPage::showOther);
  showSegments();
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
