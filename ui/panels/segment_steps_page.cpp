#include "ui/panels/segment_steps_page.h"

#include <QGridLayout>
#include <QSignalBlocker>
#include <string_view>

#include "ui/controller/segment_target.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

constexpr double mostMm = 100, mostMl = 10000;

QDoubleSpinBox* amountField(const char* name, const QString& label, const QString& unit, double first,
                            double most) {
  auto* field = new QDoubleSpinBox;
  field->setObjectName(QLatin1String(name));
  field->setAccessibleName(label);
  field->setToolTip(toolTipOf(label));
  field->setRange(0, most);
  field->setDecimals(2);
  field->setSuffix(unit);
  field->setValue(first);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setMinimumWidth(70);
  return field;
}

// What a step does to the segments of a map: on the job's thread, for the map as it is then.
Result<BitMask> stepped(const SegmentStep& step, int otherNumber, double amount, const SegmentMap& map,
                        int number, const CancelToken& cancel) {
  if (step.takesOther && !findSegment(map, otherNumber))
    return Error{"The other segment is not there any more."};
  const BitMask own = maskOf(*map.labels, std::uint8_t(number));
  const BitMask other =
      step.takesOther ? maskOf(*map.labels, std::uint8_t(otherNumber)) : BitMask(map.labels->geometry());
  return step.run({own, other, amount, cancel});
}

}  // namespace

SegmentStepsPage::SegmentStepsPage(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      mm_(amountField("segmentMm", tr("By how many mm: radius or margin"), tr(" mm"), 3, mostMm)),
      ml_(amountField("segmentMl", tr("Parts smaller than this"), tr(" ml"), 1, mostMl)),
      other_(new QComboBox) {
  other_->setObjectName(QStringLiteral("segmentOther"));
  other_->setAccessibleName(tr("Other segment"));
  other_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);  // names may be long
  other_->setMinimumContentsLength(6);
  for (const SegmentStep& step : segmentSteps()) {
    auto* button = new QToolButton;
    button->setText(step.text);
    button->setSizePolicy(QSizePolicy::MinimumExpanding, QSizePolicy::Fixed);
    button->setObjectName(QStringLiteral("segmentStep-") + QLatin1String(step.name));
    connect(button, &QToolButton::clicked, this, [this, &step] { run(step); });
    buttons_.push_back({&step, button});
  }
  makeLayout();
  connect(other_, &QComboBox::currentIndexChanged, this, &SegmentStepsPage::showSegments);
  showSegments();
}

// Three in a row; amounts beside the steps that take them.
void SegmentStepsPage::makeLayout() {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(4);
  int place = 0;
  const auto add = [&](QWidget* widget, int columns = 1) {
    grid->addWidget(widget, place / 3, place % 3, 1, columns);
    place += columns;
  };
  for (const StepButton& made : buttons_) {
    const std::string_view name(made.step->name);
    if (name == "unite") {
      add(plainLabel(tr("With")));
      add(other_, 2);
    }
    add(made.button);
    if (name == "removeIslands") {
      add(plainLabel(tr("below")));
      add(ml_);
    }
    if (name == "shrink") add(mm_);
  }
  grid->setRowStretch(place / 3, 1);
}

void SegmentStepsPage::showSegments() {
  showOthers();
  for (const StepButton& made : buttons_) {
    const QString why = whyNot(*made.step);
    made.button->setEnabled(why.isEmpty());
    made.button->setToolTip(toolTipOf(QStringList{made.step->says, why}));
  }
}

// The one that was chosen stays.
void SegmentStepsPage::showOthers() {
  const QSignalBlocker quiet(other_);
  const int chosen = other_->currentData().toInt();
  const SegmentMap* map = segmentsShown(session_);
  const Segment* current = segmentShown(session_);
  other_->clear();
  if (map)
    for (const Segment& segment : map->segments)
      if (&segment != current) other_->addItem(shownText(segment.label), segment.number);
  other_->setCurrentIndex(std::max(0, other_->findData(chosen)));
  other_->setEnabled(other_->count() > 0);
  other_->setToolTip(
      toolTipOf(other_->count() > 0 ? tr("The other segment") : tr("There is no other segment.")));
}

QString SegmentStepsPage::whyNot(const SegmentStep& step) const {
  const QString why = whyNotChanged(session_);
  if (!why.isEmpty() || !step.takesOther) return why;
  const SegmentMap* map = segmentsShown(session_);
  const Segment* other = findSegment(*map, other_->currentData().toInt());
  if (!other) return tr("There is no other segment.");
  if (other->locked && std::string_view(step.name) == "unite")
    return tr("%1 is locked: unlock it first.").arg(shownText(other->label));
  return {};
}

void SegmentStepsPage::run(const SegmentStep& step) {
  SegmentWork work;
  work.series = keyOf(session_.series()->series);
  work.volume = wholeVolume(session_);
  work.number = segmentShown(session_)->number;
  work.text = step.text;
  work.doing = step.doing;
  const double amount = step.amount == SegmentStep::Amount::ml ? ml_->value() : mm_->value();
  work.make = [&step, other = other_->currentData().toInt(), amount](const SegmentMap& map, int number,
                                                                     const CancelToken& cancel) {
    return stepped(step, other, amount, map, number, cancel);
  };
  Q_EMIT workWanted(work);
}

}  // namespace volumen
