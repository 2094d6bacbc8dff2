#include "ui/views/time_bar.h"

#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "ui/widgets/plain_text.h"
#include "ui/workspace/time_point_text.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {
constexpr double usualRate = 10;  // steps a second, where the file recommends none
}

TimeBar::TimeBar(Session& session, ViewId view, QWidget* parent)
    : QSlider(Qt::Horizontal, parent), session_(session), view_(view) {
  setObjectName(QStringLiteral("timeBar%1").arg(view));
  setAccessibleName(tr("Time point"));
  setFocusPolicy(Qt::NoFocus);
  setMaximum(0);
  setPageStep(1);
  connect(this, &QSlider::valueChanged, this, &TimeBar::goTo);
  connect(this, &QSlider::sliderReleased, this, [this] { session_.endGesture(); });
  connect(&timer_, &QTimer::timeout, this, &TimeBar::playNext);
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            const ViewState &was = before.view(view_), &is = after.view(view_);
            if (was.series != is.series || was.kind != is.kind || before.series.size() != after.series.size())
              showSteps();
          });
  showSteps();
}

void TimeBar::showSteps() {
  const Workspace& workspace = session_.workspace();
  const ViewState& state = workspace.view(view_);
  const std::vector<const Series*> steps = timePointsOf(workspace, state.series);
  const auto at = std::ranges::find(steps, state.series, [](const Series* s) { return keyOf(*s); });
  const QSignalBlocker quiet(this);
  setMaximum(std::max(0, int(steps.size()) - 1));
  setValue(int(at - steps.begin()));
  setToolTip(toolTipOf(hasSteps() ? timeAxisText(steps) : QString()));
  setVisible(hasSteps());
  if (!hasSteps()) timer_.stop();
  Q_EMIT stepsChanged();
}

void TimeBar::goTo(int index) {
  const Workspace& workspace = session_.workspace();
  const std::vector<const Series*> steps = timePointsOf(workspace, workspace.view(view_).series);
  if (index < 0 || index >= int(steps.size())) return;
  const QString text = tr("Time point");
  session_.change(text, withTimePoint(workspace, view_, keyOf(*steps[std::size_t(index)])), text);
}

void TimeBar::step(int steps) { goTo(std::clamp(value() + steps, 0, maximum())); }

void TimeBar::togglePlay() {
  if (timer_.isActive()) {
    timer_.stop();
    return session_.endGesture();
  }
  const Series* series = seriesIn(session_.workspace(), view_);
  if (!hasSteps() || !series) return;
  const double rate = series->cine.framesPerSecond;
  session_.endGesture();
  timer_.start(int(std::lround(1000 / (rate > 0 ? std::min(rate, 100.0) : usualRate))));
}

// Waits for what is not in memory yet: it is loaded ahead.
void TimeBar::playNext() {
  const Workspace& workspace = session_.workspace();
  const std::vector<const Series*> steps = timePointsOf(workspace, workspace.view(view_).series);
  const int next = (value() + 1) % (maximum() + 1);
  if (session_.seriesNamed(keyOf(*steps[std::size_t(next)])) && session_.seriesOf(view_)) goTo(next);
}

}  // namespace volumen
