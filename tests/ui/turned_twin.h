#pragma once

#include <QString>
#include <array>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <map>
#include <optional>
#include <vector>

#include "tests/fixtures/slice_twin.h"
#include "ui/workspace/view_id.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// How a plane lies in the patient before its picture is turned.
struct TwinLying {
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};
  glm::dvec3 normal() const { return glm::cross(right, down); }
};
enum TwinKind { twinAxial, twinCoronal, twinSagittal };
using TwinLyings = std::array<TwinLying, 3>;  ///< by TwinKind

/// slices.md 1's named planes.
TwinLyings alongPatient();
/// Its planes along the slices as acquired: of the 24 turns of the axes the smallest.
TwinLyings alongAcquired(const VoxelGeometry& geometry);

/// Where three planes meet, and how they lie; none: for each series along its slices.
struct TwinCross {
  glm::dvec3 at{0};
  std::optional<TwinLyings> byHand;
};

/// How a view shows its series.
struct TwinLook {
  int series = 0;
  TwinKind kind = twinAxial;
  glm::dmat2 seen{1};    ///< what was done to the picture: turns and mirrors, x right and y down
  glm::dvec2 middle{0};  ///< mm of the view's middle from the volume's centre, along the plane as it lies
  double zoom = 1;       ///< of the picture that shows all
  bool inverted = false;
  int over = -1;  ///< the series over it; -1: none
  int time = 0;   ///< the time point of the series, from 0
  double slabMm = 0;
  TwinSlab slab = TwinSlab::max;
};

/// A line or rectangle that was drawn in a view.
struct TwinShape {
  int id = 0;
  bool isLine = true;
  glm::dvec3 from{0}, to{0};
  QString said;  ///< its first line of text
};

/// What is on screen of a view: places are device pixels.
struct TwinSeen : TwinPlane {
  glm::dvec2 placeOf(glm::dvec3 p) const;
  glm::dvec3 patientAt(glm::dvec2 place) const;
  /// mm behind the plane.
  double depthOf(glm::dvec3 p) const;
};

/// Where each position of the patient must appear in views of slices, by slices.md 1 and window.md ("Move the
/// planes", "Link views") alone: shares no code with the window. All series are of one frame of reference.
struct TurnedTwin {
  static constexpr double leastZoom = 0.05, mostZoom = 200;  ///< how small and large pictures are at most
  std::vector<VolumePtr> volumes;
  std::map<ViewId, TwinLook> views;
  std::map<ViewId, glm::ivec2> sizes;  ///< of views, device pixels
  std::vector<ViewId> onScreen;        ///< of these
  TwinCross shared;
  std::map<ViewId, TwinCross> own;  ///< of views that scroll each for itself
  bool scroll = true, zoom = false, pan = false;
  std::vector<TwinShape> shapes;

  const VoxelGeometry& geometry(ViewId view) const {
    return volumes[std::size_t(views.at(view).series)]->geometry();
  }
  TwinSeen seen(ViewId view) const;
  TwinLying lying(ViewId view) const;
  const TwinCross& cross(ViewId view) const;
  /// Which step of the wheel the view is at, from 0, and of how many.
  std::pair<int, int> place(ViewId view) const;
  /// What the corner says of it.
  QString number(ViewId view) const;
  /// Where the plane lies along its axis, "S 12.5 mm"; "oblique".
  QString position(ViewId view) const;
  /// How thick it is, "MIP 10.0 mm"; empty: a plane.
  QString slab(ViewId view) const;
  /// Of how many the number of the picture is one: slices as acquired, else steps of the wheel.
  int numberCount(ViewId view) const;

  void turn(ViewId view, glm::dmat2 by);
  void panBy(ViewId view, glm::dvec2 pixels);
  void zoomAt(ViewId view, glm::dvec2 place, double mmPerPixel);
  void scrollTo(ViewId view, int place);
  /// To the picture that has this number, from 1.
  void goToNumber(ViewId view, int number);
  /// Another time point, in all views of the group.
  void showTime(ViewId view, int time);
  void setCross(ViewId view, const TwinCross& now);
  /// The planes of the other kinds turned about the crosshair, by an angle on screen, clockwise.
  void turnOthers(ViewId view, double angle);
  void reset(ViewId view);
  void linkScroll(bool linked, ViewId focus);
  /// Zoom and pan of a view go to those on screen whose planes are parallel within 25 degrees.
  void follow(ViewId from);
  /// Whether two planes are so close to these degrees that rounding decides.
  bool isAtTheLimit() const;

 private:
  bool isParallel(ViewId view) const;
  bool isAlone(ViewId view) const { return !scroll && view >= firstComparedTwin; }
  static constexpr ViewId firstComparedTwin = 4;
};

/// The letters of a side: each axis that makes more than 0.3 of the direction, the largest first.
QString twinLetters(glm::dvec3 direction);

}  // namespace volumen::tests
