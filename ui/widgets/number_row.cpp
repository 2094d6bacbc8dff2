#include "ui/widgets/number_row.h"

#include <QEvent>
#include <QFontMetrics>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <cmath>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {
constexpr int sliderSteps = 1000;
}

NumberRow::NumberRow(const QString& name, const NumberFormat& format, QWidget* parent)
    : QWidget(parent),
      format_(format),
      label_(plainLabel()),
      slider_(new QSlider(Qt::Horizontal)),
      field_(numberField({QString(name).remove(QLatin1Char(' ')), name}, format)) {
  slider_->setRange(0, sliderSteps);
  slider_->setPageStep(sliderSteps / 10);
  slider_->setSingleStep(sliderSteps / 100);
  slider_->setMinimumWidth(40);
  field_->setButtonSymbols(QAbstractSpinBox::UpDownArrows);
  field_->setSingleStep(std::pow(10.0, 1 - format.decimals) / 2);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(8);
  label_->setBuddy(field_);
  setName(name);
  row->addWidget(label_);
  row->addWidget(slider_, 1);
  row->addWidget(field_);
  setWidths();
  connect(slider_, &QSlider::valueChanged, this, [this](int position) {
    const QSignalBlocker quiet(field_);
    field_->setValue(valueOf(position));
    Q_EMIT valueEdited(field_->value());
    if (!slider_->isSliderDown()) Q_EMIT gestureFinished();
  });
  connect(slider_, &QSlider::sliderReleased, this, &NumberRow::gestureFinished);
  connect(field_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    const QSignalBlocker quiet(slider_);
    slider_->setValue(sliderOf(value));
    Q_EMIT valueEdited(value);
  });
  connect(field_, &QDoubleSpinBox::editingFinished, this, &NumberRow::gestureFinished);
}

// Equal widths in all rows keep them aligned.
void NumberRow::setWidths() {
  const QFontMetrics metrics = fontMetrics();
  label_->setFixedWidth(metrics.horizontalAdvance(QStringLiteral("Posterior edge")) + 2);
  field_->setFixedWidth(metrics.horizontalAdvance(QStringLiteral("100.00 %")) + 28);
}

void NumberRow::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) setWidths();
}

void NumberRow::setName(const QString& name) {
  label_->setText(name);
  slider_->setAccessibleName(name);
  field_->setAccessibleName(name);
}

void NumberRow::setValue(double value) {
  const QSignalBlocker quietSlider(slider_), quietField(field_);
  field_->setValue(value);
  if (!slider_->isSliderDown()) slider_->setValue(sliderOf(value));
}

int NumberRow::sliderOf(double value) const {
  const double along = format_.logarithmic ? std::log(std::max(value, format_.low) / format_.low) /
                                                 std::log(format_.high / format_.low)
                                           : (value - format_.low) / (format_.high - format_.low);
  return int(std::lround(std::clamp(along, 0.0, 1.0) * sliderSteps));
}

double NumberRow::valueOf(int position) const {
  const double along = double(position) / sliderSteps;
  return format_.logarithmic ? format_.low * std::pow(format_.high / format_.low, along)
                             : format_.low + along * (format_.high - format_.low);
}

}  // namespace volumen
