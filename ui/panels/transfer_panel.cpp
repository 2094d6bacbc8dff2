#include "ui/panels/transfer_panel.h"

#include <QGridLayout>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <cmath>

#include "results/text/text.h"
#include "ui/panels/sources.h"
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
      mode_(choiceField({QStringLiteral("mode"), tr("Mode"), tr("What is shown of each line of sight")})) {
  editor_->setObjectName(QStringLiteral("curveEditor"));
  makeFields();
  makePages();
  stack(this, {lineOf({captionOf(tr("Mode"), mode_), {mode_, 1}}, -1), {editor_, 1}, pages_}, 0, 2)
      ->setContentsMargins(8, 4, 8, 4);
  connectEditor();
  connectMode();
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
  const Source<Preferences> preferences = preferencesSource(session_);
  auto* scale = choiceField(
      {QStringLiteral("opacityScale"), tr("Opacity axis"),
       tr("The logarithmic axis makes opacities down to 0.0001 per mm adjustable with the mouse.")},
      {tr("Opacity axis: linear"), tr("Opacity axis: logarithmic")});
  preferences.bind(scale, {}, among(at(&Preferences::logarithmicOpacity), {false, true}));
  preferences.follow(editor_, [this](const Preferences& p) {
    editor_->setOpacityScale(p.logarithmicOpacity ? OpacityScale::extinction : OpacityScale::linear);
  });
  stack(curve, {fields_, scale}, 0, -1);
  pages_->addWidget(curve);
  pages_->addWidget(new WindowFields(session_));
  pages_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
}

void TransferPanel::connectMode() {
  for (const ModeRow& row : modeRows()) mode_->addItem(QString::fromUtf8(row.title));
  connect(mode_, &QComboBox::activated, this, [this](int n) {
    if (session_.series())
      session_.edit(tr("Mode %1").arg(mode_->itemText(n)),
                    withMode(session_.scene(), Mode(n), *session_.series()));
  });
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

void TransferPanel::makeFields() {
  auto* grid = new QGridLayout(fields_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  const auto add = [this, grid](const char* name, const QString& label, const NumberFormat& format,
                                const QString& what, const std::function<void(CurvePoint&, double)>& set) {
    auto* field = numberField(
        {QLatin1String(name), QString(label).replace(QLatin1Char('\n'), QLatin1Char(' '))}, format);
    const int column = grid->count() / 2;
    grid->addWidget(captionOf(label, field), 0, column, Qt::AlignBottom);
    grid->addWidget(field, 1, column);
    grid->setColumnStretch(column, 1);
    whenEdited(
        field, [this, what, set](double v) { changePoint([&](CurvePoint& p) { set(p, v); }, what); },
        [this] { session_.endGesture(); });
    return field;
  };
  const auto unitDistance = [this] { return session_.scene().transferFunction.unitDistance; };
  value_ = add("pointValue", tr("Value"), {.low = -1e9, .high = 1e9, .decimals = 1}, tr("Point value"),
               [](CurvePoint& p, double v) { p.value = float(v); });
  opacity_ = add("pointOpacity", tr("Opacity\nper mm"), {.decimals = 5}, tr("Point opacity"),
                 [unitDistance](CurvePoint& p, double perMm) {
                   p.opacity = opacityFromExtinction(extinctionPerMm(perMm, 1), unitDistance());
                 });
  halving_ = add("pointHalving", tr("Half-value\ndepth"), {.low = shortestHalving, .high = longestHalving},
                 tr("Point opacity"), [unitDistance](CurvePoint& p, double mm) {
                   p.opacity = opacityFromExtinction(ln2 / mm, unitDistance());
                 });
  colour_ = new ColourButton(tr("Point colour"));
  colour_->setObjectName(QStringLiteral("pointColour"));
  grid->addWidget(plainLabel(tr("Colour")), 0, 3, Qt::AlignBottom);
  grid->addWidget(colour_, 1, 3);
  whenEdited(
      colour_,
      [this](glm::dvec3 c) { changePoint([c](CurvePoint& p) { p.colour = c; }, tr("Point colour")); },
      [this] { session_.endGesture(); });
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
