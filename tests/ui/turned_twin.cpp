#include "tests/ui/turned_twin.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace volumen::tests {

namespace {

glm::dvec3 sliceNormalOf(const VoxelGeometry& g) {
  return glm::normalize(glm::cross(g.patientFromVoxelStep[0], g.patientFromVoxelStep[1]));
}

// The wheel scrolls down towards caudal, posterior and left in the patient's planes.
constexpr double downSign[] = {-1, 1, -1};

glm::dvec2 alongPlane(const TwinLying& lying, glm::dvec3 v) {
  return {glm::dot(v, lying.right), glm::dot(v, lying.down)};
}

struct TwinStack {
  glm::dvec3 along;
  double first, step;
  int count;
};

// Returns the stack through the centres of the first and the last voxel.
TwinStack stackThrough(const VoxelGeometry& g, glm::dvec3 along) {
  double low = 1e300, high = -1e300;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 pVoxel = glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2) * glm::dvec3(g.size - 1);
    const double at = glm::dot(g.patientFromVoxelStep * pVoxel + g.origin, along);
    low = std::min(low, at), high = std::max(high, at);
  }
  const double step = twinStep(g, along);
  return {along, low, step, 1 + int(std::floor((high - low) / step + 1e-6))};
}

}  // namespace

TwinLyings alongPatient() {
  return {TwinLying{{1, 0, 0}, {0, 1, 0}}, TwinLying{{1, 0, 0}, {0, 0, -1}},
          TwinLying{{0, 1, 0}, {0, 0, -1}}};
}

TwinLyings alongAcquired(const VoxelGeometry& g) {
  const glm::dvec3 i = glm::normalize(g.patientFromVoxelStep[0]), k = sliceNormalOf(g);
  const glm::dmat3 grid(i, glm::cross(k, i), k);
  glm::dmat3 best(1);
  double least = 1e9;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int signs = 0; a != b && signs < 4; ++signs) {
        const glm::dvec3 x = grid[a] * (signs & 1 ? -1.0 : 1.0), y = grid[b] * (signs & 2 ? -1.0 : 1.0);
        const glm::dmat3 turned(x, y, glm::cross(x, y));
        const double cosine = (turned[0].x + turned[1].y + turned[2].z - 1) / 2;
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
        if (angle < least - 1e-9) least = angle, best = turned;
      }
  TwinLyings all = alongPatient();
  for (TwinLying& lying : all) lying = {best * lying.right, best * lying.down};
  return all;
}

glm::dvec2 TwinSeen::placeOf(glm::dvec3 p) const {
  return glm::dvec2(size) / 2.0 +
         glm::dvec2(glm::dot(p - centre, right), glm::dot(p - centre, down)) / mmPerPixel;
}

glm::dvec3 TwinSeen::patientAt(glm::dvec2 place) const {
  const glm::dvec2 mm = (place - glm::dvec2(size) / 2.0) * mmPerPixel;
  return centre + mm.x * right + mm.y * down;
}

double TwinSeen::depthOf(glm::dvec3 p) const { return glm::dot(p - centre, glm::cross(right, down)); }

const TwinCross& TurnedTwin::cross(ViewId view) const {
  const auto found = own.find(view);
  return isAlone(view) && found != own.end() ? found->second : shared;
}

TwinLying TurnedTwin::lying(ViewId view) const {
  const TwinCross& now = cross(view);
  return (now.byHand ? *now.byHand : alongAcquired(geometry(view)))[views.at(view).kind];
}

TwinSeen TurnedTwin::seen(ViewId view) const {
  const TwinLook& look = views.at(view);
  const VoxelGeometry& g = geometry(view);
  const TwinLying fitted = alongAcquired(g)[look.kind], now = lying(view);
  const TwinPlane whole = twinPlane(g, fitted.right, fitted.down);
  const glm::dvec2 mm = glm::abs(look.seen * (glm::dvec2(whole.size) * whole.mmPerPixel));
  TwinSeen seen;
  seen.size = sizes.at(view);
  seen.mmPerPixel = std::max(mm.x / seen.size.x, mm.y / seen.size.y) / look.zoom;
  seen.right = look.seen[0][0] * now.right + look.seen[1][0] * now.down;
  seen.down = look.seen[0][1] * now.right + look.seen[1][1] * now.down;
  const glm::dvec3 middle = g.patientFromVoxelStep * ((glm::dvec3(g.size) - 1.0) / 2.0) + g.origin +
                            look.middle.x * now.right + look.middle.y * now.down;
  seen.centre = middle + now.normal() * glm::dot(cross(view).at - middle, now.normal());
  seen.slabMm = look.slabMm, seen.slab = look.slab;
  seen.average = true;
  return seen;
}

// Returns whether the view is parallel to its acquired slices.
bool TurnedTwin::isParallel(ViewId view) const {
  return glm::length(glm::cross(lying(view).normal(), sliceNormalOf(geometry(view)))) <= 1e-3;
}

std::pair<int, int> TurnedTwin::place(ViewId view) const {
  const TwinStack stack = stackThrough(geometry(view), downSign[views.at(view).kind] * lying(view).normal());
  const double at = (glm::dot(cross(view).at, stack.along) - stack.first) / stack.step;
  return {int(std::clamp(std::round(at), 0.0, double(stack.count - 1))), stack.count};
}

QString TurnedTwin::number(ViewId view) const {
  const VoxelGeometry& g = geometry(view);
  const TwinSeen now = seen(view);
  const double k = (glm::inverse(g.patientFromVoxelStep) * (now.centre - g.origin)).z;
  const int count = g.size.z, nearest = int(std::lround(k));
  if (isParallel(view) && std::abs(k - nearest) <= 1e-3 && nearest >= 0 && nearest < count)
    return QStringLiteral("%1 / %2").arg(nearest + 1).arg(count);
  if (isParallel(view) && k > -0.5 && k < count - 0.5) {
    const int below = int(std::floor(k + 1e-3)) + 1;
    if (below < 1 || below >= count)
      return QStringLiteral("beside %1 / %2").arg(std::clamp(below, 1, count)).arg(count);
    return QStringLiteral("between %1 and %2 / %3").arg(below).arg(below + 1).arg(count);
  }
  const auto [index, of] = place(view);
  return QStringLiteral("%1 / %2").arg(index + 1).arg(of);
}

QString TurnedTwin::position(ViewId view) const {
  const TwinKind kind = views.at(view).kind;
  const int axis = kind == twinAxial ? 2 : kind == twinCoronal ? 1 : 0;
  const TwinSeen now = seen(view);
  glm::dvec3 along(0);
  along[axis] = 1;
  if (glm::length(glm::cross(glm::cross(now.right, now.down), along)) > 1e-3)
    return QStringLiteral("oblique");
  const double mm = std::round(10 * now.centre[axis]) / 10;
  if (mm == 0) return QStringLiteral("0 mm");
  const char* sides = axis == 2 ? "SI" : axis == 1 ? "PA" : "LR";
  return QStringLiteral("%1 %2 mm").arg(QLatin1Char(sides[mm < 0])).arg(std::abs(mm), 0, 'f', 1);
}

QString TurnedTwin::slab(ViewId view) const {
  const TwinLook& look = views.at(view);
  const char* const word = look.slab == TwinSlab::max ? "MIP" : look.slab == TwinSlab::min ? "MinIP" : "Mean";
  if (look.slabMm <= 0) return {};
  return QStringLiteral("%1 %2 mm").arg(QLatin1String(word)).arg(look.slabMm, 0, 'f', 1);
}

int TurnedTwin::numberCount(ViewId view) const {
  return isParallel(view) ? geometry(view).size.z : place(view).second;
}

void TurnedTwin::turn(ViewId view, glm::dmat2 by) {
  views.at(view).seen = by * views.at(view).seen;
  follow(view);
}

void TurnedTwin::panBy(ViewId view, glm::dvec2 pixels) {
  TwinLook& look = views.at(view);
  look.middle -= glm::transpose(look.seen) * pixels * seen(view).mmPerPixel;
  follow(view);
}

void TurnedTwin::zoomAt(ViewId view, glm::dvec2 place, double mmPerPixel) {
  TwinLook& look = views.at(view);
  const TwinSeen before = seen(view);
  const glm::dvec2 off = glm::transpose(look.seen) * (place - glm::dvec2(before.size) / 2.0);
  look.middle += off * (before.mmPerPixel - mmPerPixel);
  look.zoom *= before.mmPerPixel / mmPerPixel;
  follow(view);
}

void TurnedTwin::scrollTo(ViewId view, int place) {
  const TwinStack stack = stackThrough(geometry(view), downSign[views.at(view).kind] * lying(view).normal());
  TwinCross now = cross(view);
  const double wanted = stack.first + std::clamp(place, 0, stack.count - 1) * stack.step;
  now.at += stack.along * (wanted - glm::dot(now.at, stack.along));
  setCross(view, now);
}

void TurnedTwin::goToNumber(ViewId view, int number) {
  if (!isParallel(view)) return scrollTo(view, number - 1);
  const VoxelGeometry& g = geometry(view);
  TwinCross now = cross(view);
  const double k = (glm::inverse(g.patientFromVoxelStep) * (now.at - g.origin)).z;
  now.at += g.patientFromVoxelStep[2] * (number - 1 - k);
  setCross(view, now);
}

void TurnedTwin::showTime(ViewId view, int time) {
  for (auto& [id, look] : views)
    if (id == view || (id < firstComparedTwin && view < firstComparedTwin)) look.time = time;
}

// The crosshair's point stays at its position on screen, however planes are turned about it.
void TurnedTwin::setCross(ViewId view, const TwinCross& now) {
  const auto places = [&] {
    std::map<ViewId, glm::dvec2> all;
    for (const auto& [id, look] : views) {
      const VoxelGeometry& g = geometry(id);
      const glm::dvec3 centre = g.patientFromVoxelStep * ((glm::dvec3(g.size) - 1.0) / 2.0) + g.origin;
      all[id] = alongPlane(lying(id), now.at - centre);
    }
    return all;
  };
  const auto before = places();
  (isAlone(view) ? own[view] : shared) = now;
  for (const auto& [id, place] : places()) views.at(id).middle += place - before.at(id);
}

void TurnedTwin::turnOthers(ViewId view, double angle) {
  const TwinSeen now = seen(view);
  const glm::dmat3 turned(glm::rotate(glm::dmat4(1), angle, glm::cross(now.right, now.down)));
  TwinCross after = cross(view);
  if (!after.byHand) after.byHand = alongAcquired(geometry(view));
  for (const TwinKind kind : {twinAxial, twinCoronal, twinSagittal})
    if (TwinLying& lying = (*after.byHand)[kind]; kind != views.at(view).kind)
      lying = {turned * lying.right, turned * lying.down};
  setCross(view, after);
}

void TurnedTwin::reset(ViewId view) {
  if (cross(view).byHand) setCross(view, {cross(view).at, {}});
  TwinLook& look = views.at(view);
  const bool wasWhole = look.seen == glm::dmat2(1) && look.middle == glm::dvec2(0) && look.zoom == 1;
  look.seen = glm::dmat2(1), look.middle = {0, 0}, look.zoom = 1, look.slabMm = 0;
  if (!wasWhole) follow(view);
}

// Unlinked views stay where they are. Linked again, all move to the view in focus.
void TurnedTwin::linkScroll(bool linked, ViewId focus) {
  std::vector<ViewId> order = onScreen;
  std::ranges::stable_partition(order, [&](ViewId id) { return id != focus; });
  std::map<ViewId, TwinCross> now;
  for (const ViewId id : order) now[id] = cross(id);
  scroll = linked;
  own.clear();
  for (const ViewId id : order) (isAlone(id) ? own[id] : shared) = now[id];
}

void TurnedTwin::follow(ViewId from) {
  if (!zoom && !pan) return;
  const TwinSeen source = seen(from);
  for (const ViewId id : onScreen) {
    const TwinSeen other = seen(id);
    const double cosine =
        glm::dot(glm::cross(source.right, source.down), glm::cross(other.right, other.down));
    if (id == from || std::abs(cosine) < 0.9) continue;
    TwinLook& look = views.at(id);
    if (zoom) look.zoom = std::clamp(look.zoom * other.mmPerPixel / source.mmPerPixel, leastZoom, mostZoom);
    const VoxelGeometry& g = geometry(id);
    const glm::dvec3 centre = g.patientFromVoxelStep * ((glm::dvec3(g.size) - 1.0) / 2.0) + g.origin;
    if (pan) look.middle = alongPlane(lying(id), source.centre - centre);
  }
}

bool TurnedTwin::isAtTheLimit() const {
  for (const ViewId a : onScreen)
    for (const ViewId b : onScreen) {
      const double cosine = std::abs(glm::dot(lying(a).normal(), lying(b).normal()));
      if (cosine > 0.88 && cosine < 0.92) return true;
    }
  return false;
}

QString twinLetters(glm::dvec3 direction) {
  const glm::dvec3 d = glm::normalize(direction);
  std::vector<std::pair<double, QChar>> sides;
  for (int axis = 0; axis < 3; ++axis)
    sides.emplace_back(-std::abs(d[axis]), QLatin1Char("RLAPIS"[2 * axis + (d[axis] > 0)]));
  std::ranges::stable_sort(sides, {}, &std::pair<double, QChar>::first);
  QString letters;
  for (const auto& [part, letter] : sides)
    if (part < -0.3) letters += letter;
  return letters;
}

}  // namespace volumen::tests
