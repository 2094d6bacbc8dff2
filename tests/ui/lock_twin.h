#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "ui/workspace/view_kind.h"

namespace volumen::tests {

/// The views of a grid: of each the frame of reference, voxels along each axis, and their mm. Odd tenths of a
/// mm: no number of steps of some is half a step of another, which rounding would decide.
inline constexpr int lockViews = 4;
inline constexpr int lockFrames[] = {0, 1, 0, 2}, lockSizes[] = {31, 23, 19, 27};
inline constexpr double lockSpacings[] = {1.1, 1.7, 2.3, 1.3};

/// How a kind of plane lies: across an axis of the patient, along which the wheel goes.
struct LockKind {
  ViewKind kind;
  int axis;
  double down;
};
inline constexpr LockKind lockKinds[] = {
    {ViewKind::axial, 2, -1}, {ViewKind::coronal, 1, 1}, {ViewKind::sagittal, 0, 1}};

/// What is locked by hand: a place of `from` lies this far on in `to`.
struct TwinLock {
  int from, to;
  glm::dvec3 way;
};

/// Where each frame of reference is, or each view alone, by window.md ("Link views").
struct LockTwin {
  glm::dvec3 at[3];
  std::map<int, glm::dvec3> own;  // by view
  std::vector<TwinLock> locks;
  bool scroll = true;
  int shown = lockViews;  // the first so many

  /// Of a view, patient mm.
  glm::dvec3 place(int view) const {
    const auto found = own.find(view);
    return !scroll && found != own.end() ? found->second : at[lockFrames[view]];
  }
  /// From the places of one frame of reference to those of another, mm; none: they are not locked.
  std::optional<glm::dvec3> way(int from, int to) const {
    std::vector<std::pair<int, glm::dvec3>> reached{{from, {0, 0, 0}}};
    std::set<int> seen{from};
    for (std::size_t n = 0; n < reached.size(); ++n) {
      const auto [frame, on] = reached[n];
      if (frame == to) return on;
      for (const TwinLock& lock : locks) {
        if (lock.from == frame && seen.insert(lock.to).second) reached.emplace_back(lock.to, on + lock.way);
        if (lock.to == frame && seen.insert(lock.from).second) reached.emplace_back(lock.from, on - lock.way);
      }
    }
    return {};
  }
  /// To a place of a view; all that are linked move by the same mm.
  void move(int view, glm::dvec3 to) {
    if (!scroll) {
      own[view] = to;
      return;
    }
    const int moved = lockFrames[view];
    at[moved] = to;
    for (int frame = 0; frame < 3; ++frame)
      if (const auto by = way(moved, frame); by && frame != moved) at[frame] = to + *by;
  }
  /// What is locked to a frame takes its place, but for those that have theirs.
  void follow(int from, std::set<int>& placed) {
    if (!placed.insert(from).second) return;
    for (int frame = 0; frame < 3; ++frame)
      if (const auto by = way(from, frame); by && placed.insert(frame).second) at[frame] = at[from] + *by;
  }
  /// Each stays where it is; linked again, those of one frame, and what is locked to it, are where the last
  /// one is, that in focus.
  void linkScroll(bool on, int focus) {
    std::map<int, glm::dvec3> now;
    for (int view = 0; view < shown; ++view) now[view] = place(view);
    scroll = on;
    own.clear();
    if (!on) own = now;
    for (int view = 0; on && view < shown; ++view) at[lockFrames[view]] = now[view];
    if (!on) return;
    at[lockFrames[focus]] = now[focus];
    std::set<int> placed;
    follow(lockFrames[focus], placed);
    for (int view = shown - 1; view >= 0; --view) follow(lockFrames[view], placed);
  }
  /// Whether a view is of another frame of reference than that in focus, and locked to it or not.
  bool isLinkedTo(int view, int focus, bool linked) const {
    return lockFrames[view] != lockFrames[focus] &&
           way(lockFrames[focus], lockFrames[view]).has_value() == linked;
  }
  /// Whether any on screen is so.
  bool isAny(int focus, bool linked) const {
    for (int view = 0; view < shown; ++view)
      if (isLinkedTo(view, focus, linked)) return true;
    return false;
  }
};

}  // namespace volumen::tests
