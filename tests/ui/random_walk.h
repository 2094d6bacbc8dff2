#pragma once

#include <algorithm>
#include <QRegularExpression>
#include <cmath>
#include <map>
#include <vector>

#include "tests/fixtures/chance.h"
#include "tests/ui/draws_nothing.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/ui/turned_focus.h"
#include "ui/views/drawn_measurement.h"
#include "ui/workspace/session_json.h"

namespace volumen::tests {

/// Returns a random act of a table, by how often each is to be done.
template <class Act>
const Act& anyAct(const std::vector<Act>& acts, Chance& chance) {
  int all = 0;
  for (const Act& act : acts) all += act.often;
  int n = chance.below(all);
  auto chosen = acts.begin();
  for (; n >= chosen->often; ++chosen) n -= chosen->often;
  return *chosen;
}

/// A window in which random acts are done by mouse, keys and actions, and its reference model, on which they
/// are repeated as the documents describe them. `Walk` derives from this class and defines:
/// - acts(): its table; anyView(): a view of slices or frames on screen
/// - wrong(): a difference from the model in any view on screen, or an empty text
/// - take(model): makes a known state the present one; afterAct(): notes what an act may have moved
template <class Walk, class Model>
class RandomWalk : public Journey {
 public:
  /// Does `length` acts and checks each. Then checks all of it undone, redone and in its session. Returns
  /// what is wrong and after which acts; empty if nothing is. A walk that isUndecided() ends there.
  QString wrongAfter(int length) {
    QStringList done;
    QString why = walk().wrong();
    while (why.isEmpty() && done.size() < length && !walk().isUndecided()) {
      const QString what = act();
      if (what.isEmpty()) continue;
      done << what;
      if (!walk().isUndecided()) why = walk().wrong();
    }
    if (walk().isUndecided()) return why;
    if (why.isEmpty() && !(why = wrongUndone()).isEmpty()) why.prepend(QStringLiteral("undone and redone: "));
    if (why.isEmpty() && !(why = walk().wrongInSession()).isEmpty())
      why.prepend(QStringLiteral("in its session: "));
    return why.isEmpty() ? why : why + QStringLiteral("\nafter ") + done.join(QStringLiteral("\n      "));
  }

 protected:
  struct Act {
    const char* name;
    int often;
    bool (Walk::*act)();
  };

  explicit RandomWalk(int seed) : Journey({}, withoutScenes()), chance_(std::uint64_t(seed)) {}

  /// Begins the walk at the present undo step. The walk never undoes steps before it.
  void begin() {
    first_ = step();
    remember();
  }
  /// Returns whether the model cannot decide what the next act does.
  bool isUndecided() const { return false; }
  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  int step() { return session().undoStack().index(); }
  /// Returns what undo and session files restore.
  static Workspace comparable(Workspace workspace) {
    workspace.focus = sceneViewId;
    workspace.selected = 0;
    return workspace;
  }

  /// Returns a difference after the session was written, read and opened.
  QString wrongInSession() {
    const Result<std::string> text = sessionToJson(workspace(), "");
    if (!text) return QString::fromStdString(text.message());
    const auto back = sessionFromJson(*text, [&](const SavedSeries& saved) {
      return workspace().series.at({saved.series.path, saved.series.id}).series;
    });
    if (!back) return QString::fromStdString(back.message());
    if (comparable(back->workspace) != comparable(workspace())) return QStringLiteral("another workspace");
    const ViewId focus = workspace().focus;
    session().open(QStringLiteral("Open"), Workspace{});
    session().open(QStringLiteral("Open"), back->workspace);
    session().setFocus(focus);
    return walk().wrong();
  }

  // Acts of all walks.
  bool undoes() {
    if (step() <= first_) return false;
    do child<QAction>("undo")->trigger();
    while (!known_.contains(step()));
    return walk().take(known_.at(step()).model), true;
  }
  bool redoes() {
    const QUndoStack& stack = session().undoStack();
    if (!stack.canRedo()) return false;
    do child<QAction>("redo")->trigger();
    while (!known_.contains(step()) && stack.canRedo());
    if (!known_.contains(step())) qFatal("a step that no act made: %s", qPrintable(stack.undoText()));
    return walk().take(known_.at(step()).model), true;
  }
  /// Moves the crosshair of the view in focus, which follows the pointer while Shift is held.
  void pointWithShift(QPointF to) {
    View* const on = window.views()->viewOf(focus_);
    hover(on, to + QPointF(40, 0));
    QMouseEvent move(QEvent::MouseMove, to, on->mapToGlobal(to), Qt::NoButton, Qt::NoButton,
                     Qt::ShiftModifier);
    QCoreApplication::sendEvent(on, &move);
    hover(on, to + QPointF(1, 0));
  }
  /// Moves the focus by keys. `wrongAlone` checks the view while it is maximised.
  bool movesFocus(const std::function<QString()>& wrongAlone) {
    const char* const keys[] = {"Tab", "Shift+Tab", "F6", "F10", "F10, Esc", "Shift+F10"};
    const int which = chance_.below(6);
    const QString why = which < 2    ? wrongAfterTab(*this, which == 1)
                        : which == 2 ? wrongAfterParts(*this)
                        : which < 5  ? wrongWhileAlone(*this, which == 4, wrongAlone)
                                     : wrongAfterMenu(*this);
    if (!why.isEmpty()) fault_ = why;
    detail_ = QLatin1String(keys[which]);
    return true;
  }
  /// Draws a line or rectangle, which must say `number` within `tolerance`. `noted` takes its id and text.
  /// Returns false if another shape is in the way.
  bool measures(FlatView* on, const char* tool, QPointF from, QPointF to, double number, double tolerance,
                const std::function<void(int id, const QString& said)>& noted) {
    for (const DrawnMeasurement& d : on->drawnMeasurements())
      if (hitAt({d}, from)) return false;
    const std::size_t before = workspace().measurements.size();
    child<QAction>(tool)->trigger();
    drag(on, from, to);
    if (workspace().measurements.size() != before + 1)
      return fault_ = QStringLiteral("nothing is drawn"), true;
    const int id = workspace().measurements.back().id;
    QString said;
    const auto isSaid = [&] {
      for (const DrawnMeasurement& d : on->drawnMeasurements())
        if (d.id == id) said = d.text.value(0);
      return !said.isEmpty();
    };
    if (!QTest::qWaitFor(isSaid, 5000)) fault_ = QStringLiteral("no number");
    const double is = QRegularExpression(QStringLiteral("[\\d.]+")).match(said).captured().toDouble();
    if (std::abs(is - number) > tolerance)
      fault_ = QStringLiteral("says %1 instead of %2").arg(said).arg(number);
    return noted(id, said), true;
  }

  Chance chance_;
  Model twin_;
  ViewId focus_ = firstComparedId;
  QString detail_;  // of the act, for its description
  QString fault_;   // in an act itself; it stays

 private:
  struct Known {
    Model model;
    Workspace workspace;
  };

  static Services withoutScenes() {
    Services services = realServices();
    services.makeDraw = drawsNothing();
    return services;
  }
  Walk& walk() { return static_cast<Walk&>(*this); }

  void remember() {
    known_.erase(known_.lower_bound(step()), known_.end());
    known_[step()] = {twin_, workspace()};
  }

  /// Does one random act and returns its description; empty if nothing could be done.
  QString act() {
    const Act& act = anyAct(Walk::acts(), chance_);
    focus_ = walk().anyView();
    session().setFocus(focus_);
    session().endGesture();
    detail_.clear();
    const int before = step();
    if (!(walk().*act.act)()) return {};
    session().endGesture();
    walk().afterAct();
    const bool isStep = act.act != &Walk::undoes && act.act != &Walk::redoes;
    if (isStep && step() != before) remember();
    return QStringLiteral("%1 in view %2 %3").arg(QLatin1String(act.name)).arg(focus_).arg(detail_).trimmed();
  }

  QString wrongUndone() {
    const int last = step();
    for (const int to : {first_, last}) {
      const QUndoStack& stack = session().undoStack();
      while (step() > to && stack.canUndo()) child<QAction>("undo")->trigger();
      while (step() < to && stack.canRedo()) child<QAction>("redo")->trigger();
      const Known& known = known_.at(to);
      if (Walk::comparable(workspace()) != Walk::comparable(known.workspace))
        return QStringLiteral("another workspace");
      walk().take(known.model);
      if (const QString why = walk().wrong(); !why.isEmpty()) return why;
    }
    return {};
  }

  std::map<int, Known> known_;  // by undo step
  int first_ = 0;               // undo step at which random acts begin
};

}  // namespace volumen::tests
