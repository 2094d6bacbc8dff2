#include <QKeyEvent>

#include "ui/features/feature.h"
#include "ui/views/latin_key.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

// Keys that no shortcut hears: letters of other scripts by their places, and the keypad.
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

// The action whose key lies where a letter of another script was pressed: Qt itself finds those that a
// second, Latin layout of the keyboard has. True: there is one.
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

// The keypad's keys as they come with and without NumLock. Under X11 no shortcut can tell them from the keys
// of the other blocks, and with NumLock on none fires at all.
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
