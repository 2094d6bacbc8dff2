// Guards the positions of views of series in different frames of reference after scrolling, moving the
// crosshair, locking, unlocking, unlinked scrolling, undo and sessions.
// Random sequences of real events are compared with a reference model from window.md ("Link views").
// VOLUMEN_RANDOM_CASES=N, VOLUMEN_RANDOM_SEED=S: N sequences, from S on.
#include <QRegularExpression>
#include <algorithm>
#include <cmath>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/draws_nothing.h"
#include "tests/ui/gestures.h"
#include "tests/ui/known_steps.h"
#include "tests/ui/lock_twin.h"
#include "tests/ui/test_series.h"
#include "tests/ui/turned_run.h"
#include "tests/unit/suite.h"
#include "ui/views/slice_view.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

LoadedSeriesPtr cubeIn(int view, glm::dvec3 centre) {
  VolumeParts parts;
  parts.geometry.size = glm::ivec3(lockSizes[view]);
  parts.geometry.patientFromVoxelStep *= lockSpacings[view];
  parts.geometry.origin = centre - lockSpacings[view] * (lockSizes[view] - 1) / 2;
  parts.values =
      std::vector<std::int16_t>(std::size_t(lockSizes[view] * lockSizes[view] * lockSizes[view]), 700);
  auto series = std::make_shared<LoadedSeries>(*ballSeries(2, 1));
  series->volume = volumeFrom(std::move(parts));
  series->series.acquired = series->volume->geometry();
  series->series.frameOfReferenceUid = std::to_string(lockFrames[view]);
  series->window = {500, 1000};
  return series;
}

Services withoutPictures3d() {
  Services services = realServices();
  services.makeDraw = drawsNothing();
  return services;
}

class TurnedLocks : public Journey {
 public:
  explicit TurnedLocks(std::uint64_t seed);

  /// Does one random act. Returns an empty text if nothing could be done.
  QString act();
  /// Returns a difference from the reference model; empty if there is none.
  QString wrong();
  QString wrongUndone();
  QString wrongInSession();

 private:
  struct Known {
    LockTwin twin;
    Workspace workspace;
  };
  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  SliceView* view(int n) { return window.views()->viewAs<SliceView>(firstComparedId + n); }
  const LockKind& kind(int n) const { return lockKinds[kinds_[n]]; }
  void press(const char* action) { child<QAction>(action)->trigger(); }
  void remember();
  QString wrongIn(int n);

  bool scrolls();
  bool movesCrosshair();
  bool locks();
  bool unlocks();
  bool links();
  bool choosesLayout();
  bool undoes();
  bool redoes();

  Chance chance_;
  std::vector<LoadedSeriesPtr> series_;
  int kinds_[lockViews] = {};
  LockTwin twin_;
  std::map<int, Known> known_;
  int first_ = 0, focus_ = 0;
  QString detail_;
  QString fault_;  // in an act itself; it stays
};

TurnedLocks::TurnedLocks(std::uint64_t seed) : Journey({}, withoutPictures3d()), chance_(seed) {
  const glm::dvec3 centres[] = {30.0 * chance_.vector(), 30.0 * chance_.vector(), 30.0 * chance_.vector()};
  for (int n = 0; n < lockViews; ++n) series_.push_back(cubeIn(n, centres[lockFrames[n]]));
  session().show(series_[0]);
  press("layoutFour");
  for (int n = 0; n < lockViews; ++n) {
    kinds_[n] = chance_.below(3);
    session().show(series_[std::size_t(n)], firstComparedId + n);
    session().showAs(firstComparedId + n, kind(n).kind);
  }
  session().setFocus(firstComparedId);
  QCoreApplication::processEvents();
  for (const int n : {0, 1, 3})
    twin_.at[lockFrames[n]] = crosshairOf(workspace(), firstComparedId + n, *series_[std::size_t(n)]).at;
  first_ = session().undoStack().index();
  remember();
}

void TurnedLocks::remember() {
  const int step = session().undoStack().index();
  known_.erase(known_.lower_bound(step), known_.end());
  known_[step] = {twin_, workspace()};
}

QString TurnedLocks::act() {
  struct Act {
    const char* name;
    int often;
    bool (TurnedLocks::*act)();
  };
  static const std::vector<Act> acts{
      {"scroll", 8, &TurnedLocks::scrolls},  {"crosshair", 4, &TurnedLocks::movesCrosshair},
      {"lock here", 3, &TurnedLocks::locks}, {"unlock", 1, &TurnedLocks::unlocks},
      {"link", 2, &TurnedLocks::links},      {"layout", 1, &TurnedLocks::choosesLayout},
      {"undo", 3, &TurnedLocks::undoes},     {"redo", 2, &TurnedLocks::redoes}};
  int all = 0;
  for (const Act& a : acts) all += a.often;
  int chosen = chance_.below(all);
  const Act* act = acts.data();
  for (; chosen >= act->often; ++act) chosen -= act->often;
  focus_ = chance_.below(twin_.shown);
  session().setFocus(firstComparedId + focus_);
  session().endGesture();
  detail_.clear();
  const int before = session().undoStack().index();
  if (!(this->*act->act)()) return {};
  session().endGesture();
  QCoreApplication::processEvents();
  focus_ = workspace().focus - firstComparedId;  // undo may move it
  const bool isStep = act->act != &TurnedLocks::undoes && act->act != &TurnedLocks::redoes;
  if (isStep && session().undoStack().index() != before) remember();
  return QStringLiteral("%1 in view %2 %3").arg(QLatin1String(act->name)).arg(focus_).arg(detail_).trimmed();
}

bool TurnedLocks::scrolls() {
  const int notches = chance_.below(13) - 6;
  if (notches == 0) return false;
  const VoxelGeometry& g = series_[std::size_t(focus_)]->volume->geometry();
  const auto [none, axis, down] = kind(focus_);
  const double step = lockSpacings[focus_], last = lockSizes[focus_] - 1;
  const double firstAt = g.origin[axis] + (down < 0 ? last * step : 0);
  glm::dvec3 now = twin_.place(focus_);
  const double place = std::clamp(std::round(down * (now[axis] - firstAt) / step), 0.0, last);
  now[axis] = firstAt + down * step * std::clamp(place + notches, 0.0, last);
  wheel(view(focus_), -notches);
  twin_.move(focus_, now);
  detail_ = QStringLiteral("by %1").arg(notches);
  return true;
}

// With Shift held, the crosshair follows the pointer. TestTurnedViews proves where a position is in a view.
bool TurnedLocks::movesCrosshair() {
  SliceView* const on = view(focus_);
  const QPointF to(std::floor(on->width() * chance_.between(0.3, 0.7)),
                   std::floor(on->height() * chance_.between(0.3, 0.7)));
  const glm::dvec3 p = on->plane()->patientFromPixel(glm::dvec2(to.x(), to.y()) * on->devicePixelRatioF());
  const VoxelGeometry& g = series_[std::size_t(focus_)]->volume->geometry();
  const glm::dvec3 voxel = g.voxelFromPatient(p);
  for (int axis = 0; axis < 3; ++axis)
    if (voxel[axis] < 0 || voxel[axis] > g.size[axis] - 1) return false;
  hover(on, to + QPointF(40, 0));
  QMouseEvent move(QEvent::MouseMove, to, on->mapToGlobal(to), Qt::NoButton, Qt::NoButton, Qt::ShiftModifier);
  QCoreApplication::sendEvent(on, &move);
  hover(on, to + QPointF(1, 0));
  twin_.move(focus_, p);
  return true;
}

// Locking links scrolling, too. Frames that are already locked stay untouched while views scroll unlinked.
bool TurnedLocks::locks() {
  const bool can = twin_.isAny(focus_, false);
  if (child<QAction>("lockHere")->isEnabled() != can)
    fault_ = QStringLiteral("Lock here is %1").arg(can ? QStringLiteral("grey") : QStringLiteral("not grey"));
  press("lockHere");
  if (!can) return true;
  if (!twin_.scroll) twin_.linkScroll(true, focus_);
  const int own = lockFrames[focus_];
  for (int n = 0; n < twin_.shown; ++n)
    if (twin_.isLinkedTo(n, focus_, false))
      twin_.locks.push_back({own, lockFrames[n], twin_.at[lockFrames[n]] - twin_.at[own]});
  return true;
}

// Unlocks the frames of reference on screen.
bool TurnedLocks::unlocks() {
  const bool can = twin_.isAny(focus_, true);
  if (child<QAction>("unlock")->isEnabled() != can)
    fault_ = QStringLiteral("Unlock is %1").arg(can ? QStringLiteral("grey") : QStringLiteral("not grey"));
  press("unlock");
  std::set<int> frames;
  for (int n = 0; n < twin_.shown; ++n) frames.insert(lockFrames[n]);
  if (can)
    std::erase_if(twin_.locks, [&](const TwinLock& lock) {
      return frames.contains(lock.from) || frames.contains(lock.to);
    });
  return true;
}

bool TurnedLocks::links() {
  press("linkScroll");
  twin_.linkScroll(!twin_.scroll, focus_);
  detail_ = twin_.scroll ? QStringLiteral("on") : QStringLiteral("off");
  return true;
}

bool TurnedLocks::choosesLayout() {
  const bool isTwo = twin_.shown == lockViews;
  if (focus_ > 1) return false;  // the focus would move
  press(isTwo ? "layoutTwo" : "layoutFour");
  twin_.shown = isTwo ? 2 : lockViews;
  detail_ = QString::number(twin_.shown);
  return true;
}

bool TurnedLocks::undoes() {
  return undoneTo(*this, first_, known_, [this](int step) { twin_ = known_.at(step).twin; });
}

bool TurnedLocks::redoes() {
  return doneAgain(*this, known_, [this](int step) { twin_ = known_.at(step).twin; });
}

QString TurnedLocks::wrong() {
  if (!fault_.isEmpty()) return fault_;
  for (int n = 0; n < twin_.shown; ++n)
    if (const QString why = wrongIn(n); !why.isEmpty()) return QStringLiteral("view %1: %2").arg(n).arg(why);
  return {};
}

// Positions agree within 1/1000000 mm. The corner text is rounded to mm and has its own direction along the
// axis.
QString TurnedLocks::wrongIn(int n) {
  const int axis = kind(n).axis;
  const double is = view(n)->plane()->centre[axis], expected = twin_.place(n)[axis];
  if (!(std::abs(is - expected) < 1e-6))
    return QStringLiteral("at %1 instead of %2").arg(is, 0, 'f', 6).arg(expected, 0, 'f', 6);
  const QString line =
      view(n)->overlays().topRight.filter(QStringLiteral("linked")).join(QStringLiteral(", "));
  const bool isOther = n != focus_ && lockFrames[n] != lockFrames[focus_];
  const auto way = twin_.way(lockFrames[focus_], lockFrames[n]);
  QString said;
  if (n != focus_ && (!twin_.scroll || (isOther && !way))) said = QStringLiteral("not linked");
  if (said != line && (!said.isEmpty() || !isOther))
    return QStringLiteral("says \"%1\" instead of \"%2\"").arg(line, said);
  if (!said.isEmpty() || !isOther) return {};
  const auto number =
      QRegularExpression(QStringLiteral("^linked by hand, [+\u2212](\\d+) mm$")).match(line).captured(1);
  if (number.isEmpty() || std::abs(number.toDouble() - std::abs((*way)[axis])) > 0.5 + 1e-6)
    return QStringLiteral("says \"%1\" of %2 mm").arg(line).arg((*way)[axis]);
  return {};
}

Workspace withoutFocus(Workspace workspace) {
  workspace.focus = sceneViewId;
  return workspace;
}

QString TurnedLocks::wrongUndone() {
  const int last = session().undoStack().index();
  for (const int to : {first_, last}) {
    goToStep(*this, to);
    if (withoutFocus(workspace()) != withoutFocus(known_.at(to).workspace))
      return QStringLiteral("another workspace");
    twin_ = known_.at(to).twin;
    focus_ = workspace().focus - firstComparedId;
    if (const QString why = wrong(); !why.isEmpty()) return why;
  }
  return {};
}

QString TurnedLocks::wrongInSession() {
  const Result<std::string> text = sessionToJson(workspace(), "");
  if (!text) return QString::fromStdString(text.message());
  const auto back = sessionFromJson(*text, [&](const SavedSeries& saved) {
    return workspace().series.at({saved.series.path, saved.series.id}).series;
  });
  if (!back) return QString::fromStdString(back.message());
  const ViewId focus = workspace().focus;
  session().open(QStringLiteral("Open"), Workspace{});
  session().open(QStringLiteral("Open"), back->workspace);
  session().setFocus(focus);
  return wrong();
}

}  // namespace

class TestTurnedLocks : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void placesFollowAsTheTwinHasThem_data();
  void placesFollowAsTheTwinHasThem();
};

void TestTurnedLocks::placesFollowAsTheTwinHasThem_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(15, 150);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

void TestTurnedLocks::placesFollowAsTheTwinHasThem() {
  QFETCH(int, seed);
  const QString why = wrongInSequence<TurnedLocks>(seed, 40);
  QVERIFY2(why.isEmpty(), qPrintable(why));
}

VOLUMEN_TEST(TestTurnedLocks);
#include "tst_turned_locks.moc"
