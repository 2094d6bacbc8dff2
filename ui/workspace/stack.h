#pragma once

#include <glm/vec3.hpp>
#include <utility>

#include "results/series/loaded_series.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/key_images.h"

namespace volumen {

/// The positions that a view scrolls through, from 0 at the first end, and their numbers from 1. Acquired
/// slices and frames have their numbers in the series.
struct Stack {
  QString noun{};              ///< name of one position: "Slice"
  StackPlace place{0, 0};      ///< the current position; no positions: nothing is shown
  int number = 0;              ///< number of the picture shown; 0 if it has none
  int numberCount = 0;         ///< how many numbers there are; some may have no position
  std::vector<int> numbers{};  ///< of each position, 0: none; empty: `place` + 1
  PictureSeen seen{};          ///< the acquired picture shown
  bool isAcquired = false;     ///< whether the numbers are those in the series
  std::optional<std::pair<glm::dvec3, glm::dvec3>> toEnds{};  ///< mm from the plane shown, if known

  /// Returns the number of a position; 0 if it has none.
  int numberOf(int position) const;
  /// Returns the position of a number, if it has one.
  std::optional<int> placeOf(int wanted) const;
};

/// Returns a stack whose numbers follow its positions.
Stack countedStack(const QString& noun, StackPlace place);
/// Returns the frames of a series, with frame `index` (from 0) shown.
Stack framesIn(const Series& series, int index);
/// Returns the stack of a flat view as the workspace has it. `shown` is the series in the view; frames need
/// none.
Stack stackIn(const Workspace& workspace, ViewId view, const LoadedSeriesPtr& shown);

/// Returns the positions of the key images of a series in its stack.
std::vector<int> keyImagePlaces(const Workspace& workspace, const Series& series, const Stack& stack);

/// Returns the workspace with a flat view at a position of its stack, at an end if there are fewer. Nothing
/// changes in a view of slices if `shown`, the series in the view, is null.
Workspace withPlace(Workspace workspace, ViewId view, const LoadedSeriesPtr& shown, int position);

}  // namespace volumen
