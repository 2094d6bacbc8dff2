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

/// What a user's hands do in a window, by real events, and in how many steps: a click, a double click, a key
/// with its modifiers, a drag, a drop, a turn of the wheel, a text with Enter and a move with a key held are
/// one each.
class Hand {
 public:
  explicit Hand(QWidget& window) : window_(window) {}

  int steps() const { return steps_; }

  /// Where the keyboard is.
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
    ++steps_;
    QWidget* focus = QApplication::focusWidget();
    QTest::keyClick(focus && focus->isVisible() ? focus : &window_, key, modifiers);
  }
  /// In a dialog, which has the keyboard once it is open.
  void keyOn(QWidget* dialog, Qt::Key key) {
    ++steps_;
    QTest::keyClick(dialog, key);
  }
  /// A text in the field that has the keyboard, in place of what stands there, and Enter.
  void type(const QString& text) {
    ++steps_;
    QWidget* field = QApplication::focusWidget();
    QVERIFY2(field, "no field has the keyboard");
    QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }
  /// A path in the file dialog that is open, and Enter.
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
  /// The button of an action in the tool bar.
  void button(const char* action) {
    auto* bar = window_.findChild<QToolBar*>(QStringLiteral("tools"));
    QWidget* shown = bar->widgetForAction(window_.findChild<QAction*>(QLatin1String(action)));
    QVERIFY2(shown && shown->isVisible(), action);
    click(shown);
  }
  /// By clicks on menus, from one of the menu bar on, and then on the entry of this object name.
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
  /// By a button that opens a menu at once, which waits until that is closed.
  void menuOf(QToolButton* button, const char* entry) {
    QMenu* menu = button->menu() ? button->menu() : button->defaultAction()->menu();
    QTimer::singleShot(100, menu, [this, menu, entry] {
      for (QAction* action : menu->actions())
        if (action->objectName() == QLatin1String(entry)) choose(menu, action);
      menu->close();
    });
    click(button);
  }
  /// An entry of a menu that is open.
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
  /// Opens what it starts from, does it, and sees that it is done; returns in how many steps.
  int (*steps)();
};

/// Those of one file of tests each, in the order of their numbers.
std::vector<Task> readingTasks();
std::vector<Task> comparingTasks();
std::vector<Task> frameTasks();
std::vector<Task> measuringTasks();
std::vector<Task> showingTasks();

}  // namespace volumen::tests

/// In a task: where it fails, it says so and took no steps.
#define DONE(condition)                                                                 \
  do {                                                                                  \
    if (!QTest::qVerify(bool(condition), #condition, "", __FILE__, __LINE__)) return 0; \
  } while (false)
#define SOON(condition) DONE(QTest::qWaitFor([&] { return bool(condition); }, volumen::tests::longest))
