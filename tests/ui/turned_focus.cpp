#include "tests/ui/turned_focus.h"

#include <QDockWidget>
#include <QMenu>
#include <algorithm>
#include <vector>

#include "ui/views/view.h"

namespace volumen::tests {

namespace {

constexpr int laidOutMs = 3000;  // until the window is laid out again

// Returns the views on screen, row by row.
std::vector<View*> viewsSeen(Journey& w) {
  std::vector<View*> all;
  for (View* view : w.window.views()->findChildren<View*>())
    if (view->isVisible()) all.push_back(view);
  std::ranges::sort(all, {}, [](const View* view) { return std::pair(view->y(), view->x()); });
  return all;
}

// Returns the view in focus once it has the keyboard focus; null if it does not get it.
View* withKeys(Journey& w) {
  w.window.views()->setFocus();
  auto* view = qobject_cast<View*>(w.window.focusWidget());
  return view && view->id() == w.window.session().workspace().focus ? view : nullptr;
}

bool hasPanels(Journey& w) {
  return std::ranges::any_of(w.window.findChildren<QDockWidget*>(), [](const QDockWidget* dock) {
    return dock->isVisible() && !dock->visibleRegion().isEmpty();
  });
}

QString wrongWithKeys(Journey& w, const std::function<QString(View*)>& press) {
  View* const view = withKeys(w);
  if (!view) return QStringLiteral("the view in focus does not get the keys");
  return press(view);
}

// Does the same for keys that must make no undo step.
QString wrongWithoutStep(Journey& w, const std::function<QString(View*)>& press) {
  const int steps = w.window.session().undoStack().index();
  const QString why = wrongWithKeys(w, press);
  const bool isStep = w.window.session().undoStack().index() != steps;
  return why.isEmpty() && isStep ? QStringLiteral("a step of undo") : why;
}

}  // namespace

QString wrongAfterTab(Journey& w, bool isBack) {
  return wrongWithoutStep(w, [&](View* view) -> QString {
    const std::vector<View*> all = viewsSeen(w);
    const auto at = std::ranges::find(all, view);
    if (at == all.end()) return QStringLiteral("the view in focus is not seen");
    const std::size_t step = isBack ? all.size() - 1 : 1;
    const View* next = all[(std::size_t(at - all.begin()) + step) % all.size()];
    QTest::keyClick(view, isBack ? Qt::Key_Backtab : Qt::Key_Tab,
                    isBack ? Qt::ShiftModifier : Qt::NoModifier);
    if (w.window.session().workspace().focus != next->id())
      return QStringLiteral("view %1 is in focus, not %2")
          .arg(w.window.session().workspace().focus)
          .arg(next->id());
    const bool hasKeys = w.window.focusWidget() == next;
    w.window.views()->setFocus();
    if (hasKeys != (all.size() > 1))
      return hasKeys ? QStringLiteral("Tab stays") : QStringLiteral("view %1 has no keys").arg(next->id());
    return {};
  });
}

QString wrongAfterParts(Journey& w) {
  return wrongWithoutStep(w, [&](View* view) -> QString {
    const ViewId focus = view->id();
    const bool hasOthers = hasPanels(w);
    QTest::keyClick(view, Qt::Key_F6);
    if (hasOthers && w.window.views()->isAncestorOf(w.window.focusWidget()))
      return QStringLiteral("F6 stays in the views");
    QTest::keyClick(w.window.focusWidget(), Qt::Key_F6, Qt::ShiftModifier);
    const bool isBack = w.window.focusWidget() == view && w.window.session().workspace().focus == focus;
    return isBack ? QString() : QStringLiteral("Shift+F6 does not lead back");
  });
}

QString wrongWhileAlone(Journey& w, bool byEscape, const std::function<QString()>& wrongAlone) {
  return wrongWithoutStep(w, [&](View* view) -> QString {
    const std::vector<View*> before = viewsSeen(w);
    const auto waitFor = [&](const std::vector<View*>& seen, const std::function<QString()>& wrong) {
      QString why;
      const auto isRight = [&] {
        why = viewsSeen(w) == seen ? wrong() : QStringLiteral("other views are seen");
        if (why.isEmpty() && w.window.focusWidget() != view) why = QStringLiteral("another has the keys");
        return why.isEmpty();
      };
      return QTest::qWaitFor(isRight, laidOutMs) ? QString() : why;
    };
    QTest::keyClick(view, Qt::Key_F10);
    if (const QString why = waitFor({view}, wrongAlone); !why.isEmpty())
      return QStringLiteral("alone: ") + why;
    QTest::keyClick(view, byEscape ? Qt::Key_Escape : Qt::Key_F10);
    const QString why = waitFor(before, [] { return QString(); });
    return why.isEmpty() ? why : QStringLiteral("no longer alone: ") + why;
  });
}

QString wrongAfterMenu(Journey& w) {
  return wrongWithoutStep(w, [&](View* view) -> QString {
    QTest::keyClick(view, Qt::Key_F10, Qt::ShiftModifier);
    QMenu* menu = nullptr;
    const auto isOpen = [&] {
      for (QMenu* m : w.window.findChildren<QMenu*>(QStringLiteral("flatMenu")))
        if (m->isVisible()) menu = m;
      return menu != nullptr;
    };
    if (!QTest::qWaitFor(isOpen, laidOutMs)) return QStringLiteral("no menu");
    menu->close();
    takeKeysBack(w);
    return w.window.focusWidget() == view ? QString() : QStringLiteral("the menu leaves the keys elsewhere");
  });
}

QString wrongAfterNumber(Journey& w, int number, bool isMeant) {
  const auto type = [&](View* view) -> QString {
    QTest::keyClick(view, Qt::Key_G);
    QWidget* const field = w.window.focusWidget();
    if (!field || field->objectName() != QStringLiteral("placeNumber") || !view->isAncestorOf(field))
      return QStringLiteral("G opens no field");
    QTest::keyClicks(field, QString::number(number));
    QTest::keyClick(field, isMeant ? Qt::Key_Return : Qt::Key_Escape);
    return w.window.focusWidget() == view ? QString() : QStringLiteral("the field leaves the keys elsewhere");
  };
  return isMeant ? wrongWithKeys(w, type) : wrongWithoutStep(w, type);
}

void takeKeysBack(Journey& w) {
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  w.window.activateWindow();
  QApplication::setActiveWindow(&w.window);
}

}  // namespace volumen::tests
