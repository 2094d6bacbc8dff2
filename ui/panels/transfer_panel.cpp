#include "ui/panels/transfer_panel.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <cmath>

#include "ui/session/text.h"

namespace volumen {

namespace {
const double ln2 = std::log(2.0);
constexpr double longestHalving = 1e5, shortestHalving = 0.05;  // mm, of the field
}  // namespace

TransferPanel::TransferPanel(Session& session, QWidget* parent)
    : QWidget(parent), session_(session), editor_(new CurveEditor), fields_(new QWidget) {
  editor_->setObjectName(QStringLiteral("curveEditor"));
  makeFields();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(editor_, 1);
  column->addWidget(fields_);
  column->addWidget(makeScaleBox());
  connectEditor();
  connectFields();
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (!areOneSeries(before.series, after.series) && after.series) {
      editor_->setHistogram(after.series->histogram, valueUnit(*after.series->volume));
      value_->setDecimals(valueDecimals(after.series->histogram));
    }
    if (before.scene.transferFunction == after.scene.transferFunction) return;
    editor_->setCurve(after.scene.transferFunction);
    showPoint();
  });
  editor_->setCurve(session_.scene().transferFunction);
  showPoint();
}

QWidget* TransferPanel::makeScaleBox() {
  auto* scale = new QComboBox;
  scale->setObjectName(QStringLiteral("opacityScale"));
  scale->setAccessibleName(tr("Opacity axis"));
  scale->addItems({tr("linear opacity"), tr("logarithmic extinction")});
  scale->setToolTip(tr("The logarithmic axis reaches 0.0001 per mm with the mouse."));
  connect(scale, &QComboBox::activated, this, [this](int n) {
    editor_->setOpacityScale(n == 0 ? OpacityScale::linear : OpacityScale::extinction);
  });
  return scale;
}

void TransferPanel::makeFields() {
  auto* grid = new QGridLayout(fields_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  value_ = addField(QStringLiteral("pointValue"), tr("Value"), 1, -1e9, 1e9);
  opacity_ = addField(QStringLiteral("pointOpacity"), tr("Opacity per mm"), 5, 0, 1);
  halving_ =
      addField(QStringLiteral("pointHalving"), tr("Halves light in"), 2, shortestHalving, longestHalving);
  halving_->setSuffix(tr(" mm"));
  colour_ = new ColourButton(tr("Colour of the point"));
  colour_->setObjectName(QStringLiteral("pointColour"));
  grid->addWidget(new QLabel(tr("Colour")), 0, 3);
  grid->addWidget(colour_, 1, 3);
  for (int column = 0; column < 3; ++column) grid->setColumnStretch(column, 1);
}

void TransferPanel::connectEditor() {
  connect(editor_, &CurveEditor::edited, this, [this](const TransferFunction& curve, const QString& what) {
    session_.edit(
        what, [&](Scene& s) { s.transferFunction = curve; }, what);
  });
  connect(editor_, &CurveEditor::gestureFinished, this, [this] { session_.endGesture(); });
  connect(editor_, &CurveEditor::selectionChanged, this, &TransferPanel::showPoint);
  connect(editor_, &CurveEditor::colourRequested, colour_, &ColourButton::click);
}

void TransferPanel::connectFields() {
  const auto unitDistance = [this] { return session_.scene().transferFunction.unitDistance; };
  connect(value_, &QDoubleSpinBox::valueChanged, this, [this](double v) {
    changePoint([v](CurvePoint& p) { p.value = float(v); }, tr("Set value of a curve point"));
  });
  connect(opacity_, &QDoubleSpinBox::valueChanged, this, [this, unitDistance](double perMm) {
    const double opacity = opacityFromExtinction(extinctionPerMm(perMm, 1), unitDistance());
    changePoint([opacity](CurvePoint& p) { p.opacity = opacity; }, tr("Set opacity of a curve point"));
  });
  connect(halving_, &QDoubleSpinBox::valueChanged, this, [this, unitDistance](double mm) {
    const double opacity = opacityFromExtinction(ln2 / mm, unitDistance());
    changePoint([opacity](CurvePoint& p) { p.opacity = opacity; }, tr("Set opacity of a curve point"));
  });
  connect(colour_, &ColourButton::colourEdited, this, [this](glm::dvec3 c) {
    changePoint([c](CurvePoint& p) { p.colour = c; }, tr("Colour of a curve point"));
  });
  connect(colour_, &ColourButton::gestureFinished, this, [this] { session_.endGesture(); });
}

QDoubleSpinBox* TransferPanel::addField(const QString& name, const QString& label, int decimals, double low,
                                        double high) {
  auto* grid = static_cast<QGridLayout*>(fields_->layout());
  auto* field = new QDoubleSpinBox;
  field->setObjectName(name);
  field->setAccessibleName(label);
  field->setDecimals(decimals);
  field->setRange(low, high);
  field->setKeyboardTracking(false);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setMinimumWidth(64);
  connect(field, &QDoubleSpinBox::editingFinished, this, [this] { session_.endGesture(); });
  const int column = grid->columnCount() - (grid->count() == 0 ? 1 : 0);
  auto* caption = new QLabel(label);
  caption->setBuddy(field);
  grid->addWidget(caption, 0, column);
  grid->addWidget(field, 1, column);
  return field;
}

void TransferPanel::showPoint() {
  const TransferFunction& curve = session_.scene().transferFunction;
  const int n = editor_->selected();
  const bool any = n >= 0 && n < int(curve.points.size());
  fields_->setEnabled(any);
  if (!any) return;
  const QSignalBlocker quietValue(value_), quietOpacity(opacity_), quietHalving(halving_);
  const CurvePoint& point = curve.points[n];
  const double extinction = extinctionPerMm(point.opacity, curve.unitDistance);
  value_->setSuffix(session_.series() ? QLatin1Char(' ') + valueUnit(*session_.series()->volume) : QString());
  value_->setValue(point.value);
  opacity_->setValue(opacityFromExtinction(extinction, 1));
  // At both ends there is no number: the field stands at its smallest value, under another name.
  const bool none = extinction == 0, all = point.opacity >= 1;
  halving_->setSpecialValueText(none ? tr("never") : all ? tr("0 mm") : QString());
  halving_->setValue(none || all ? shortestHalving : ln2 / extinction);
  colour_->setColour(point.colour);
}

void TransferPanel::changePoint(const std::function<void(CurvePoint&)>& change, const QString& what) {
  const int n = editor_->selected();
  if (n < 0) return;
  session_.edit(
      what,
      [&](Scene& s) {
        auto& points = s.transferFunction.points;
        CurvePoint& point = points[n];
        change(point);
        // Not past the neighbours: values must not decrease.
        if (n > 0) point.value = std::max(point.value, points[n - 1].value);
        if (n + 1 < int(points.size())) point.value = std::min(point.value, points[n + 1].value);
      },
      what);
}

}  // namespace volumen
