#include "ui/panels/step_fields.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <algorithm>
#include <cmath>
#include <utility>

#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/controller/segment_target.h"
#include "ui/widgets/plain_text.h"
#include "viewer/recipe/step_names.h"

namespace volumen {

namespace {

bool namesSegment(const StepField& field) {
  return std::holds_alternative<std::string>(field.byDefault) && field.words.empty();
}

}  // namespace

StepFields::StepFields(Session& session, QWidget* parent)
    : QWidget(parent), session_(session), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setSpacing(4);
  for (const int column : {1, 3}) grid_->setColumnStretch(column, 1);
}

void StepFields::showKind(const StepKind& kind) {
  forgetOtherSeries();
  if (const QStringList all = shownBy(kind); std::exchange(shown_, all) == all) return;
  qDeleteAll(findChildren<QWidget*>(Qt::FindDirectChildrenOnly));
  const auto chosen = std::ranges::count_if(kind.fields, isChosen);
  int n = 0;
  for (const StepField& field : kind.fields) {
    if (!isChosen(field)) continue;
    QWidget* made = fieldFor(field);
    made->setObjectName(QStringLiteral("stepField-") + QLatin1String(field.name));
    made->setAccessibleName(tr(field.title));
    // Two fields a row. The last one takes the rest of its row.
    const int row = n / 2, column = n % 2 * 2, columns = ++n == chosen && column == 0 ? 3 : 1;
    grid_->addWidget(plainLabel(tr(field.title)), row, column);
    grid_->addWidget(made, row, column + 1, 1, columns);
  }
}

// Returns everything that the fields depend on. While it is the same, the fields and text being typed are
// kept.
QStringList StepFields::shownBy(const StepKind& kind) const {
  QStringList all{QLatin1String(kind.name)};
  if (!session_.series()) return all;
  all << shownText(session_.series()->series.id) << unitSuffix(session_.series()->series);
  const Segment* current = segmentShown(session_);
  if (!current) return all;
  all << QString::number(current->number);
  for (const Segment& segment : segmentsShown(session_)->segments)
    all << QString::number(segment.number) << shownText(segment.label);
  return all;
}

void StepFields::forgetOtherSeries() {
  if (areOneSeries(series_, session_.series())) return;
  values_.clear();
  series_ = session_.series();
}

QWidget* StepFields::fieldFor(const StepField& field) {
  if (namesSegment(field)) return segmentsFor(field);
  if (!field.words.empty()) return wordsFor(field);
  if (std::holds_alternative<double>(field.byDefault)) return numberFor(field);
  auto* box = new QCheckBox;
  box->setChecked(std::get<bool>(valueOf(field)));
  connect(box, &QCheckBox::clicked, this, [this, &field](bool on) { take(field, on); });
  return box;
}

QWidget* StepFields::numberFor(const StepField& field) {
  constexpr double most = 1e9;
  auto* spin = new QDoubleSpinBox;
  const bool ofValues = isOfValues(field) && session_.series();
  const double factor = ofValues ? shownScale(session_.series()->series).factor : 1;
  spin->setDecimals(field.number == StepField::Number::whole ? 0
                    : ofValues                               ? valueDecimals(*session_.series())
                                                             : 2);
  spin->setRange(std::max(-most, factor * field.allowed.low), std::min(most, factor * field.allowed.high));
  spin->setSuffix(ofValues              ? unitSuffix(session_.series()->series)
                  : *field.unit == '\0' ? QString()
                                        : QStringLiteral(" ") + QLatin1String(field.unit));
  spin->setValue(factor * std::get<double>(valueOf(field)));
  spin->setButtonSymbols(QAbstractSpinBox::NoButtons);
  spin->setMinimumWidth(70);
  connect(spin, &QDoubleSpinBox::valueChanged, this,
          [this, &field, factor](double value) { take(field, value / factor); });
  return spin;
}

QComboBox* StepFields::wordsFor(const StepField& field) {
  auto* box = new QComboBox;
  for (const char* word : field.words) box->addItem(QLatin1String(word));
  box->setCurrentText(QString::fromStdString(std::get<std::string>(valueOf(field))));
  connect(box, &QComboBox::activated, this,
          [this, &field, box] { take(field, box->currentText().toStdString()); });
  return box;
}

QComboBox* StepFields::segmentsFor(const StepField& field) {
  auto* box = new QComboBox;
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);  // names may be long
  box->setMinimumContentsLength(6);
  if (field.need == StepField::Need::no) box->addItem(tr("None"), QString());
  const Segment* current = segmentShown(session_);
  if (const SegmentMap* map = segmentsShown(session_))
    for (const Segment& segment : map->segments)
      if (&segment != current)
        box->addItem(shownText(segment.label), QString::fromStdString(stepNameOf(segment.number)));
  box->setCurrentIndex(std::max(0, box->findData(QString::fromStdString(segmentOf(field)))));
  box->setEnabled(box->count() > 0);
  box->setToolTip(toolTipOf(box->count() > 0 ? tr(field.title) : noOtherSegment(session_)));
  connect(box, &QComboBox::activated, this,
          [this, &field, box] { take(field, box->currentData().toString().toStdString()); });
  return box;
}

void StepFields::take(const StepField& field, const StepValue& value) {
  (isOfValues(field) ? values_ : typed_).insert_or_assign(field.name, value);
  Q_EMIT changed();
}

// Returns the chosen segment unless it has become the current one. Otherwise returns the first other segment
// if the field needs one, else empty text.
std::string StepFields::segmentOf(const StepField& field) const {
  const SegmentMap* map = segmentsShown(session_);
  const Segment* current = segmentShown(session_);
  const auto chosen = typed_.find(field.name);
  std::string first;
  if (!map) return first;
  for (const Segment& segment : map->segments) {
    if (&segment == current) continue;
    const std::string name = stepNameOf(segment.number);
    if (chosen != typed_.end() && std::get<std::string>(chosen->second) == name) return name;
    if (first.empty() && field.need == StepField::Need::yes) first = name;
  }
  return first;
}

StepValue StepFields::valueOf(const StepField& field) const {
  if (namesSegment(field)) return segmentOf(field);
  const auto& typed = isOfValues(field) ? values_ : typed_;
  if (const auto given = typed.find(field.name); given != typed.end()) {
    if (const auto* number = std::get_if<double>(&given->second))
      return std::clamp(*number, field.allowed.low, field.allowed.high);
    // Another kind of step may have a field of that name with other words.
    const auto* word = std::get_if<std::string>(&given->second);
    return word && std::ranges::find(field.words, *word) == field.words.end() ? field.byDefault
                                                                              : given->second;
  }
  // An infinite limit becomes the limit of the series' values.
  if (const auto* number = std::get_if<double>(&field.byDefault);
      number && std::isinf(*number) && session_.series()) {
    const Histogram& histogram = session_.series()->histogram;
    return *number < 0 ? histogram.low : histogram.high;
  }
  return field.byDefault;
}

std::map<std::string, StepValue> StepFields::valuesFor(const StepKind& kind) const {
  std::map<std::string, StepValue> values;
  for (const StepField& field : kind.fields)
    if (isChosen(field)) values[field.name] = valueOf(field);
  return values;
}

QString StepFields::whyNot(const StepKind& kind) const {
  const QString why = whyNotChanged(session_);
  if (!why.isEmpty()) return why;
  if (isRangeReversed({kind.name, {}, valuesFor(kind)})) return tr("The range ends below where it begins.");
  for (const StepField& field : kind.fields) {
    if (!namesSegment(field)) continue;
    const std::string name = segmentOf(field);
    if (name.empty() && field.need == StepField::Need::yes) return noOtherSegment(session_);
    // These steps take voxels of the other segment, so it must be unlocked.
    const std::string_view step(kind.name);
    if (step != "add" && step != "merge" && step != "copy") continue;
    for (const Segment& segment : segmentsShown(session_)->segments)
      if (stepNameOf(segment.number) == name && segment.locked)
        return tr("%1 is locked: unlock it first.").arg(shownText(segment.label));
  }
  return {};
}

}  // namespace volumen
