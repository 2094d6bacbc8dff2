#include "ui/views/cine_bar.h"

#include <QApplication>
#include <QMouseEvent>
#include <QSignalBlocker>
#include <algorithm>
#include <initializer_list>
#include <optional>
#include <utility>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr int restMs = 300;  // time the pointer rests at the edge
constexpr double usualRates[] = {1, 2, 3, 5, 7, 10, 15, 20, 25, 30, 40, 50, 60, 80, 100};

// Least width for each group of controls, logical pixels.
constexpr int widthForNumber = 195, widthForWays = 255, widthForRate = 360, widthForRange = 520;

// Returns the first number between two positions; 0 if there is none.
int numberOnTheWay(const Stack& stack, int from, int to) {
  const int step = from <= to ? 1 : -1;
  for (int place = from; place != to; place += step)
    if (const int number = stack.numberOf(place)) return number;
  return stack.numberOf(to);
}

}  // namespace

CineBar::CineBar(Session& session, ViewId view, std::function<bool()> isDrawn, QWidget* parent)
    : QWidget(parent), session_(session), view_(view), steps_(session.undoStack().index()) {
  auto time = std::make_unique<PlayedTimePoints>(session, view, std::move(isDrawn));
  time_ = time.get();
  all_.push_back(std::move(time));
  setObjectName(QStringLiteral("cineBar%1").arg(view));
  setAccessibleName(tr("Cine"));
  setAttribute(Qt::WA_StyledBackground);
  // The colours are the same in both themes because the bar lies on the picture.
  setStyleSheet(
      QStringLiteral("#%1 { background: rgba(27,30,34,210); }"
                     "#%1 QToolButton, #%1 QLineEdit { color: #d7dce2; background: transparent; border: 1px "
                     "solid #3c434c; border-radius: 2px; padding: 0 2px; }"
                     "#%1 QToolButton:checked { background: #2b6cb0; color: white; }"
                     "#%1 QToolButton:hover, #%1 QToolButton:focus, #%1 QLineEdit:focus { border-color: "
                     "#4aa3ff; }")
          .arg(objectName()));
  makeControls();
  connectControls();
  pointedSoon_.setSingleShot(true);
  pointedSoon_.setInterval(restMs);
  connect(&pointedSoon_, &QTimer::timeout, this, [this] {
    isPointedAt_ = true;
    look();
  });
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            const ViewState &was = before.view(view_), &is = after.view(view_);
            if (was.series != is.series || was.kind != is.kind || before.series.size() != after.series.size())
              time_->look();
            if (isOvertaken(before, after)) giveUp();
            look();
          });
  connect(&session_.undoStack(), &QUndoStack::indexChanged, this, &CineBar::seeSteps);
  connect(qApp, &QApplication::focusChanged, this, [this](const QWidget* was, QWidget* now) {
    if (isAncestorOf(was)) look();
    if (isAncestorOf(now)) takeFocus(now);
  });
  hide();
  look();
}

// Fields lose their focus after the bar is destroyed.
CineBar::~CineBar() { disconnect(qApp, nullptr, this, nullptr); }

void CineBar::add(std::unique_ptr<Playable> what, bool before) {
  all_.insert(before ? all_.begin() : all_.end(), std::move(what));
  look();
}

// Returns what is played: the user's choice, else clips first. Null if nothing can be played.
Playable* CineBar::current() const {
  if (chosen_ && isThere(*chosen_)) return chosen_;
  Playable* first = nullptr;
  for (const auto& what : all_) {
    if (!isThere(*what)) continue;
    if (what->isClip()) return what.get();
    if (!first) first = what.get();
  }
  return first;
}

void CineBar::endPlayer() {
  if (CinePlayer* last = std::exchange(player_, nullptr)) last->end();
}

void CineBar::goTo(int place) {
  Playable* what = current();
  if (!what) return;
  stop();
  what->goTo(std::clamp(place, 0, what->stack().place.count - 1));
}

void CineBar::togglePlay() {
  if (player_) return stop();
  Playable* what = current();
  if (!what) return;
  session_.endGesture();
  played_ = what;
  played_->begin(steps_);
  player_ = new CinePlayer(*what, round_);
  player_->setParent(this);
  connect(player_, &CinePlayer::over, this, &CineBar::stop);
  look();
}

// Playback is one undo step, however long it lasted.
void CineBar::stop() {
  if (!player_) return;
  endPlayer();
  played_->stop();
  session_.endGesture();
  look();
}

// The view takes the focus with its field. The keys given to the view go back to the field.
void CineBar::takeFocus(QWidget* field) {
  if (session_.workspace().focus == view_) return;
  session_.setFocus(view_);
  field->setFocus(Qt::TabFocusReason);
}

// The position stays, and the change that interrupted playback continues in its gesture.
void CineBar::giveUp() {
  if (!player_) return;
  endPlayer();
  played_->giveUp();
}

// Returns whether something other than the player changed the position or the plane that is played. Other
// changes do not stop it. A clip writes its position only at its end.
bool CineBar::isOvertaken(const Workspace& before, const Workspace& after) const {
  if (!player_ || player_->isGoing()) return false;
  if (played_->keepsTime())
    return flatLookOf(before.view(view_)).frame != flatLookOf(after.view(view_)).frame;
  return before.view(view_).kind != after.view(view_).kind || !player_->isWhereItWent();
}

// Undo ends playback, because further playback would discard the redo steps. A step that cancelled itself was
// removed without an undo.
void CineBar::seeSteps(int steps) {
  const bool isUndone = std::exchange(steps_, steps) > steps && session_.undoStack().canRedo();
  if (!isUndone || !player_ || player_->isGoing() || played_->keepsTime()) return;
  giveUp();
  look();
}

void CineBar::tellShown(int place) {
  if (player_) player_->tellShown(place);
  look();
}

bool CineBar::stepTime(int steps) {
  if (!isThere(*time_)) return false;
  stop();
  const StackPlace now = time_->stack().place;
  time_->goTo(std::clamp(now.index + steps, 0, now.count - 1));
  return true;
}

bool CineBar::stepRate(int up) {
  if (isHidden() || !current()) return false;
  CineRound round = round_;
  std::optional<double> next;  // the nearest on that side
  for (const double rate : usualRates)
    if (up > 0 ? !next && rate > round.rate * 1.001 : rate < round.rate * 0.999) next = rate;
  round.rate = next.value_or(round.rate);
  setRound(round);
  return true;
}

void CineBar::setRound(const CineRound& round) {
  round_ = round;
  if (player_) player_->setRound(round);
  look();
}

void CineBar::look() {
  Playable* what = current();
  if (player_ && what != played_) giveUp();
  const Stack stack = what ? what->stack() : Stack();
  const std::pair source(what ? what->source() : SeriesKey{}, stack.place.count);
  if (what && std::exchange(roundOf_, source) != source) {
    endPlayer();
    const Cine cine = what->cine();
    round_ = {0, stack.place.count - 1, cine.backAndForth, true, cineRate(cine)};
  }
  if (what) {
    showNumbers(stack, what->axis());
    showChoices(stack.noun);
  }
  const bool isUsed = isAncestorOf(window()->focusWidget());
  setShown(what && (player_ || what->isClip() || isThere(*time_) || isPointedAt_ || isUsed));
}

void CineBar::showNumbers(const Stack& stack, const QString& axis) {
  const QSignalBlocker quiet(place_);
  place_->setMaximum(stack.place.count - 1);
  place_->setValue(stack.place.index);
  if (place_->accessibleName() != stack.noun) place_->setAccessibleName(stack.noun);
  const QStringList said{stack.noun, axis};
  if (place_->toolTip() != toolTipOf(said)) place_->setToolTip(toolTipOf(said));
  number_->setNumber(stack.number, 1, stack.numberCount);
  const int first = numberOnTheWay(stack, round_.first, round_.last),
            last = numberOnTheWay(stack, round_.last, round_.first);
  const auto show = [](TypedNumber* field, int number, std::pair<int, int> limits) {
    field->setNumber(number, std::min(limits.first, limits.second), std::max(limits.first, limits.second));
  };
  show(first_, first, {numberOnTheWay(stack, 0, round_.last), last});
  show(last_, last, {first, numberOnTheWay(stack, stack.place.count - 1, round_.first)});
  rate_->setNumber(round_.rate, std::min(leastRate, round_.rate), mostRate, 2);
  makeRoom();
}

void CineBar::showChoices(const QString& noun) {
  for (const auto& [button, on] : {std::pair(back_, round_.backAndForth), std::pair(loop_, round_.loops)}) {
    const QSignalBlocker quiet(button);
    button->setChecked(on);
  }
  play_->setText(player_ ? QStringLiteral("\u25a0") : QStringLiteral("\u25b6"));
  what_->setVisible(std::ranges::count_if(all_, [](const auto& what) { return isThere(*what); }) > 1);
  what_->setText(noun);
}

void CineBar::setShown(bool wanted) {
  if (wanted != isHidden()) return;
  setVisible(wanted);
  Q_EMIT shownChanged();
}

void CineBar::pointAtEdge(bool isThere) {
  if (isThere && isHidden() && current()) {
    if (!pointedSoon_.isActive()) pointedSoon_.start();
    return;
  }
  pointedSoon_.stop();
  if (!isThere && std::exchange(isPointedAt_, false)) look();
}

void CineBar::leaveEvent(QEvent* event) {
  QWidget::leaveEvent(event);
  pointAtEdge(false);
}

void CineBar::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  makeRoom();
}

// Hides the least important controls first.
void CineBar::makeRoom() {
  number_->setVisible(width() >= widthForNumber);
  for (QToolButton* way : {back_, loop_}) way->setVisible(width() >= widthForWays);
  for (QWidget* rate : std::initializer_list<QWidget*>{rate_, aSecond_})
    rate->setVisible(width() >= widthForRate);
  for (QWidget* range : std::initializer_list<QWidget*>{from_, first_, to_, last_})
    range->setVisible(width() >= widthForRange);
}

// Presses do not reach the view under the bar.
void CineBar::mousePressEvent(QMouseEvent* event) { event->accept(); }

}  // namespace volumen
