#include "ui/panels/segment_grow_page.h"

#include <QAction>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <utility>

#include "ui/controller/segment_growing.h"
#include "ui/controller/segment_target.h"
#include "ui/overlays/view_overlays.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/text.h"
#include "ui/workspace/value_text.h"

namespace volumen {

namespace {

// Thresholds in the order of the list: shares of the maximum, then SUVbw.
constexpr std::array<LesionThreshold, 4> lesionThresholds{
    {{0.41, true}, {0.5, true}, {2.5, false}, {4.0, false}}};

QString thresholdText(const LesionThreshold& threshold) {
  return threshold.isShare ? SegmentGrowPage::tr("%1 % of the maximum").arg(100 * threshold.amount)
                           : SegmentGrowPage::tr("SUV %1").arg(threshold.amount, 0, 'f', 1);
}

// Keeps boxes as narrow as possible, so that the panel stays narrow.
QComboBox* narrowBox(const char* name, const QString& label, const QStringList& items) {
  auto* box = new QComboBox;
  box->setObjectName(QLatin1String(name));
  box->setAccessibleName(label);
  box->setToolTip(toolTipOf(label));
  box->addItems(items);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(6);
  return box;
}

QStringList thresholdTexts() {
  QStringList texts;
  for (const LesionThreshold& threshold : lesionThresholds) texts << thresholdText(threshold);
  return texts;
}

}  // namespace

SegmentGrowPage::SegmentGrowPage(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      lesion_(new QToolButton),
      trace_(new QToolButton),
      smart_(new QToolButton),
      threshold_(narrowBox("lesionThreshold", tr("From which value on voxels in the sphere are the lesion"),
                           thresholdTexts())),
      region_(narrowBox("growRegion",
                        tr("Where is grown: about the seeds is a tenth of their box more on all "
                           "sides, at least 3 voxels"),
                        {tr("about them"), tr("everywhere")})),
      grow_(new QPushButton(tr("Grow from seeds"))),
      preview_(new QCheckBox(tr("Preview"))) {
  lesion_->setObjectName(QStringLiteral("segmentLesion"));
  trace_->setObjectName(QStringLiteral("segmentTrace"));
  smart_->setObjectName(QStringLiteral("segmentSmartBrush"));
  grow_->setObjectName(QStringLiteral("segmentGrow"));
  preview_->setObjectName(QStringLiteral("growPreview"));
  makeLayout();
  connect(grow_, &QPushButton::clicked, this, &SegmentGrowPage::grow);
  connect(preview_, &QCheckBox::toggled, this, &SegmentGrowPage::showGrowth);
  connect(region_, &QComboBox::currentIndexChanged, this, [this] {
    if (preview_->isChecked()) showGrowth();
  });
  showSegments();
}

void SegmentGrowPage::makeLayout() {
  auto* ball = new QHBoxLayout;
  ball->addWidget(lesion_);
  ball->addWidget(threshold_, 1);
  auto* lines = new QHBoxLayout;
  lines->addWidget(trace_);
  lines->addWidget(smart_);
  lines->addStretch();
  auto* seeds = new QHBoxLayout;
  seeds->addWidget(grow_);
  seeds->addWidget(region_, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  for (QHBoxLayout* row : {ball, lines, seeds}) column->addLayout(row);
  column->addWidget(preview_, 0, Qt::AlignLeft);
  column->addStretch();
}

void SegmentGrowPage::setToolActions(QAction* lesion, QAction* trace, QAction* smart) {
  for (const auto& [button, action] :
       {std::pair(lesion_, lesion), std::pair(trace_, trace), std::pair(smart_, smart)}) {
    button->setToolButtonStyle(Qt::ToolButtonTextOnly);
    button->setDefaultAction(action);
  }
}

QString SegmentGrowPage::whyNotGrown() const {
  const QString why = whyNoSegments(session_);
  if (!why.isEmpty()) return why;
  const SegmentMap* map = segmentsShown(session_);
  if (!map || std::ranges::count_if(map->segments, isSeed) < 2)
    return tr(
        "Paint into two or more segments first, what lies around included: those that are shown and not "
        "locked are the seeds.");
  return {};
}

void SegmentGrowPage::showSegments() {
  const QString why = whyNotGrown();
  grow_->setEnabled(why.isEmpty());
  preview_->setEnabled(why.isEmpty());
  grow_->setToolTip(toolTipOf(
      why.isEmpty()
          ? tr("Gives each voxel to the segment from which the path of the smallest changes of value "
               "leads to it. Hidden and locked segments stay as they are.")
          : why));
  preview_->setToolTip(
      toolTipOf(why.isEmpty() ? tr("Shows in slices what would be grown, anew after each change.") : why));
  const SegmentMap* map = segmentsShown(session_);
  const bool isOther = !map || (seeds_ && seeds_->series != map->series);
  if (!why.isEmpty() || isOther) {
    const QSignalBlocker quiet(preview_);
    preview_->setChecked(false);
  }
  const bool isChanged =
      seeds_ && (!map || map->labels != seeds_->labels || map->segments != seeds_->segments);
  if (std::exchange(isHeld_, false) || isChanged) showGrowth();
}

// Previews the growth if the user wants to see it.
void SegmentGrowPage::showGrowth() {
  seeds_.reset();
  const SegmentMap* map = segmentsShown(session_);
  if (!map || !preview_->isChecked()) return Q_EMIT previewEnded();
  seeds_ = *map;
  Q_EMIT previewWanted(growthWork());
}

void SegmentGrowPage::previewFailed(const QString& sentence) {
  if (!seeds_) return;  // an error of a sphere is reported once it has been drawn
  seeds_.reset();
  const QSignalBlocker quiet(preview_);
  preview_->setChecked(false);
  if (!sentence.isEmpty()) Q_EMIT refused(sentence);
}

SegmentWork SegmentGrowPage::growthWork() const {
  const SeriesKey series = keyOf(session_.series()->series);
  return growthOf(series, wholeVolume(session_), session_.maskOf(series),
                  GrowthRegion(region_->currentIndex()));
}

// Keeps the preview until growth becomes a step or fails.
void SegmentGrowPage::grow() {
  isHeld_ = true;
  seeds_.reset();
  const QSignalBlocker quiet(preview_);
  preview_->setChecked(false);
  Q_EMIT growthWanted(growthWork());
}

// Another series in this frame of reference, such as the CT under a PET, shows the same places.
bool SegmentGrowPage::isInFrameOf(const SeriesKey& shown, const Series& series) const {
  const auto found = session_.workspace().series.find(shown);
  return found != session_.workspace().series.end() &&
         frameOfReference(*found->second.series) == frameOfReference(series);
}

QString SegmentGrowPage::whyNoLesion(const DrawnBall& ball) const {
  if (ball.onFrame) return tr("A lesion cannot be found on frames: show the series as slices.");
  const QString why = whyNoSegments(session_);
  if (!why.isEmpty()) return why;
  const Series& series = session_.series()->series;
  if (!isInFrameOf(ball.series, series))
    return tr("The panel Segments is about another series: draw in a view of that one.");
  if (!session_.series()->volume->geometry().calibrated)
    return tr("The file does not say how large its voxels are: a sphere of so many mm cannot be drawn.");
  if (lesionThresholds[std::size_t(threshold_->currentIndex())].isShare) return {};
  const ValueScale scale = valueScale(series, PetUnit::suvBodyWeight);
  if (scale.unit.starts_with("SUV")) return {};
  return scale.why.empty()
             ? tr("The series has no SUV: choose a share of the maximum.")
             : tr("The series has %1. Choose a share of the maximum.").arg(shownText(scale.why));
}

SegmentWork SegmentGrowPage::lesionWork(const DrawnBall& ball) const {
  const Series& series = session_.series()->series;
  LesionWanted wanted{wholeVolume(session_), session_.maskOf(keyOf(series)), ball.pPatient, ball.radiusMm,
                      lesionThresholds[std::size_t(threshold_->currentIndex())]};
  wanted.said = tr("From %1 on, within %2 mm of %3")
                    .arg(thresholdText(wanted.threshold))
                    .arg(ball.radiusMm, 0, 'f', 1)
                    .arg(placeText(series, ball.pPatient));
  wanted.beside = copiesOf(allSegmentsShown(session_));
  if (!wanted.threshold.isShare) wanted.threshold.amount /= valueScale(series, PetUnit::suvBodyWeight).factor;
  return lesionOf(keyOf(series), wanted);
}

void SegmentGrowPage::takeBall(const DrawnBall& ball) {
  const QString why = whyNoLesion(ball);
  const bool isDone = ball.state == DrawnBall::State::done;
  if (ball.state == DrawnBall::State::givenUp || !why.isEmpty()) {
    if (isDone) Q_EMIT refused(why);
    return showGrowth();
  }
  seeds_.reset();
  if (!isDone) return Q_EMIT previewWanted(lesionWork(ball));
  isHeld_ = true;
  Q_EMIT workWanted(lesionWork(ball));
}

}  // namespace volumen
