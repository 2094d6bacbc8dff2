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

/// The orientation of a plane in the patient before its picture is turned.
struct TwinLying {
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};
  glm::dvec3 normal() const { return glm::cross(right, down); }
};
enum TwinKind { twinAxial, twinCoronal, twinSagittal };
using TwinLyings = std::array<TwinLying, 3>;  ///< by TwinKind

/// Returns the named planes of slices.md 1.
TwinLyings alongPatient();
/// Returns the planes along the acquired slices: the smallest of the 24 rotations of the axes.
TwinLyings alongAcquired(const VoxelGeometry& geometry);

/// The crossing of three planes and their orientation. If empty, planes follow each series' slices.
struct TwinCross {
  glm::dvec3 at{0};
  std::optional<TwinLyings> byHand;
};

/// The state in which a view shows its series.
struct TwinLook {
  int series = 0;
  TwinKind kind = twinAxial;
  glm::dmat2 seen{1};  ///< effect on the picture: turns and mirrors, x right and y down
  /// Offset of the view's middle from the volume's centre, mm along the unturned plane.
  glm::dvec2 middle{0};
  double zoom = 1;  ///< relative to the picture that shows everything
  bool inverted = false;
  int over = -1;  ///< series that overlays it; -1 if none
  int time = 0;   ///< time point of the series, from 0
  double slabMm = 0;
  TwinSlab slab = TwinSlab::max;
};

/// A line or rectangle drawn in a view.
struct TwinShape {
  int id = 0;
  bool isLine = true;
  glm::dvec3 from{0}, to{0};
  QString said;  ///< its first line of text
};

/// A view on screen. Positions are device pixels.
struct TwinSeen : TwinPlane {
  glm::dvec2 placeOf(glm::dvec3 p) const;
  glm::dvec3 patientAt(glm::dvec2 place) const;
  /// Returns the distance behind the plane, mm.
  double depthOf(glm::dvec3 p) const;
};

/// Predicts where patient positions appear in views of slices. It follows only slices.md 1 and window.md
/// ("Move the planes", "Link views") and shares no code with the window. All series have one frame of
/// reference.
struct TurnedTwin {
  static constexpr double leastZoom = 0.05, mostZoom = 200;  ///< limits of the zoom
  std::vector<VolumePtr> volumes;
  std::map<ViewId, TwinLook> views;
  std::map<ViewId, glm::ivec2> sizes;  ///< sizes of views, device pixels
  std::vector<ViewId> onScreen;        ///< those of them on screen
  TwinCross shared;
  std::map<ViewId, TwinCross> own;  ///< of views that scroll unlinked
  bool scroll = true, zoom = false, pan = false;
  std::vector<TwinShape> shapes;

  const VoxelGeometry& geometry(ViewId view) const {
    return volumes[std::size_t(views.at(view).series)]->geometry();
  }
  TwinSeen seen(ViewId view) const;
  TwinLying lying(ViewId view) const;
  const TwinCross& cross(ViewId view) const;
  /// Returns the view's wheel step, from 0, and the number of steps.
  std::pair<int, int> place(ViewId view) const;
  /// Returns the number in the corner text.
  QString number(ViewId view) const;
  /// Returns the plane's position along its axis, such as "S 12.5 mm", or "oblique".
  QString position(ViewId view) const;
  /// Returns the slab's thickness, such as "MIP 10.0 mm"; empty for a plane.
  QString slab(ViewId view) const;
  /// Returns the count to which the picture's number refers: acquired slices, else wheel steps.
  int numberCount(ViewId view) const;

  void turn(ViewId view, glm::dmat2 by);
  void panBy(ViewId view, glm::dvec2 pixels);
  void zoomAt(ViewId view, glm::dvec2 place, double mmPerPixel);
  void scrollTo(ViewId view, int place);
  /// Scrolls to the picture with this number, from 1.
  void goToNumber(ViewId view, int number);
  /// Shows another time point in all views of the group.
  void showTime(ViewId view, int time);
  void setCross(ViewId view, const TwinCross& now);
  /// Turns the planes of the other kinds about the crosshair by an angle on screen, clockwise.
  void turnOthers(ViewId view, double angle);
  void reset(ViewId view);
  void linkScroll(bool linked, ViewId focus);
  /// Copies zoom and pan of a view to those on screen whose planes are parallel within 25 degrees.
  void follow(ViewId from);
  /// Returns whether two planes are so close to that angle that rounding decides.
  bool isAtTheLimit() const;

 private:
  bool isParallel(ViewId view) const;
  bool isAlone(ViewId view) const { return !scroll && view >= firstComparedTwin; }
  static constexpr ViewId firstComparedTwin = 4;
};

/// Returns the letters of a side: each axis with more than 0.3 of the direction, the largest first.
QString twinLetters(glm::dvec3 direction);

}  // namespace volumen::tests
