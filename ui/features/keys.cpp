#include <QKeyEvent>

#include "ui/features/feature.h"
#include "ui/views/latin_key.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

// Handles keys that shortcuts miss: letters of other scripts by position, and the keypad.
class Keys : public Feature {
 public:
  explicit Keys(Workbench& bench) : Feature(bench) {
    bench_.window.installEventFilter(this);
    grid_.secondWindow().installEventFilter(this);
  }

  bool eventFilter(QObject* window, QEvent* event) override;

 private:
  bool trigger(const QKeySequence& shortcut);
  bool triggerByPlace(const QKeyEvent& event);
  bool triggerByKeypad(const QKeyEvent& event);
};

bool Keys::eventFilter(QObject* window, QEvent* event) {
  if (event->type() != QEvent::KeyPress) return Feature::eventFilter(window, event);
  const QWidget* focus = static_cast<QWidget*>(window)->focusWidget();
  const bool isTyping = focus && focus->testAttribute(Qt::WA_InputMethodEnabled);
  const auto& key = static_cast<const QKeyEvent&>(*event);
  return !isTyping && (triggerByPlace(key) || triggerByKeypad(key));
}

// Triggers the action whose key is at the position of a letter of another script. Qt itself handles keyboards
// that have a second, Latin layout. Returns false if there is no such action.
bool Keys::triggerByPlace(const QKeyEvent& event) {
  const int key = latinKey(event);
  if (key == event.key()) return false;
  return trigger(QKeyCombination(event.modifiers(), Qt::Key(key)));
}

// Returns false if no enabled action has the shortcut.
bool Keys::trigger(const QKeySequence& shortcut) {
  for (QAction* action : bench_.window.actions())
    if (action->isEnabled() && action->shortcuts().contains(shortcut)) {
      action->trigger();
      return true;
    }
  return false;
}

// Handles keypad keys with and without NumLock. Under X11 shortcuts cannot distinguish them from other keys,
// and fire not at all with NumLock on.
bool Keys::triggerByKeypad(const QKeyEvent& event) {
  // Each key stands for the letter of a standard view; with Ctrl, for that of the opposite view.
  static const std::map<int, std::pair<Qt::Key, Qt::Key>> views{
      {Qt::Key_1, {Qt::Key_A, Qt::Key_P}}, {Qt::Key_End, {Qt::Key_A, Qt::Key_P}},
      {Qt::Key_3, {Qt::Key_L, Qt::Key_R}}, {Qt::Key_PageDown, {Qt::Key_L, Qt::Key_R}},
      {Qt::Key_7, {Qt::Key_S, Qt::Key_I}}, {Qt::Key_Home, {Qt::Key_S, Qt::Key_I}},
      {Qt::Key_0, {Qt::Key_F, Qt::Key_F}}, {Qt::Key_Insert, {Qt::Key_F, Qt::Key_F}}};
  const auto view = views.find(event.key());
  if (view == views.end() || !(event.modifiers() & Qt::KeypadModifier)) return false;
  const bool opposite = event.modifiers() & Qt::ControlModifier;
  trigger(opposite ? view->second.second : view->second.first);
  return true;
}

}  // namespace

std::unique_ptr<Feature> makeKeys(Workbench& bench) { return std::make_unique<Keys>(bench); }

}  // namespace volumen
