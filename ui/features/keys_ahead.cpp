#include <QApplication>
#include <QKeyEvent>
#include <algorithm>
#include <optional>

#include "results/series/time_points.h"
#include "ui/features/feature.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

// Remembers a window chosen by a digit key while a series is being loaded and applies it afterwards.
class KeysAhead : public Feature {
 public:
  explicit KeysAhead(Workbench& bench);

  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  void begin();
  void end();
  bool isAwaited() const;
  void give();

  std::optional<Qt::KeyboardModifiers> ctrl_;  // modifiers of the digit; empty if none was pressed
  int digit_ = 0;                              // the last digit pressed, valid if ctrl_ is set
  bool isListening_ = false;
};

KeysAhead::KeysAhead(Workbench& bench) : Feature(bench) {
  Loader& loader = bench_.document.loader;
  connect(&loader, &Loader::openBegan, this, &KeysAhead::begin);
  connect(&loader, &Loader::loadingChanged, this, [this] {
    if (bench_.document.loader.isLoading()) begin();
  });
  for (const auto ended : {&Loader::idle, &Loader::loadingChanged})
    connect(&loader, ended, this, &KeysAhead::end, Qt::QueuedConnection);
  connect(&session_, &Session::workspaceChanged, this, &KeysAhead::give, Qt::QueuedConnection);
  bench_.window.setFocus();  // otherwise the first input field would get the focus
}

void KeysAhead::begin() {
  if (std::exchange(isListening_, true)) return;
  ctrl_.reset();
  qApp->installEventFilter(this);
}

void KeysAhead::end() {
  if (bench_.document.loader.isOpening()) return;
  isListening_ = false;
  qApp->removeEventFilter(this);
  give();
}

// Returns whether the series being loaded will replace the one in focus. Overlays and other time points do
// not.
bool KeysAhead::isAwaited() const {
  const Workspace& workspace = session_.workspace();
  const std::vector<ViewId> views = viewsOnScreen(workspace);
  const auto isEmpty = [&](ViewId id) { return workspace.view(id).series.empty(); };
  if (std::ranges::all_of(views, isEmpty)) return bench_.document.loader.isOpening();
  const std::shared_ptr<const Series> series = bench_.document.loader.loading();
  if (!series) return false;
  const auto isOver = [&](ViewId id) { return flatLookOf(workspace.view(id)).overlay == keyOf(*series); };
  const Series* shown = seriesIn(workspace, workspace.focus);
  return std::ranges::none_of(views, isOver) && !(shown && areTimePoints(*shown, *series));
}

// Ignores windows, as they receive each key before their widgets do.
bool KeysAhead::eventFilter(QObject* object, QEvent* event) {
  const auto* widget = event->type() == QEvent::KeyPress ? qobject_cast<QWidget*>(object) : nullptr;
  if (!widget || widget->testAttribute(Qt::WA_InputMethodEnabled)) return false;
  if (widget->window() != &bench_.window && widget->window() != &grid_.secondWindow()) return false;
  const auto& key = static_cast<const QKeyEvent&>(*event);
  const bool isDigit = key.key() >= Qt::Key_0 && key.key() <= Qt::Key_9;
  const bool isPlain = key.modifiers() == Qt::NoModifier || key.modifiers() == Qt::ControlModifier;
  if (!isDigit || !isPlain || !isAwaited()) return false;
  digit_ = key.key();
  ctrl_ = key.modifiers();
  return true;
}

void KeysAhead::give() {
  FlatView* view = ctrl_ && !isAwaited() ? bench_.flatViewInFocus() : nullptr;
  if (!view) return;
  if (!view->shown()) {
    connect(view, &FlatView::settled, this, &KeysAhead::give, Qt::UniqueConnection);
    return;
  }
  QKeyEvent press(QEvent::KeyPress, digit_, *std::exchange(ctrl_, {}));
  QCoreApplication::sendEvent(view, &press);
}

}  // namespace

std::unique_ptr<Feature> makeKeysAhead(Workbench& bench) { return std::make_unique<KeysAhead>(bench); }

}  // namespace volumen
