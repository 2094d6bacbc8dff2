#include "ui/session/session.h"

#include "ui/session/edit_scene.h"

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

void Session::edit(const QString& text, Scene after, const QString& mergeKey) {
  if (after == state_.scene) return;
  undoStack_.push(new EditScene(*this, text, std::move(after), mergeKey, gesture_));
}

void Session::edit(const QString& text, const std::function<void(Scene&)>& change, const QString& mergeKey) {
  Scene after = state_.scene;
  change(after);
  edit(text, std::move(after), mergeKey);
}

void Session::setScene(const Scene& scene) {
  const SessionState before = state_;
  state_.scene = scene;
  Q_EMIT changed(before, state_);
}

}  // namespace volumen
