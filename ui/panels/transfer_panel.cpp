#include "ui/panels/transfer_panel.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <cmath>

#include "results/text/text.h"
#include "ui/panels/window_fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/windows.h"
#include "viewer/scene/modes.h"

namespace volumen {

namespace {
const double ln2 = std::log(2.0);
constexpr double longestHalving = 1e5, shortestHalving = 0.05;  // limits of the field, mm
}  // namespace

TransferPanel::TransferPanel(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      editor_(new CurveEditor),
      fields_(new QWidget),
      pages_(new QStackedWidget),
      mode_(new QComboBox),
      scale_(new QComboBox) {
  editor_->setObjectName(QStringLiteral("curveEditor"));
  makeFields();
  makeScaleBox();
  makePages();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 4, 8, 4);
  column->setSpacing(2);
  column->addWidget(makeModeRow());
  column->addWidget(editor_, 1);
  column->addWidget(pages_);
  connectEditor();
  connectFields();
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (!areOneSeries(before.series, after.series) && after.series) {
      editor_->setHistogram(after.series->histogram, shownText(after.series->series.unit));
      value_->setDecimals(valueDecimals(after.series->histogram));
    }
    if (before.series != after.series || before.scene.mode != after.scene.mode) showMode();
    if (before.series == after.series && before.scene.mode == after.scene.mode &&
        before.scene.window == after.scene.window &&
        before.scene.transferFunction == after.scene.transferFunction)
      return;
    showCurve();
  });
  showMode();
  showCurve();
}

// Gives both pages one height, so that nothing moves when the mode changes.
void TransferPanel::makePages() {
  auto* curve = new QWidget;
  auto* column = new QVBoxLayout(curve);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(fields_);
  column->addWidget(scale_);
  pages_->addWidget(curve);
  pages_->addWidget(new WindowFields(session_));
  pages_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
}

QWidget* TransferPanel::makeModeRow() {
  mode_->setObjectName(QStringLiteral("mode"));
  mode_->setAccessibleName(tr("Mode"));
  for (const ModeRow& row : modeRows()) mode_->addItem(QString::fromUtf8(row.title));
  mode_->setToolTip(tr("What is shown of each line of sight"));
  connect(mode_, &QComboBox::activated, this, [this](int n) {
    if (session_.series())
      session_.edit(tr("Mode %1").arg(mode_->itemText(n)),
                    withMode(session_.scene(), Mode(n), *session_.series()));
  });
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  auto* label = plainLabel(tr("Mode"));
  label->setBuddy(mode_);
  line->addWidget(label);
  line->addWidget(mode_, 1);
  return row;
}

void TransferPanel::showMode() {
  const bool window = session_.scene().mode != Mode::composite;
  mode_->setCurrentIndex(int(session_.scene().mode));
  mode_->setEnabled(session_.series() != nullptr);
  editor_->setWindow(window);
  pages_->setCurrentIndex(window ? 1 : 0);
}

void TransferPanel::showCurve() {
  const Scene& scene = session_.scene();
  if (scene.mode == Mode::composite || !session_.series()) {
    editor_->setCurve(scene.transferFunction);
    return showPoint();
  }
  // Draws the window as a curve from black to white.
  const WindowEnds ends = endsOf(windowInUse(scene, *session_.series()));
  const CurvePoint dark{float(ends.dark), glm::dvec3(0), 0}, bright{float(ends.bright), glm::dvec3(1), 1};
  TransferFunction curve;
  curve.points = ends.dark < ends.bright ? std::vector{dark, bright} : std::vector{bright, dark};
  editor_->setCurve(curve);
}

void TransferPanel::editWindow(const TransferFunction& curve, const QString& what) {
  // Without a series, as after undoing its removal, there is no window to edit.
  if (!session_.series()) return showCurve();
  const CurvePoint &first = curve.points.front(), &last = curve.points.back();
  WindowEnds ends{first.value, last.value};
  if (ends.bright - ends.dark < session_.series()->valueSpread / 4000) return showCurve();
  if (first.opacity > last.opacity) std::swap(ends.dark, ends.bright);
  session_.edit(
      what, [&](Scene& s) { s.window = windowBetween(ends); }, what);
}

void TransferPanel::makeScaleBox() {
  scale_->setObjectName(QStringLiteral("opacityScale"));
  scale_->setAccessibleName(tr("Opacity axis"));
  scale_->addItems({tr("Opacity axis: linear"), tr("Opacity axis: logarithmic")});
  scale_->setToolTip(
      tr("The logarithmic axis makes opacities down to 0.0001 per mm adjustable with the mouse."));
  connect(scale_, &QComboBox::activated, this,
          [this](int n) { session_.prefer([n](Preferences& p) { p.logarithmicOpacity = n == 1; }); });
  const auto show = [this] {
    const bool logarithmic = session_.preferences().logarithmicOpacity;
    scale_->setCurrentIndex(logarithmic ? 1 : 0);
    editor_->setOpacityScale(logarithmic ? OpacityScale::extinction : OpacityScale::linear);
  };
  connect(&session_, &Session::preferencesChanged, this, show);
  show();
}

void TransferPanel::makeFields() {
  auto* grid = new QGridLayout(fields_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  value_ = addField(QStringLiteral("pointValue"), tr("Value"), 1, -1e9, 1e9);
  opacity_ = addField(QStringLiteral("pointOpacity"), tr("Opacity\nper mm"), 5, 0, 1);
  halving_ =
      addField(QStringLiteral("pointHalving"), tr("Half-value\ndepth"), 2, shortestHalving, longestHalving);
  colour_ = new ColourButton(tr("Point colour"));
  colour_->setObjectName(QStringLiteral("pointColour"));
  grid->addWidget(plainLabel(tr("Colour")), 0, 3, Qt::AlignBottom);
  grid->addWidget(colour_, 1, 3);
  for (int column = 0; column < 3; ++column) grid->setColumnStretch(column, 1);
}

void TransferPanel::connectEditor() {
  connect(editor_, &CurveEditor::edited, this, [this](const TransferFunction& curve, const QString& what) {
    if (session_.scene().mode != Mode::composite) return editWindow(curve, what);
    session_.edit(
        what, [&](Scene& s) { s.transferFunction = curve; }, what);
    Q_EMIT curvePulled();
  });
  connect(editor_, &CurveEditor::gestureFinished, this, [this] { session_.endGesture(); });
  connect(editor_, &CurveEditor::selectionChanged, this, &TransferPanel::showPoint);
  connect(editor_, &CurveEditor::colourRequested, colour_, &ColourButton::click);
}

void TransferPanel::connectFields() {
  const auto unitDistance = [this] { return session_.scene().transferFunction.unitDistance; };
  connect(value_, &QDoubleSpinBox::valueChanged, this,
          [this](double v) { changePoint([v](CurvePoint& p) { p.value = float(v); }, tr("Point value")); });
  connect(opacity_, &QDoubleSpinBox::valueChanged, this, [this, unitDistance](double perMm) {
    const double opacity = opacityFromExtinction(extinctionPerMm(perMm, 1), unitDistance());
    changePoint([opacity](CurvePoint& p) { p.opacity = opacity; }, tr("Point opacity"));
  });
  connect(halving_, &QDoubleSpinBox::valueChanged, this, [this, unitDistance](double mm) {
    const double opacity = opacityFromExtinction(ln2 / mm, unitDistance());
    changePoint([opacity](CurvePoint& p) { p.opacity = opacity; }, tr("Point opacity"));
  });
  connect(colour_, &ColourButton::colourEdited, this,
          [this](glm::dvec3 c) { changePoint([c](CurvePoint& p) { p.colour = c; }, tr("Point colour")); });
  connect(colour_, &ColourButton::gestureFinished, this, [this] { session_.endGesture(); });
}

QDoubleSpinBox* TransferPanel::addField(const QString& name, const QString& label, int decimals, double low,
                                        double high) {
  auto* grid = static_cast<QGridLayout*>(fields_->layout());
  auto* field = new QDoubleSpinBox;
  field->setObjectName(name);
  field->setAccessibleName(QString(label).replace(QLatin1Char('\n'), QLatin1Char(' ')));
  field->setDecimals(decimals);
  field->setRange(low, high);
  field->setKeyboardTracking(false);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setMinimumWidth(64);
  connect(field, &QDoubleSpinBox::editingFinished, this, [this] { session_.endGesture(); });
  const int column = grid->columnCount() - (grid->count() == 0 ? 1 : 0);
  auto* caption = plainLabel(label);
  caption->setBuddy(field);
  grid->addWidget(caption, 0, column, Qt::AlignBottom);
  grid->addWidget(field, 1, column);
  return field;
}

void TransferPanel::showPoint() {
  if (session_.scene().mode != Mode::composite) return;
  const TransferFunction& curve = session_.scene().transferFunction;
  const int n = editor_->selected();
  const bool any = n >= 0 && n < int(curve.points.size());
  fields_->setEnabled(any);
  const QSignalBlocker quietValue(value_), quietOpacity(opacity_), quietHalving(halving_);
  const QString unit = session_.series() ? shownText(session_.series()->series.unit) : QString();
  value_->setSuffix(any && !unit.isEmpty() ? QLatin1Char(' ') + unit : QString());
  halving_->setSuffix(any ? tr(" mm") : QString());
  if (!any) {
    for (QDoubleSpinBox* field : {value_, opacity_, halving_}) field->clear();
    return;
  }
  const CurvePoint& point = curve.points[n];
  const double extinction = extinctionPerMm(point.opacity, curve.unitDistance);
  value_->setValue(point.value);
  opacity_->setValue(opacityFromExtinction(extinction, 1));
  // Both extremes have no number, so the field shows its minimum under another name.
  const bool none = extinction == 0, all = point.opacity >= 1;
  halving_->setSpecialValueText(none ? tr("none") : all ? tr("< 0.01 mm") : QString());
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
        // Stops at the neighbours, as values must not decrease.
        if (n > 0) point.value = std::max(point.value, points[n - 1].value);
        if (n + 1 < int(points.size())) point.value = std::min(point.value, points[n + 1].value);
      },
      what);
  Q_EMIT curvePulled();
}

}  // namespace volumen
