#include "ui/session/session.h"

#include "ui/session/edit_state.h"
#include "ui/session/text.h"
#include "viewer/scene/presets.h"

namespace volumen {

Session::Session(QObject* parent) : QObject(parent) {}

void Session::show(ShownSeriesPtr series) {
  undoStack_.clear();
  const SessionState before = state_;
  state_.scene = series ? series->firstScene : Scene{};
  state_.preset = series ? std::make_shared<ChosenPreset>(ChosenPreset{"auto", series->firstScene}) : nullptr;
  state_.series = std::move(series);
  endGesture();
  Q_EMIT changed(before, state_);
}

void Session::push(const QString& text, SessionState after, const QString& mergeKey) {
  if (after == state_) return;
  undoStack_.push(new EditState(*this, text, std::move(after), mergeKey, gesture_));
}

void Session::edit(const QString& text, Scene after, const QString& mergeKey) {
  SessionState state = state_;
  state.scene = std::move(after);
  push(text, std::move(state), mergeKey);
}

void Session::edit(const QString& text, const std::function<void(Scene&)>& change, const QString& mergeKey) {
  Scene after = state_.scene;
  change(after);
  edit(text, std::move(after), mergeKey);
}

void Session::exchangeSeries(const QString& text, ShownSeriesPtr after) {
  SessionState state = state_;
  state.series = std::move(after);
  push(text, std::move(state), {});
}

void Session::setGoal(const QString& text, const QualityGoal& after, const QString& mergeKey) {
  SessionState state = state_;
  state.goal = after;
  push(text, std::move(state), mergeKey);
}

void Session::choosePreset(const QString& text, const std::string& name, const Scene& look) {
  if (state_.preset && state_.preset->name == name && sameLook(state_.scene, look) && !presetModified())
    return;
  SessionState state = state_;
  state.scene = withLook(state_.scene, look);
  state.preset = std::make_shared<ChosenPreset>(ChosenPreset{name, look});
  push(text, std::move(state), {});
}

bool Session::presetModified() const {
  return state_.preset && !sameLook(state_.scene, state_.preset->scene);
}

void Session::prefer(const Preferences& preferences) {
  if (preferences == preferences_) return;
  const Preferences before = std::exchange(preferences_, preferences);
  hideNames(preferences.hideNames);
  Q_EMIT preferencesChanged(before, preferences_);
}

void Session::prefer(const std::function<void(Preferences&)>& change) {
  Preferences after = preferences_;
  change(after);
  prefer(after);
}

void Session::setState(const SessionState& state) {
  const SessionState before = state_;
  state_ = state;
  Q_EMIT changed(before, state_);
}

}  // namespace volumen
