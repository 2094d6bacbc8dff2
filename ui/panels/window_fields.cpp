#include "ui/panels/window_fields.h"

#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <cmath>

#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/windows.h"

namespace volumen {

WindowFields::WindowFields(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      choices_(new QComboBox),
      centre_(makeField(QStringLiteral("windowCentre"), tr("Centre"))),
      width_(makeField(QStringLiteral("windowWidth"), tr("Width"))),
      inverted_(new QCheckBox(tr("Inverted"))) {
  choices_->setObjectName(QStringLiteral("windowChoice"));
  choices_->setAccessibleName(tr("Window"));
  choices_->setToolTip(tr("Width / centre"));
  choices_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  choices_->setMinimumContentsLength(12);
  inverted_->setObjectName(QStringLiteral("windowInverted"));
  inverted_->setToolTip(tr("Large values dark"));
  width_->setMinimum(1e-9);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  grid->setColumnStretch(1, 1);
  const auto add = [&](const QString& label, QWidget* field, int row) {
    auto* caption = plainLabel(label);
    caption->setBuddy(field);
    grid->addWidget(caption, row, 0);
    grid->addWidget(field, row, 1);
  };
  add(tr("Window"), choices_, 0);
  add(tr("Centre"), centre_, 1);
  add(tr("Width"), width_, 2);
  grid->addWidget(inverted_, 3, 0, 1, 2);
  connect(choices_, &QComboBox::activated, this, [this](int n) {
    setWindow(windowChoices(*session_.series(), session_.preferences().windows)[std::size_t(n)].window);
    session_.endGesture();
  });
  for (QDoubleSpinBox* field : {centre_, width_}) {
    connect(field, &QDoubleSpinBox::valueChanged, this, &WindowFields::typed);
    connect(field, &QDoubleSpinBox::editingFinished, this, [this] { session_.endGesture(); });
  }
  connect(inverted_, &QCheckBox::clicked, this, [this] {
    typed();
    session_.endGesture();
  });
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series != after.series) fillChoices();
    if (before.series != after.series || before.scene.window != after.scene.window ||
        before.preset != after.preset)
      showWindow();
  });
  connect(&session_, &Session::preferencesChanged, this,
          [this](const Preferences& before, const Preferences& after) {
            if (before.petUnit == after.petUnit && before.windows == after.windows) return;
            fillChoices();
            showWindow();
          });
  fillChoices();
  showWindow();
}

QDoubleSpinBox* WindowFields::makeField(const QString& name, const QString& label) {
  auto* field = new QDoubleSpinBox;
  field->setObjectName(name);
  field->setAccessibleName(label);
  field->setRange(-1e9, 1e9);
  field->setKeyboardTracking(false);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setMinimumWidth(64);
  return field;
}

void WindowFields::fillChoices() {
  choices_->clear();
  setEnabled(session_.series() != nullptr);
  if (!session_.series()) return;
  const LoadedSeries& series = *session_.series();
  for (const NamedWindow& choice : windowChoices(series, session_.preferences().windows))
    choices_->addItem(choice.name);
  for (QDoubleSpinBox* field : {centre_, width_}) {
    const QSignalBlocker quiet(field);
    field->setSuffix(unitSuffix(series.series));
    field->setDecimals(valueDecimals(series));
  }
}

void WindowFields::showWindow() {
  if (!session_.series()) return;
  const std::optional<Window>& own = session_.scene().window;
  const Series& series = session_.series()->series;
  const Window window = shownWindow(windowInUse(session_.scene(), *session_.series()), series);
  const QSignalBlocker quietCentre(centre_), quietWidth(width_);
  centre_->setValue(window.centre);
  width_->setValue(std::abs(window.width));
  inverted_->setChecked(window.width < 0);
  const std::vector<NamedWindow> choices = windowChoices(*session_.series(), session_.preferences().windows);
  const auto found = std::find_if(choices.begin(), choices.end(),
                                  [&](const NamedWindow& choice) { return choice.window == own; });
  choices_->setCurrentIndex(found == choices.end() ? -1 : int(found - choices.begin()));
  const auto& preset = session_.state().preset;
  choices_->setPlaceholderText(preset && preset->scene.window == own ? tr("of the preset") : tr("as set"));
}

void WindowFields::setWindow(const std::optional<Window>& window) {
  const QString what = tr("Window");
  session_.edit(
      what, [&](Scene& s) { s.window = window; }, what);
}

void WindowFields::typed() {
  if (!session_.series()) return;
  const double width = std::max(width_->value(), 1e-9);
  setWindow(
      storedWindow({centre_->value(), inverted_->isChecked() ? -width : width}, session_.series()->series));
}

}  // namespace volumen
