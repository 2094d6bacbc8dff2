// Guards the positions of views of series in different frames of reference after scrolling, moving the
// crosshair, locking, unlocking, unlinked scrolling, undo and sessions.
// Random sequences of real events are compared with a reference model from window.md ("Link views").
// VOLUMEN_RANDOM_CASES=N, VOLUMEN_RANDOM_SEED=S: N sequences, from S on.
#include <algorithm>
#include <cmath>

#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/lock_twin.h"
#include "tests/ui/random_walk.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/views/slice_view.h"
#include "ui/workspace/flat_plane.h"

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

class TurnedLocks : public RandomWalk<TurnedLocks, LockTwin> {
 public:
  explicit TurnedLocks(int seed);

 private:
  friend RandomWalk;
  static const std::vector<Act>& acts();
  QString wrong();
  ViewId anyView() { return firstComparedId + chance_.below(twin_.shown); }
  void afterAct();
  void take(const LockTwin& twin);
  /// Returns the number of the view in focus in the grid.
  int focused() const { return focus_ - firstComparedId; }
  SliceView* view(int n) { return window.views()->viewAs<SliceView>(firstComparedId + n); }
  const LockKind& kind(int n) const { return lockKinds[kinds_[n]]; }
  void press(const char* action) { child<QAction>(action)->trigger(); }
  QString wrongIn(int n);

  bool scrolls();
  bool movesCrosshair();
  bool locks();
  bool unlocks();
  bool links();
  bool choosesLayout();

  std::vector<LoadedSeriesPtr> series_;
  int kinds_[lockViews] = {};
};

TurnedLocks::TurnedLocks(int seed) : RandomWalk(seed) {
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
  begin();
}

void TurnedLocks::afterAct() {
  QCoreApplication::processEvents();
  focus_ = workspace().focus;  // undo may move it
}

void TurnedLocks::take(const LockTwin& twin) {
  twin_ = twin;
  focus_ = workspace().focus;
}

auto TurnedLocks::acts() -> const std::vector<Act>& {
  static const std::vector<Act> all{
      {"scroll", 8, &TurnedLocks::scrolls},  {"crosshair", 4, &TurnedLocks::movesCrosshair},
      {"lock here", 3, &TurnedLocks::locks}, {"unlock", 1, &TurnedLocks::unlocks},
      {"link", 2, &TurnedLocks::links},      {"layout", 1, &TurnedLocks::choosesLayout},
      {"undo", 3, &TurnedLocks::undoes},     {"redo", 2, &TurnedLocks::redoes}};
  return all;
}

bool TurnedLocks::scrolls() {
  const int notches = chance_.below(13) - 6;
  if (notches == 0) return false;
  const VoxelGeometry& g = series_[std::size_t(focused())]->volume->geometry();
  const auto [none, axis, down] = kind(focused());
  const double step = lockSpacings[focused()], last = lockSizes[focused()] - 1;
  const double firstAt = g.origin[axis] + (down < 0 ? last * step : 0);
  glm::dvec3 now = twin_.place(focused());
  const double place = std::clamp(std::round(down * (now[axis] - firstAt) / step), 0.0, last);
  now[axis] = firstAt + down * step * std::clamp(place + notches, 0.0, last);
  wheel(view(focused()), -notches);
  twin_.move(focused(), now);
  detail_ = QStringLiteral("by %1").arg(notches);
  return true;
}

// TestTurnedViews proves where a position is in a view.
bool TurnedLocks::movesCrosshair() {
  SliceView* const on = view(focused());
  const QPointF to(std::floor(on->width() * chance_.between(0.3, 0.7)),
                   std::floor(on->height() * chance_.between(0.3, 0.7)));
  const glm::dvec3 p = on->plane()->patientFromPixel(glm::dvec2(to.x(), to.y()) * on->devicePixelRatioF());
  const VoxelGeometry& g = series_[std::size_t(focused())]->volume->geometry();
  const glm::dvec3 voxel = g.voxelFromPatient(p);
  for (int axis = 0; axis < 3; ++axis)
    if (voxel[axis] < 0 || voxel[axis] > g.size[axis] - 1) return false;
  pointWithShift(to);
  twin_.move(focused(), p);
  return true;
}

// Locking links scrolling, too. Frames that are already locked stay untouched while views scroll unlinked.
bool TurnedLocks::locks() {
  const bool can = twin_.isAny(focused(), false);
  if (child<QAction>("lockHere")->isEnabled() != can)
    fault_ = QStringLiteral("Lock here is %1").arg(can ? QStringLiteral("grey") : QStringLiteral("not grey"));
  press("lockHere");
  if (!can) return true;
  if (!twin_.scroll) twin_.linkScroll(true, focused());
  const int own = lockFrames[focused()];
  for (int n = 0; n < twin_.shown; ++n)
    if (twin_.isLinkedTo(n, focused(), false))
      twin_.locks.push_back({own, lockFrames[n], twin_.at[lockFrames[n]] - twin_.at[own]});
  return true;
}

// Unlocks the frames of reference on screen.
bool TurnedLocks::unlocks() {
  const bool can = twin_.isAny(focused(), true);
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
  twin_.linkScroll(!twin_.scroll, focused());
  detail_ = twin_.scroll ? QStringLiteral("on") : QStringLiteral("off");
  return true;
}

bool TurnedLocks::choosesLayout() {
  const bool isTwo = twin_.shown == lockViews;
  if (focused() > 1) return false;  // the focus would move
  press(isTwo ? "layoutTwo" : "layoutFour");
  twin_.shown = isTwo ? 2 : lockViews;
  detail_ = QString::number(twin_.shown);
  return true;
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
  const bool isOther = n != focused() && lockFrames[n] != lockFrames[focused()];
  const auto way = twin_.way(lockFrames[focused()], lockFrames[n]);
  QString said;
  if (n != focused() && (!twin_.scroll || (isOther && !way))) said = QStringLiteral("not linked");
  if (said != line && (!said.isEmpty() || !isOther))
    return QStringLiteral("says \"%1\" instead of \"%2\"").arg(line, said);
  if (!said.isEmpty() || !isOther) return {};
  const auto number =
      QRegularExpression(QStringLiteral("^linked by hand, [+\u2212](\\d+) mm$")).match(line).captured(1);
  if (number.isEmpty() || std::abs(number.toDouble() - std::abs((*way)[axis])) > 0.5 + 1e-6)
    return QStringLiteral("says \"%1\" of %2 mm").arg(line).arg((*way)[axis]);
  return {};
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
  const QString why = TurnedLocks(seed).wrongAfter(40);
  QVERIFY2(why.isEmpty(), qPrintable(why));
}

VOLUMEN_TEST(TestTurnedLocks);
#include "tst_turned_locks.moc"
