#include "ui/panels/value_fields.h"

#include <QGridLayout>
#include <QSignalBlocker>
#include <cmath>

#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr double largestValue = 1e9;

// Returns the decimals for four digits of the width, at least one.
int decimalsOf(double width) {
  return width > 0 ? std::clamp(3 - int(std::floor(std::log10(width))), 1, 6) : 1;
}

}  // namespace

ValueFields::ValueFields(const QString& name, bool all, QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  grid->setColumnStretch(1, 1);
  if (all) {
    centre_ = addField(name + QStringLiteral("Centre"), tr("Centre"));
    width_ = addField(name + QStringLiteral("Width"), tr("Width"));
    width_->setMinimum(0);  // typed() rejects zero
  }
  low_ = addField(name + QStringLiteral("Low"), tr("Lowest"));
  high_ = addField(name + QStringLiteral("High"), tr("Highest"));
}

QDoubleSpinBox* ValueFields::addField(const QString& name, const QString& label) {
  auto* field = new QDoubleSpinBox;
  field->setObjectName(name);
  field->setAccessibleName(label);
  field->setRange(-largestValue, largestValue);
  field->setKeyboardTracking(false);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setMinimumWidth(64);
  auto* caption = plainLabel(label);
  caption->setBuddy(field);
  auto* grid = static_cast<QGridLayout*>(layout());
  const int row = grid->count() / 2;
  grid->addWidget(caption, row, 0);
  grid->addWidget(field, row, 1);
  connect(field, &QDoubleSpinBox::valueChanged, this, [this, field] { typed(field); });
  connect(field, &QDoubleSpinBox::editingFinished, this, &ValueFields::gestureFinished);
  return field;
}

void ValueFields::setWindow(const Window& window, const Series& series) {
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
    field->setDecimals(decimalsOf(width));
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
