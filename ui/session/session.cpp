#include "ui/session/session.h"

#include "ui/session/edit_state.h"

namespace volumen {

Session::Session(QObject* parent) : QObject(parent) {}

void Session::show(ShownSeriesPtr series) {
  undoStack_.clear();
  const SessionState before = state_;
  state_.scene = series ? series->firstScene : Scene{};
  state_.series = std::move(series);
  endGesture();
  Q_EMIT changed(before, state_);
}

void Session::push(const QString& text, SessionState after, const QString& mergeKey) {
  if (after == state_) return;
  undoStack_.push(new EditState(*this, text, std::move(after), mergeKey, gesture_));
}

void Session::edit(const QString& text, Scene after, const QString& mergeKey) {
  push(text, {state_.series, std::move(after), state_.wish}, mergeKey);
}

void Session::edit(const QString& text, const std::function<void(Scene&)>& change, const QString& mergeKey) {
  Scene after = state_.scene;
  change(after);
  edit(text, std::move(after), mergeKey);
}

void Session::exchangeSeries(const QString& text, ShownSeriesPtr after) {
  push(text, {std::move(after), state_.scene, state_.wish}, {});
}

void Session::wishFor(const QString& text, const PictureWish& after, const QString& mergeKey) {
  push(text, {state_.series, state_.scene, after}, mergeKey);
}

void Session::setState(const SessionState& state) {
  const SessionState before = state_;
  state_ = state;
  Q_EMIT changed(before, state_);
}

}  // namespace volumen
