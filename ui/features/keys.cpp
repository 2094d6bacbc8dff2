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
  const QKeySequence wanted(QKeyCombination(event.modifiers(), Qt::Key(key)));
  for (QAction* action : bench_.window.actions())
    if (action->isEnabled() && action->shortcuts().contains(wanted)) {
      action->trigger();
      return true;
    }
  return false;
}

// Handles keypad keys with and without NumLock. Under X11 shortcuts cannot distinguish them from other keys,
// and fire not at all with NumLock on.
bool Keys::triggerByKeypad(const QKeyEvent& event) {
  static const std::map<int, std::pair<const char*, const char*>> views{
      {Qt::Key_1, {"viewAnterior", "viewPosterior"}}, {Qt::Key_End, {"viewAnterior", "viewPosterior"}},
      {Qt::Key_3, {"viewLeft", "viewRight"}},         {Qt::Key_PageDown, {"viewLeft", "viewRight"}},
      {Qt::Key_7, {"viewSuperior", "viewInferior"}},  {Qt::Key_Home, {"viewSuperior", "viewInferior"}},
      {Qt::Key_0, {"resetView", "resetView"}},        {Qt::Key_Insert, {"resetView", "resetView"}}};
  const auto view = views.find(event.key());
  if (view == views.end() || !(event.modifiers() & Qt::KeypadModifier)) return false;
  const bool opposite = event.modifiers() & Qt::ControlModifier;
  bench_.action(opposite ? view->second.second : view->second.first)->trigger();
  return true;
}

}  // namespace

std::unique_ptr<Feature> makeKeys(Workbench& bench) { return std::make_unique<Keys>(bench); }

}  // namespace volumen
