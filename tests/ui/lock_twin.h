#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "ui/workspace/view_kind.h"

namespace volumen::tests {

/// The views of a grid: the frame of reference, voxels along each axis and spacing in mm of each. The
/// spacings are odd tenths of a mm. No number of steps of one is half a step of another, which rounding would
/// decide.
inline constexpr int lockViews = 4;
inline constexpr int lockFrames[] = {0, 1, 0, 2}, lockSizes[] = {31, 23, 19, 27};
inline constexpr double lockSpacings[] = {1.1, 1.7, 2.3, 1.3};

/// The orientation of a kind of plane: it lies across a patient axis, along which the wheel scrolls.
struct LockKind {
  ViewKind kind;
  int axis;
  double down;
};
inline constexpr LockKind lockKinds[] = {
    {ViewKind::axial, 2, -1}, {ViewKind::coronal, 1, 1}, {ViewKind::sagittal, 0, 1}};

/// A lock made by hand: a position in `from` lies at an offset of `way` mm in `to`.
struct TwinLock {
  int from, to;
  glm::dvec3 way;
};

/// A model of the positions of frames of reference, or of single views, by window.md ("Link views").
struct LockTwin {
  glm::dvec3 at[3];
  std::map<int, glm::dvec3> own;  // by view
  std::vector<TwinLock> locks;
  bool scroll = true;
  int shown = lockViews;  // number of views on screen, from the first

  /// Returns the position of a view, patient mm.
  glm::dvec3 place(int view) const {
    const auto found = own.find(view);
    return !scroll && found != own.end() ? found->second : at[lockFrames[view]];
  }
  /// Returns the offset from one frame of reference to another, mm; empty if they are not locked.
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
  /// Moves a view to a position. All linked views move by the same offset.
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
  /// Moves all frames locked to `from` with it, except those already in `placed`.
  void follow(int from, std::set<int>& placed) {
    if (!placed.insert(from).second) return;
    for (int frame = 0; frame < 3; ++frame)
      if (const auto by = way(from, frame); by && placed.insert(frame).second) at[frame] = at[from] + *by;
  }
  /// Unlinks views where they are, or links them again. Linked views of one frame, and frames locked to it,
  /// take the position of the last view, that in focus.
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
  /// Returns whether a view has another frame of reference than the view in focus, and is locked to it
  /// (`linked`) or not.
  bool isLinkedTo(int view, int focus, bool linked) const {
    return lockFrames[view] != lockFrames[focus] &&
           way(lockFrames[focus], lockFrames[view]).has_value() == linked;
  }
  /// Returns whether isLinkedTo() holds for any view on screen.
  bool isAny(int focus, bool linked) const {
    for (int view = 0; view < shown; ++view)
      if (isLinkedTo(view, focus, linked)) return true;
    return false;
  }
};

}  // namespace volumen::tests
