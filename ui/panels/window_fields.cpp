#include "ui/panels/window_fields.h"

#include <algorithm>
#include <cmath>

#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/when_changed.h"
#include "ui/workspace/windows.h"

namespace volumen {

WindowFields::WindowFields(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      choices_(choiceField({QStringLiteral("windowChoice"), tr("Window"), tr("Width / centre")}, {}, 12)),
      values_(new ValueFields(QStringLiteral("window"), ValueFields::Which::centreAndWidth)),
      inverted_(flagField({QStringLiteral("windowInverted"), tr("Inverted"), tr("Large values dark")})) {
  stack(this, {lineOf({captionOf(tr("Window"), choices_), {choices_, 1}}, 8), values_, inverted_});
  connect(choices_, &QComboBox::activated, this, [this](int n) {
    setWindow(windowChoices(*session_.series(), session_.preferences().windows)[std::size_t(n)].window);
    session_.endGesture();
  });
  connect(values_, &ValueFields::edited, this, [this](WindowEnds ends) { setWindow(windowBetween(ends)); });
  connect(values_, &ValueFields::gestureFinished, &session_, &Session::endGesture);
  connect(inverted_, &QCheckBox::clicked, this, [this] {
    Window window = windowInUse(session_.scene(), *session_.series());
    window.width = -window.width;
    setWindow(window);
    session_.endGesture();
  });
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series != after.series || before.scene.window != after.scene.window ||
        before.preset != after.preset)
      showWindow();
  });
  whenChanged(session_, this, &WindowFields::showWindow, &Preferences::petUnit, &Preferences::windows);
  showWindow();
}

void WindowFields::showWindow() {
  setEnabled(session_.series() != nullptr);
  if (!session_.series()) return choices_->clear();
  const LoadedSeries& series = *session_.series();
  const std::optional<Window>& own = session_.scene().window;
  const Window window = windowInUse(session_.scene(), series);
  values_->setWindow(window, series.series, valueDecimals(series));
  inverted_->setChecked(window.width < 0);
  const std::vector<NamedWindow> choices = windowChoices(series, session_.preferences().windows);
  QStringList names;
  for (const NamedWindow& choice : choices) names << choice.name;
  setItems(choices_, names);
  const auto chosen = std::ranges::find(choices, own, &NamedWindow::window);
  choices_->setCurrentIndex(chosen == choices.end() ? -1 : int(chosen - choices.begin()));
  const auto& preset = session_.state().preset;
  choices_->setPlaceholderText(preset && preset->scene.window == own ? tr("of the preset") : tr("as set"));
}

void WindowFields::setWindow(const std::optional<Window>& window) {
  const QString what = tr("Window");
  session_.edit(
      what, [&](Scene& s) { s.window = window; }, what);
}

}  // namespace volumen
