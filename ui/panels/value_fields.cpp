#include "ui/panels/value_fields.h"

#include <QSignalBlocker>
#include <cmath>

#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr double largestValue = 1e9;

// Returns the decimals for four digits of the width, at least one.
int decimalsOf(double width) {
  return width > 0 ? std::clamp(3 - int(std::floor(std::log10(width))), 1, 6) : 1;
}

}  // namespace

ValueFields::ValueFields(const QString& name, Which which, QWidget* parent) : QWidget(parent) {
  const auto field = [&](const QString& suffix, const QString& label) {
    auto* made = numberField({name + suffix, label}, {.low = -largestValue, .high = largestValue});
    connect(made, &QDoubleSpinBox::valueChanged, this, [this, made] { typed(made); });
    connect(made, &QDoubleSpinBox::editingFinished, this, &ValueFields::gestureFinished);
    fields_.push_back(made);
    return made;
  };
  if (which != Which::ends) {
    centre_ = field(QStringLiteral("Centre"), tr("Centre"));
    width_ = field(QStringLiteral("Width"), tr("Width"));
    width_->setMinimum(0);  // typed() rejects zero
  }
  if (which != Which::centreAndWidth) {
    low_ = field(QStringLiteral("Low"), tr("Lowest"));
    high_ = field(QStringLiteral("High"), tr("Highest"));
  }
  stackWithCaptions(this, {fields_.begin(), fields_.end()});
}

void ValueFields::setWindow(const Window& window, const Series& series, std::optional<int> decimals) {
  window_ = shownWindow(window, series);
  toStored_ = 1 / shownScale(series).factor;
  const double width = std::abs(window_->width);
  const std::pair<QDoubleSpinBox*, double> fields[] = {{centre_, window_->centre},
                                                       {width_, width},
                                                       {low_, window_->centre - width / 2},
                                                       {high_, window_->centre + width / 2}};
  for (const auto& [field, value] : fields) {
    if (!field) continue;
    const QSignalBlocker quiet(field);
    field->setSuffix(unitSuffix(series));
    field->setDecimals(decimals.value_or(decimalsOf(width)));
    field->setValue(value);
  }
}

// Keeps the exact values of fields that were not typed.
void ValueFields::typed(QDoubleSpinBox* field) {
  if (!window_) return;
  const double sign = window_->width < 0 ? -1 : 1, value = field->value();
  const double width = std::abs(window_->width);
  if (field == width_ && value <= 0) {  // rejects an empty window
    const QSignalBlocker quiet(field);
    return field->setValue(width);
  }
  double low = window_->centre - width / 2, high = low + width;
  if (field == centre_) low = value - width / 2, high = value + width / 2;
  if (field == width_) low = window_->centre - value / 2, high = window_->centre + value / 2;
  // An end typed beyond the other one moves that along.
  if (field == low_) low = value, high = low < high ? high : low + width;
  if (field == high_) high = value, low = low < high ? low : high - width;
  low *= toStored_, high *= toStored_;
  Q_EMIT edited(sign > 0 ? WindowEnds{low, high} : WindowEnds{high, low});
}

}  // namespace volumen
