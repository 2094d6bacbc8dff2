#pragma once

#include <QAction>
#include <QApplication>
#include <QFileDialog>
#include <QMenu>
#include <QMenuBar>
#include <QTest>
#include <QTimer>
#include <QToolBar>
#include <QToolButton>

#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"

namespace volumen::tests {

/// Acts as a user's hands do in a window, by real events, and counts the steps. A click, a double click, a
/// key with its modifiers, a drag and a drop are one step each. So are a turn of the wheel, a text with Enter
/// and a move with a key held.
class Hand {
 public:
  explicit Hand(QWidget& window) : window_(window) {}

  int steps() const { return steps_; }

  /// Presses a key in the widget that has the keyboard focus.
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
    ++steps_;
    QWidget* focus = QApplication::focusWidget();
    QTest::keyClick(focus && focus->isVisible() ? focus : &window_, key, modifiers);
  }
  /// Presses a key in a dialog, which has the keyboard focus once it is open.
  void keyOn(QWidget* dialog, Qt::Key key) {
    ++steps_;
    QTest::keyClick(dialog, key);
  }
  /// Replaces the text of the focused field and presses Enter.
  void type(const QString& text) {
    ++steps_;
    QWidget* field = QApplication::focusWidget();
    QVERIFY2(field, "no field has the keyboard");
    QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }
  /// Enters a path in the open file dialog and presses Enter.
  void answer(const QString& path) {
    ++steps_;
    for (QFileDialog* open : window_.findChildren<QFileDialog*>())
      if (open->isVisible()) return acceptFile(*open, path);
    QFAIL("no file dialog is open");
  }
  void click(QWidget* on, QPointF at, Qt::KeyboardModifiers modifiers = {},
             Qt::MouseButton button = Qt::LeftButton) {
    ++steps_;
    QTest::mouseClick(on, button, modifiers, at.toPoint());
  }
  void click(QWidget* on) { click(on, QPointF(on->rect().center())); }
  void drag(QWidget* on, QPointF from, QPointF to, Qt::KeyboardModifiers modifiers = {}) {
    ++steps_;
    tests::drag(on, from, to, Qt::LeftButton, modifiers);
  }
  void wheel(QWidget* on, int notches, Qt::KeyboardModifiers modifiers = {}) {
    ++steps_;
    tests::wheel(on, notches, modifiers);
  }
  void moveHolding(Qt::KeyboardModifiers keys, QWidget* on, QPointF to) {
    ++steps_;
    QMouseEvent move(QEvent::MouseMove, to, on->mapToGlobal(to), Qt::NoButton, Qt::NoButton, keys);
    QCoreApplication::sendEvent(on, &move);
  }
  void drop(const QMimeData& what, QWidget* on) {
    ++steps_;
    QVERIFY2(tests::drop(what, on), "it is not taken");
  }
  /// Clicks the button of an action in the tool bar.
  void button(const char* action) {
    auto* bar = window_.findChild<QToolBar*>(QStringLiteral("tools"));
    QWidget* shown = bar->widgetForAction(window_.findChild<QAction*>(QLatin1String(action)));
    QVERIFY2(shown && shown->isVisible(), action);
    click(shown);
  }
  /// Clicks through menus, starting in the menu bar, to the entry with this object name.
  void menu(const QList<const char*>& menus, const char* entry) {
    auto* bar = window_.findChild<QMenuBar*>();
    QMenu* open = window_.findChild<QMenu*>(QLatin1String(menus.first()));
    QVERIFY2(open, menus.first());
    click(bar, bar->actionGeometry(open->menuAction()).center());
    for (qsizetype n = 1; n < menus.size(); ++n) {
      auto* next = window_.findChild<QMenu*>(QLatin1String(menus[n]));
      QVERIFY2(next, menus[n]);
      choose(open, next->menuAction());
      open = next;
    }
    for (QAction* action : open->actions())
      if (action->objectName() == QLatin1String(entry)) return choose(open, action);
    QFAIL(entry);
  }
  /// Clicks a button that opens a menu at once. The click returns when the menu is closed.
  void menuOf(QToolButton* button, const char* entry) {
    QMenu* menu = button->menu() ? button->menu() : button->defaultAction()->menu();
    QTimer::singleShot(100, menu, [this, menu, entry] {
      for (QAction* action : menu->actions())
        if (action->objectName() == QLatin1String(entry)) choose(menu, action);
      menu->close();
    });
    click(button);
  }
  /// Clicks an entry of an open menu.
  void choose(QMenu* open, QAction* entry) {
    QVERIFY2(QTest::qWaitFor([open] { return open->isVisible(); }), "the menu is not open");
    click(open, open->actionGeometry(entry).center());
  }

 private:
  QWidget& window_;
  int steps_ = 0;
};

/// A task of resources/docs/tasks.md.
struct Task {
  int number;
  /// Opens the initial state, does the task and checks the result. Returns the number of steps.
  int (*steps)();
};

/// Tasks of one file of tests each, by ascending number.
std::vector<Task> readingTasks();
std::vector<Task> comparingTasks();
std::vector<Task> frameTasks();
std::vector<Task> measuringTasks();
std::vector<Task> showingTasks();

}  // namespace volumen::tests

/// Checks a condition in a task. If it fails, the macro reports it and the task returns 0 steps.
#define DONE(condition)                                                                 \
  do {                                                                                  \
    if (!QTest::qVerify(bool(condition), #condition, "", __FILE__, __LINE__)) return 0; \
  } while (false)
#define SOON(condition) DONE(QTest::qWaitFor([&] { return bool(condition); }, volumen::tests::longest))
