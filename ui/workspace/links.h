#pragma once

#include <map>
#include <optional>
#include <string>

#include "ui/workspace/workspace.h"

namespace volumen {

/// The relation of positions in two frames of reference.
struct FrameRelation {
  Rigid toFromFrom;
  bool byHand = false, registered = false;  ///< neither: both are the same frame of reference
};

/// Returns the relation of two frames of reference, also through others; empty if they are not linked.
std::optional<FrameRelation> relationOf(const Workspace& workspace, const std::string& from,
                                        const std::string& to);

/// A series overlaid on another.
struct SeriesOver {
  SeriesKey series;
  Rigid toFromUnder;  ///< from the patient space of the series under it
  bool operator==(const SeriesOver&) const = default;
};

/// Returns the overlay on `under` in a view of slices on screen, the view in focus first. Empty if no view
/// has one or their frames of reference are not linked.
std::optional<SeriesOver> seriesOver(const Workspace& workspace, const SeriesKey& under);

/// Sizes of the pictures of views, in device pixels.
using ViewSizes = std::map<ViewId, glm::ivec2>;

/// Applies a change to linked views. Positions go to linked frames of reference, in mm, never by slice
/// number. The mm per pixel and the patient's point in the middle go to flat views on screen with planes
/// parallel within 25 degrees. Windows go to series on screen of the same modality and unit.
Workspace withLinksFollowed(const Workspace& before, Workspace after, const ViewSizes& sizes);

/// Links positions, or lets each comparison view scroll on its own from its present position. Linked views
/// take the position of the view in focus, else of the last of their views on screen.
Workspace withScrollLinked(Workspace workspace, bool linked);

/// Returns flat views on screen with slices in frames of reference other than that of the view in focus.
std::vector<ViewId> viewsOfOtherFrames(const Workspace& workspace);

/// Links the frames of reference of other views on screen to the one in focus by their present positions.
Workspace lockedHere(Workspace workspace);
/// Links two frames of reference by a registration and moves `to` to the position of `from`.
Workspace withRegistration(Workspace workspace, const std::string& from, const std::string& to,
                           const Rigid& toFromFrom);
/// Removes links between frames of reference on screen, and overlays that need them.
Workspace unlocked(Workspace workspace);
bool canLock(const Workspace& workspace);
bool canRegister(const Workspace& workspace);
bool canUnlock(const Workspace& workspace);

}  // namespace volumen
