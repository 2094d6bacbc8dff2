#include "ui/panels/segment_range.h"

#include <QAction>
#include <QLocale>
#include <QSignalBlocker>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <utility>

#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/controller/segment_parts.h"
#include "ui/controller/segment_target.h"
#include "ui/panels/sources.h"
#include "ui/panels/tool_button.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/curve_spans.h"
#include "ui/workspace/series_segments.h"
#include "ui/workspace/when_changed.h"
#include "viewer/recipe/step_kinds.h"
#include "viewer/scene/visible_range.h"
#include "viewer/segment/mask.h"

namespace volumen {

namespace {

QDoubleSpinBox* valueField(const QString& name, const QString& label) {
  return numberField({name, label}, {.low = -1e9, .high = 1e9, .isLive = true});
}

const StepField& fieldOfConnected(std::string_view name) {
  return *std::ranges::find(stepKind("connected")->fields, name, &StepField::name);
}

// Makes the fields of connected components: what becomes of them, the leak guard and the neighbourhood.
// Limits and words are those of the recipe step "connected".
std::vector<LayoutPart> partLines(const Source<SegmentOptions>& options) {
  auto* use = choiceField({QStringLiteral("segmentPartUse"), tr("What becomes of a connected part"),
                           tr("What a click does. Ctrl+click keeps only the part, Alt+click removes it.")},
                          {tr("adds it, of the range"), tr("keeps only it"), tr("removes it")}, 6);
  const ValueRange allowed = fieldOfConnected("leakGuardMm").allowed;
  auto* guard = numberField({QStringLiteral("segmentLeakGuard"), tr("Leak guard of connected parts"),
                             tr("Connected parts go through nothing that is thinner than twice this, such as "
                                "a bridge between bone and "
                                "table, and lose what is as thin themselves. 0: off.")},
                            {.low = allowed.low,
                             .high = allowed.high,
                             .decimals = 1,
                             .suffix = tr(" mm"),
                             .atLow = tr("Off"),
                             .isLive = true});
  guard->setSingleStep(0.5);
  const auto& words = fieldOfConnected("neighbours").words;
  QStringList texts;
  for (const char* word : words) texts << QLatin1String(word);
  auto* neighbours =
      choiceField({QStringLiteral("segmentPartNeighbours"), tr("Which voxels touch in connected parts"),
                   tr("Which voxels of a connected part touch: those that share a face (6 neighbours), an "
                      "edge too (18), a "
                      "corner too (26).")},
                  texts);
  return {lineOf({new ToolButton(QStringLiteral("segmentPart"), "part"),
                  {options.bind(use, {}, ordinal(at(&SegmentOptions::partUse))), 1}}),
          lineOf({tr("Leak guard"),
                  options.bind(guard, {}, at(&SegmentOptions::leakGuardMm)),
                  {},
                  tr("by"),
                  options.bind(neighbours, {},
                               among(at(&SegmentOptions::neighbours), {words.begin(), words.end()}))})};
}

QString endText(double value, int decimals) { return QLocale().toString(value, 'f', decimals); }

// Returns the text of a span, such as "Visible: above -454 HU".
QString spanText(const ValueRange& span, int decimals, const QString& unit) {
  const auto end = [&](double value) { return endText(value, decimals) + unit; };
  if (std::isinf(span.low) && std::isinf(span.high)) return SegmentRange::tr("Visible: all values");
  if (std::isinf(span.high)) return SegmentRange::tr("Visible: above %1").arg(end(span.low));
  if (std::isinf(span.low)) return SegmentRange::tr("Visible: below %1").arg(end(span.high));
  return SegmentRange::tr("Visible: %1 to %2").arg(endText(span.low, decimals), end(span.high));
}

}  // namespace

SegmentRange::SegmentRange(SegmentEditing& editing, QWidget* parent)
    : QWidget(parent),
      editing_(editing),
      session_(editing.session()),
      table_(flagField({QStringLiteral("segmentTable"), {}})),
      spans_(choiceField({QStringLiteral("segmentSpans"), tr("Visible value range")}, {}, 12)),
      low_(valueField(QStringLiteral("segmentLow"), tr("Lowest value"))),
      high_(valueField(QStringLiteral("segmentHigh"), tr("Highest value"))),
      make_(buttonOf<QPushButton>(QStringLiteral("segment"), tr("Make segment"), [this] { make(); })),
      replace_(buttonOf<QPushButton>(QStringLiteral("segmentReplace"), tr("Replace"), [this] { replace(); })),
      follows_(flagField({QStringLiteral("segmentFollows"), tr("Follows the curve")})),
      only_(flagField({QStringLiteral("segmentOnly"), tr("Only the segment")})) {
  std::vector<LayoutPart> parts{lineOf({table_, {spans_, 1}}),
                                lineOf({tr("From"), {low_, 1}, tr("to"), {high_, 1}}),
                                lineOf({{make_, 1}, {replace_, 1}}), lineOf({follows_, only_, {}})};
  std::ranges::move(partLines(optionsSource(editing)), std::back_inserter(parts));
  parts.push_back({});
  stack(this, parts, 0, 2);
  connectFields();
  showSpans();
  showSegments();
}

void SegmentRange::connectFields() {
  connect(spans_, &QComboBox::activated, this, [this](int n) {
    takeSpan(n);
    low_->setFocus();  // the tint lasts while a field has the focus
    setPreviewing(true);
  });
  for (QDoubleSpinBox* field : {low_, high_}) {
    connect(field, &QDoubleSpinBox::valueChanged, this, [this, field] {
      takeTyped();
      if (field->hasFocus()) setPreviewing(true);
      showOnAxis();
    });
    // Waits until the focus has moved, to know whether the other field has it.
    connect(field, &QDoubleSpinBox::editingFinished, this, [this] {
      QTimer::singleShot(0, this, [this] {
        if (!low_->hasFocus() && !high_->hasFocus()) setPreviewing(false);
      });
    });
  }
  connect(&editing_, &SegmentEditing::optionsChanged, this, &SegmentRange::takeRange);
  connect(follows_, &QCheckBox::clicked, this, &SegmentRange::bind);
  connect(only_, &QCheckBox::clicked, this, &SegmentRange::showOnly);
  connect(only_, &QCheckBox::toggled, this, &SegmentRange::tellPreview);
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series != after.series) setPreviewing(false), tellPreview();
    // Keeps typed numbers if only the table removal changed.
    if (areOneSeries(before.series, after.series) &&
        before.scene.transferFunction == after.scene.transferFunction)
      return;
    showSpans();
    only_->setChecked(only_->isChecked() && after.scene.transferFunction == alone_);
    showSegments();
  });
  whenChanged(session_, this, &SegmentRange::showInOtherUnit, &Preferences::petUnit);
}

// Keeps typed values in another unit.
void SegmentRange::showInOtherUnit() {
  const ValueRange before = editing_.options().range;
  showSpans();
  low_->setValue(before.low * factor_);
  high_->setValue(before.high * factor_);
}

// Puts a range dragged on the axis of the curve into the fields, which round it.
void SegmentRange::takeRange() {
  const ValueRange range = editing_.options().range;
  if (range == typed()) return;
  bool moved = false;
  for (const auto& [field, value] : {std::pair(low_, range.low), std::pair(high_, range.high)}) {
    const QSignalBlocker quiet(field);
    const double before = field->value();
    field->setValue(value * factor_);
    if (field->value() == before) continue;
    moved = true;
    field->setFocus();  // the tint lasts while a field has the focus
  }
  takeTyped();
  if (!moved) return;
  setPreviewing(true);
  showOnAxis();
}

void SegmentRange::showOnAxis() {
  const bool isSeen = isVisible() && whyNoSegments(session_).isEmpty();
  Q_EMIT rangeShown(isSeen ? std::optional(typed()) : std::nullopt);
}

void SegmentRange::setTableAction(QAction* action) {
  const auto show = [this, action] {
    table_->setText(action->text());
    table_->setToolTip(action->toolTip());
    table_->setEnabled(action->isEnabled());
    table_->setChecked(action->isChecked());
  };
  connect(action, &QAction::changed, table_, show);
  connect(table_, &QCheckBox::clicked, action, &QAction::trigger);
  show();
}

// Returns the range in the fields, in stored values.
ValueRange SegmentRange::typed() const {
  return {std::min(low_->value(), high_->value()) / factor_,
          std::max(low_->value(), high_->value()) / factor_};
}

void SegmentRange::takeTyped() {
  editing_.choose([this](SegmentOptions& options) { options.range = typed(); });
}

SegmentWork SegmentRange::workOfRange(const QString& text) const {
  SegmentWork work = workShown(session_, text, tr("Segmenting"));
  work.steps = [volume = work.volume, mask = session_.maskOf(work.series), range = editing_.options().range](
                   const SegmentMap&, int number, const CancelToken& cancel) -> Result<StepsWanted> {
    const std::string name = stepNameOf(number);
    return keptIn({{{"range", name, {{"low", range.low}, {"high", range.high}}}}, {number}}, {name}, *volume,
                  mask, cancel);
  };
  return work;
}

void SegmentRange::make() {
  setPreviewing(false);
  SegmentWork work = workOfRange(tr("Make segment"));
  work.change = [made = segmentOfRange(editing_.options().range, session_.series()->series)](
                    Segment& segment) { segment = made; };
  Q_EMIT making();
  editing_.change(work);
}

void SegmentRange::replace() { replaceBy(tr("Replace segment"), {}); }

// Binds the segment to the selected span and gives it the span's values at once.
void SegmentRange::bind(bool on) {
  if (on) {
    const int number = spans_->currentIndex();
    takeSpan(number);
    return replaceBy(tr("Segment follows the curve"), CurveSpan{number, spans_->count()});
  }
  session_.endGesture();
  session_.change(tr("Segment leaves the curve"),
                  withSegmentChanged(session_.workspace(), keyOf(session_.series()->series),
                                     segmentShown(session_)->number, [](Segment& s) { s.span.reset(); }));
  session_.endGesture();
}

// Keeps a name that the user gave.
void SegmentRange::replaceBy(const QString& text, const std::optional<CurveSpan>& span) {
  setPreviewing(false);
  const Segment* segment = segmentShown(session_);
  const bool isNamedByRange =
      segment->range && segment->label == nameOfRange(*segment->range, session_.series()->series);
  SegmentWork work = workOfRange(text);
  work.number = segment->number;
  work.change = [made = segmentOfRange(editing_.options().range, session_.series()->series), isNamedByRange,
                 span](Segment& s) {
    s.range = made.range;
    s.span = span;
    if (isNamedByRange) s.label = made.label;
  };
  Q_EMIT making();
  editing_.change(work);
}

void SegmentRange::showSpans() {
  spans_->clear();
  const LoadedSeriesPtr& series = session_.series();
  if (!series) return;
  const QString unit = unitSuffix(series->series);
  for (QDoubleSpinBox* field : {low_, high_}) {
    field->setSuffix(unit);
    field->setDecimals(valueDecimals(*series));
  }
  factor_ = shownScale(series->series).factor;
  for (const ValueRange& span : visibleSpans(session_.scene().transferFunction))
    spans_->addItem(spanText({span.low * factor_, span.high * factor_}, valueDecimals(*series) - 1, unit));
  if (spans_->count() == 0) spans_->addItem(tr("Nothing is visible"));
  // Keeps numbers typed for the series. Otherwise offers the first span.
  const bool isAnother = std::exchange(offeredFor_, keyOf(series->series)) != keyOf(series->series);
  if (isAnother || (!segmentsShown(session_) && !low_->hasFocus() && !high_->hasFocus())) takeSpan(0);
  takeTyped();  // the same numbers may be other values
}

void SegmentRange::takeSpan(int n) {
  const auto range = rangeOfSpan(session_.scene().transferFunction, n, *session_.series());
  if (!range) return;
  low_->setValue(range->low * factor_);
  high_->setValue(range->high * factor_);
}

// Returns the current segment if it was made from a value range, else null.
const Segment* SegmentRange::ranged() const {
  const Segment* segment = segmentShown(session_);
  return segment && segment->range ? segment : nullptr;
}

void SegmentRange::showSegments() {
  const QString whyNone = whyNoSegments(session_), whyNotThis = whyNotChanged(session_);
  make_->setEnabled(whyNone.isEmpty());
  make_->setToolTip(toolTipOf(whyNone));
  replace_->setEnabled(whyNotThis.isEmpty());
  replace_->setToolTip(toolTipOf(whyNotThis.isEmpty() ? tr("Puts these values into the segment in place of "
                                                           "its own.")
                                                      : whyNotThis));
  const Segment* segment = segmentShown(session_);
  const bool isAnySpan = session_.series() && !visibleSpans(session_.scene().transferFunction).empty();
  follows_->setEnabled(whyNotThis.isEmpty() && (isAnySpan || segment->span));
  follows_->setChecked(segment && segment->span);
  follows_->setToolTip(
      toolTipOf(whyNotThis.isEmpty()
                    ? tr("The segment has the values of the chosen span of the curve, also once points "
                         "of the curve are moved, until it is changed by hand.")
                    : whyNotThis));
  only_->setEnabled(ranged() != nullptr);
  only_->setToolTip(
      toolTipOf(ranged() ? QString() : tr("Only of a segment that was made of a range of values.")));
  if (only_->isChecked() && (!ranged() || *ranged()->range != aloneRange_)) only_->setChecked(false);
  showOnAxis();
}

void SegmentRange::setPreviewing(bool on) {
  if (!on && !isPreviewing_) return;
  isPreviewing_ = on && whyNoSegments(session_).isEmpty();
  tellPreview();
}

void SegmentRange::tellPreview() {
  if (isPreviewing_)
    Q_EMIT previewChanged(VolumeRange{session_.series()->volume, typed()});
  else if (only_->isChecked() && ranged())
    Q_EMIT previewChanged(VolumeRange{session_.series()->volume, *ranged()->range});
  else
    Q_EMIT previewChanged({});
}

void SegmentRange::showOnly(bool on) {
  if (on) {
    before_ = session_.scene().transferFunction;
    aloneRange_ = *ranged()->range;
    alone_ = restrictedTo(before_, aloneRange_);
  }
  const TransferFunction& curve = on ? alone_ : before_;
  session_.edit(on ? tr("Show only the segment") : tr("Show all values"),
                [&](Scene& s) { s.transferFunction = curve; });
  only_->setChecked(on);
}

}  // namespace volumen
