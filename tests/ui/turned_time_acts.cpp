#include <QMenu>
#include <algorithm>
#include <cmath>

#include "tests/ui/turned_sequence.h"

namespace volumen::tests {

// A series without time points has no such keys.
bool TurnedSequence::stepsInTime() {
  const TwinLook& look = twin_.views.at(focus_);
  const int by = chance_.oneIn(2) ? 1 : -1, last = look.series == 0 ? int(later_.size()) : 0;
  QTest::keyClick(view(focus_), by > 0 ? Qt::Key_Right : Qt::Key_Left);
  twin_.showTime(focus_, std::clamp(look.time + by, 0, last));
  detail_ = QStringLiteral("to %1").arg(look.time + 1);
  return true;
}

// Plays the time points, or the stack if there are none. The clock decides how far it gets before C is
// pressed again.
bool TurnedSequence::plays() {
  SliceView* const on = view(focus_);
  const bool isInTime = twin_.views.at(focus_).series == 0;
  if (!isInTime && twin_.place(focus_).second < 2) return false;
  const auto place = [&] {
    if (!isInTime) return on->stack().place.index;
    const SeriesKey shown = workspace().view(focus_).series;
    const auto isIt = [&](const LoadedSeriesPtr& series) { return keyOf(series->series) == shown; };
    return shown == keyOf(series_[0]->series) ? 0
                                              : 1 + int(std::ranges::find_if(later_, isIt) - later_.begin());
  };
  const int before = place(), steps = session().undoStack().index();
  QTest::keyClick(on, Qt::Key_C);
  if (!on->isPlaying()) return fault_ = QStringLiteral("C does not play"), true;
  if (!QTest::qWaitFor([&] { return place() != before; }, 5000)) fault_ = QStringLiteral("nothing is played");
  QTest::keyClick(on, Qt::Key_C);
  if (on->isPlaying()) fault_ = QStringLiteral("C does not stop");
  if (session().undoStack().index() != steps + 1) fault_ = QStringLiteral("what is played is no single step");
  isInTime ? twin_.showTime(focus_, place()) : twin_.scrollTo(focus_, place());
  detail_ = QStringLiteral("from %1 to %2").arg(before).arg(place());
  return true;
}

// Alt with the wheel changes the slab thickness, in steps of the wheel.
bool TurnedSequence::makesThicker() {
  constexpr double thickest = 12;  // mm, to keep drawing fast
  TwinLook& look = twin_.views.at(focus_);
  const double step = twinStep(twin_.geometry(focus_), twin_.lying(focus_).normal());
  const int notches = chance_.below(5) - 2;
  const double steps = look.slabMm / step;
  const bool isBetween = std::abs(steps - std::floor(steps) - 0.5) < 1e-6;  // rounding decides
  const double mm = std::max(0.0, (std::round(steps) + notches) * step);
  if (notches == 0 || isBetween || mm > thickest) return false;
  wheel(view(focus_), notches, Qt::AltModifier);
  look.slabMm = mm;
  detail_ = QStringLiteral("%1 mm").arg(mm);
  return true;
}

// Choosing a mode turns a plane into a slab of 10 mm.
bool TurnedSequence::choosesSlab() {
  const std::pair<const char*, TwinSlab> modes[] = {
      {"slabMax", TwinSlab::max}, {"slabMin", TwinSlab::min}, {"slabMean", TwinSlab::mean}};
  const auto& [name, mode] = modes[chance_.below(3)];
  auto* menu = child<QMenu>("slabMenu");
  Q_EMIT menu->aboutToShow();
  auto* entry = menu->findChild<QAction*>(QLatin1String(name));
  if (!entry) return fault_ = QStringLiteral("no such slab in the menu"), true;
  entry->trigger();
  TwinLook& look = twin_.views.at(focus_);
  look.slab = mode;
  if (look.slabMm == 0) look.slabMm = 10;
  detail_ = QLatin1String(name);
  return true;
}

// Requires planes along the voxels. Pictures of the coarser series would be smaller than allowed.
bool TurnedSequence::showsOwnPixels() {
  const TwinLook& look = twin_.views.at(focus_);
  if (twin_.cross(focus_).byHand || look.series != 0) return false;
  const TwinSeen seen = twin_.seen(focus_);
  const glm::dmat3& voxel = twin_.geometry(focus_).patientFromVoxelStep;
  const auto edge = [&](glm::dvec3 along) {
    double mm = 0;
    for (int axis = 0; axis < 3; ++axis) mm = std::max(mm, std::abs(glm::dot(along, voxel[axis])));
    return mm;
  };
  const double mm = std::min(edge(seen.right), edge(seen.down));
  if (look.zoom * seen.mmPerPixel / mm < TurnedTwin::leastZoom) return false;
  QTest::keyClick(view(focus_), Qt::Key_O);
  twin_.zoomAt(focus_, glm::dvec2(seen.size) / 2.0, mm);
  return true;
}

bool TurnedSequence::typesNumber() {
  const int count = twin_.numberCount(focus_);
  if (count < 2) return false;
  const int number = 1 + chance_.below(count);
  const bool isMeant = !chance_.oneIn(3);
  if (const QString why = wrongAfterNumber(*this, number, isMeant); !why.isEmpty()) fault_ = why;
  if (isMeant) twin_.goToNumber(focus_, number);
  detail_ = isMeant ? QString::number(number) : QStringLiteral("%1, given up").arg(number);
  return true;
}

bool TurnedSequence::movesFocus() {
  return RandomWalk::movesFocus([this] { return look(), wrongIn(focus_); });
}

}  // namespace volumen::tests
