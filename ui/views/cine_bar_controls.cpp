#include <QHBoxLayout>
#include <QToolTip>

#include "ui/views/cine_bar.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

QToolButton* CineBar::addButton(const char* name, const QString& text, const QString& tip, bool checkable) {
  auto* button = new QToolButton(this);
  button->setObjectName(QLatin1String(name));
  button->setText(text);
  button->setToolTip(toolTipOf(tip));
  button->setAccessibleName(tip);
  button->setCheckable(checkable);
  button->setFocusPolicy(Qt::TabFocus);
  button->setFixedHeight(barHeight - 2);
  layout()->addWidget(button);
  return button;
}

TypedNumber* CineBar::addNumber(const char* name, const QString& tip, const QString& widest) {
  auto* field = new TypedNumber(name, tip, this);
  constexpr int margins = 12;
  field->setFixedSize(field->fontMetrics().horizontalAdvance(widest) + margins, barHeight - 2);
  field->setFrame(false);
  layout()->addWidget(field);
  const auto giveKeysBack = [this] { parentWidget()->setFocus(); };
  connect(field, &TypedNumber::typed, this, giveKeysBack);
  connect(field, &TypedNumber::givenUp, this, giveKeysBack);
  connect(field, &TypedNumber::refused, this, [field](const QString& why) { refuse(*field, why); });
  return field;
}

QLabel* CineBar::addWord(const QString& word) {
  QLabel* label = plainLabel(word);
  layout()->addWidget(label);
  return label;
}

void CineBar::makeControls() {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(4, 1, 12, 1);  // leaves room for the stack bar
  row->setSpacing(3);
  row->setSizeConstraint(QLayout::SetNoConstraint);
  play_ = addButton("cinePlay", QStringLiteral("\u25b6"), tr("Play or stop (C)"), false);
  what_ = addButton("cineWhat", {}, tr("What is played"), false);
  place_ = new QSlider(Qt::Horizontal, this);
  place_->setObjectName(QStringLiteral("cinePlace"));
  place_->setFocusPolicy(Qt::NoFocus);  // the view has keys for it
  place_->setMaximum(0);
  place_->setPageStep(1);
  row->addWidget(place_, 1);
  number_ = addNumber("cineNumber", tr("Number shown"), QStringLiteral("0000"));
  from_ = addWord(tr("from"));
  first_ = addNumber("cineFirst", tr("First one played"), QStringLiteral("0000"));
  to_ = addWord(tr("to"));
  last_ = addNumber("cineLast", tr("Last one played"), QStringLiteral("0000"));
  rate_ = addNumber("cineRate", tr("Speed, a second (+ and -)"), QStringLiteral("00.00"));
  aSecond_ = addWord(tr("/s"));
  back_ = addButton("cineBack", QStringLiteral("\u21c4"), tr("Back and forth"), true);
  loop_ = addButton("cineLoop", QStringLiteral("\u21bb"), tr("Again and again"), true);
}

void CineBar::connectControls() {
  connect(play_, &QToolButton::clicked, this, [this] {
    session_.setFocus(view_);  // focus makes the view load ahead
    togglePlay();
  });
  connect(what_, &QToolButton::clicked, this, [this] {
    stop();
    const Playable* now = current();
    for (const auto& other : all_)
      if (other.get() != now && isThere(*other)) chosen_ = other.get();
    look();
  });
  connect(place_, &QSlider::valueChanged, this, &CineBar::goTo);
  connect(place_, &QSlider::sliderPressed, this, [this] { session_.endGesture(); });
  connect(place_, &QSlider::sliderReleased, this, [this] { session_.endGesture(); });
  const auto whenTyped = [this](TypedNumber* field, auto use) {
    connect(field, &TypedNumber::typed, this, [this, field, use](double number) {
      if (const std::optional<int> place = placeTyped(*field, int(number))) use(*place);
    });
  };
  whenTyped(number_, [this](int place) {
    session_.endGesture();
    goTo(place);
    session_.endGesture();
  });
  const auto change = [this](auto edit) {
    return [this, edit](auto value) {
      CineRound round = round_;
      edit(round, value);
      setRound(round);
    };
  };
  whenTyped(first_, change([](CineRound& r, int place) { r.first = place; }));
  whenTyped(last_, change([](CineRound& r, int place) { r.last = place; }));
  connect(rate_, &TypedNumber::typed, this, change([](CineRound& r, double n) { r.rate = n; }));
  connect(back_, &QToolButton::toggled, this, change([](CineRound& r, bool on) { r.backAndForth = on; }));
  connect(loop_, &QToolButton::toggled, this, change([](CineRound& r, bool on) { r.loops = on; }));
}

// Returns the position of a number. If it has none, reports that at the field and restores its content.
std::optional<int> CineBar::placeTyped(const TypedNumber& field, int number) {
  const Playable* what = current();
  const Stack stack = what ? what->stack() : Stack();
  const std::optional<int> place = what ? stack.placeOf(number) : std::nullopt;
  if (what && !place) refuse(field, tr("%1 %2 is not in the volume.").arg(stack.noun).arg(number));
  if (!place) look();
  return place;
}

void CineBar::refuse(const TypedNumber& field, const QString& why) {
  QToolTip::showText(field.mapToGlobal(QPoint(0, -2 * barHeight)), toolTipOf(why));
}

}  // namespace volumen
