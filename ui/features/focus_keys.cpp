#include <QDockWidget>
#include <QSplitter>
#include <QStackedWidget>
#include <algorithm>

#include "ui/features/feature.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

bool takesKeys(const QWidget* widget) {
  return widget->isVisible() && widget->isEnabled() && widget->focusPolicy() & Qt::TabFocus;
}

// Returns the field in `part` that takes the keys: the last one that had them, else the first. Null if none.
QWidget* fieldIn(QWidget* part) {
  QWidget* last = part->focusWidget();
  if (last && last != part && part->isAncestorOf(last) && takesKeys(last)) return last;
  for (QWidget* next = part->nextInFocusChain(); next != part; next = next->nextInFocusChain())
    if (part->isAncestorOf(next) && takesKeys(next)) return next;
  return nullptr;
}

// F6 and Shift+F6 cycle through the views, study list, visible panels and views of the second window.
class FocusKeys : public Feature {
 public:
  explicit FocusKeys(Workbench& bench);

 private:
  std::vector<QWidget*> parts() const;
  void go(int step);
};

FocusKeys::FocusKeys(Workbench& bench) : Feature(bench) {
  bench_.addAction(
      {"nextPart", tr("Next part of the window"), {tr("F6")}, "", false, [this](bool) { go(1); }});
  bench_.addAction(
      {"previousPart", tr("Previous part of the window"), {tr("Shift+F6")}, "", false, [this](bool) {
         go(-1);
       }});
}

std::vector<QWidget*> FocusKeys::parts() const {
  std::vector<QWidget*> all;
  for (int n = 0; n < bench_.split.count(); ++n) {
    QWidget* part = bench_.split.widget(n);
    if (part->isVisible()) all.push_back(part);
  }
  std::vector<QWidget*> docks;
  for (const auto& [name, dock] : bench_.docks)
    if (dock.widget->isVisible() && !dock.widget->visibleRegion().isEmpty()) docks.push_back(dock.widget);
  std::ranges::stable_sort(docks, {}, [this](const QWidget* dock) {
    const QPoint at = dock->mapTo(&bench_.window, QPoint(0, 0));
    return std::pair(at.x(), at.y());
  });
  all.insert(all.end(), docks.begin(), docks.end());
  if (grid_.secondWindow().isVisible()) all.push_back(&grid_.secondWindow());
  return all;
}

void FocusKeys::go(int step) {
  const std::vector<QWidget*> all = parts();
  const bool inSecond = grid_.secondWindow().isActiveWindow();
  const QWidget* now = inSecond ? grid_.secondWindow().focusWidget() : bench_.window.focusWidget();
  const auto at =
      std::ranges::find_if(all, [&](const QWidget* part) { return now && part->isAncestorOf(now); });
  const int count = int(all.size());
  const int from = at == all.end() ? (step > 0 ? -1 : 0) : int(at - all.begin());
  for (int n = 1; n <= count; ++n) {
    QWidget* part = all[std::size_t(((from + n * step) % count + count) % count)];
    const bool isSecond = part == &grid_.secondWindow();
    const bool isViews = part == &bench_.pages && bench_.pages.currentWidget() == &grid_;
    View* view = isSecond || isViews ? grid_.viewShownIn(isSecond) : nullptr;
    QWidget* field = view ? view : fieldIn(part);
    if (!field) continue;
    if (view && isSecond != isInSecond(session_.workspace().focus)) session_.setFocus(view->id());
    field->window()->activateWindow();
    return field->setFocus(Qt::ShortcutFocusReason);
  }
}

}  // namespace

std::unique_ptr<Feature> makeFocusKeys(Workbench& bench) { return std::make_unique<FocusKeys>(bench); }

}  // namespace volumen
