#pragma once

#include <map>
#include <optional>
#include <string>

#include "ui/workspace/workspace.h"

namespace volumen {

/// How positions of one frame of reference are found in another.
struct FrameRelation {
  Rigid toFromFrom;
  bool byHand = false, registered = false;  ///< neither: it is one frame
};

/// None: the frames are not linked, not through others either.
std::optional<FrameRelation> relationOf(const Workspace& workspace, const std::string& from,
                                        const std::string& to);

/// A series that lies over another one.
struct SeriesOver {
  SeriesKey series;
  Rigid toFromUnder;  ///< from the patient space of the one under it
  bool operator==(const SeriesOver&) const = default;
};

/// The series that a view of slices on screen shows over this one, that of the focus first; none: no view
/// does, or their frames of reference are not linked.
std::optional<SeriesOver> seriesOver(const Workspace& workspace, const SeriesKey& under);

/// How large the pictures of views are, device pixels.
using ViewSizes = std::map<ViewId, glm::ivec2>;

/// A change, carried on to what is linked: positions to linked frames of reference (mm, never numbers of
/// slices), and of the flat views on screen whose planes are parallel within 25 degrees the mm per pixel and
/// the patient's point in the middle; windows to series on screen of the same modality and unit.
Workspace withLinksFollowed(const Workspace& before, Workspace after, const ViewSizes& sizes);

/// With positions linked, or each of the compared views on its own from where it is. What is linked takes the
/// place of the view in focus, or else of the last of its views on screen.
Workspace withScrollLinked(Workspace workspace, bool linked);

/// The flat views on screen that show slices of series in other frames of reference than the one in focus.
std::vector<ViewId> viewsOfOtherFrames(const Workspace& workspace);

/// With the views on screen of other frames of reference linked to the one in focus by what they show now.
Workspace lockedHere(Workspace workspace);
/// With two frames of reference linked by a registration, and the positions of `to` at those of `from`.
Workspace withRegistration(Workspace workspace, const std::string& from, const std::string& to,
                           const Rigid& toFromFrom);
/// Without the links between frames of reference on screen, and without overlays that need them.
Workspace unlocked(Workspace workspace);
bool canLock(const Workspace& workspace);
bool canRegister(const Workspace& workspace);
bool canUnlock(const Workspace& workspace);

}  // namespace volumen
