#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "ui/tools/drag.h"
#include "ui/workspace/session.h"
#include "viewer/measure/shape.h"
#include "viewer/segment/mask.h"
#include "viewer/slice/plane.h"

namespace volumen {

class SegmentEditing;
struct SegmentStroke;

/// The state of a view of slices or frames at the press of a button, as tools need it.
struct SlicePress {
  Session& session;
  ViewId view;
  LoadedSeriesPtr series;
  SlicePlane plane;                   ///< in device pixels
  double pixelRatio;                  ///< device pixels per logical pixel
  QPointF at;                         ///< logical pixels
  Window window{};                    ///< the one in use
  std::optional<ShapeFrame> frame{};  ///< the frame shapes are drawn on, if the view shows frames
  Qt::KeyboardModifiers keys{};
  SegmentEditing* segments{};  ///< edits segments; null if no mouse button was pressed

  glm::dvec3 patientAt(QPointF p) const {
    return plane.patientFromPixel({p.x() * pixelRatio, p.y() * pixelRatio});
  }
  QPointF pixelAt(glm::dvec3 pPatient) const {
    const glm::dvec2 p = plane.pixelFromPatient(pPatient) / pixelRatio;
    return {p.x, p.y};
  }
  /// Returns the point `p` in the coordinates of shapes: patient mm, or pixels of the frame.
  glm::dvec3 shapePointAt(QPointF p) const {
    if (!frame) return patientAt(p);
    const glm::dvec3 pixel = series->volume->geometry().voxelFromPatient(patientAt(p));
    return {pixel.x, pixel.y, 0};
  }
};

/// A point on a surface seen in a 3D view.
struct SurfacePoint {
  glm::dvec3 pPatient;  ///< mm
  double softMm;        ///< Shape::softMm
};

/// The state of a 3D view at the press of a button, as tools need it.
struct ScenePress {
  Session& session;
  ViewId view;
  LoadedSeriesPtr series;
  Scene scene;  ///< with the camera in use
  QPointF at;   ///< logical pixels, as is `size`
  glm::dvec2 size;
  Qt::KeyboardModifiers keys;
  std::optional<glm::dvec3> seen;  ///< the point seen there, patient mm; empty if nothing is seen
  /// Sets the camera of the view. Changes with the same `text` within a gesture are one undo step.
  std::function<void(const QString& text, const Camera& camera)> moveCamera;
  /// Removes the material inside or outside an outline.
  std::function<void(const Lasso& lasso)> cut;
  /// Returns the surface seen at a point of the view, with the camera as it is now. Returns nothing if no
  /// surface is seen or the view is a projection.
  std::function<std::optional<SurfacePoint>(QPointF p)> surfaceAt{};
  /// Reports that there is nothing to measure on at this point.
  std::function<void(QPointF p)> missed{};
  SegmentEditing* segments{};  ///< edits segments; null if nothing was pressed for a tool

  const Camera& camera() const { return *scene.camera; }
  /// Returns the point that rotations and pans refer to.
  glm::dvec3 pivot() const { return seen.value_or(*camera().target); }
};

/// A tool for the mouse in slices and frames, in 3D, or in both.
struct Tool {
  const char* name;
  QString text;
  Qt::CursorShape cursor;
  /// Starts the gesture in slices or frames. A null function means that the tool does nothing there; a null
  /// result means that the press was all of it.
  std::unique_ptr<Drag> (*inSlices)(const SlicePress& press) = nullptr;
  std::unique_ptr<SceneDrag> (*inScene)(const ScenePress& press) = nullptr;  ///< the same in 3D
  /// Key that selects the tool in a view where it works; 0 if there is none.
  int key = 0;
  bool measuring = false;  ///< draws a measurement; its icon is "measure-NAME"
  bool stays = false;      ///< stays selected after one drawing, until Esc
  bool looking = false;    ///< changes nothing, whatever is under the pointer
  /// Draws a box or an outline for something other than a measurement.
  bool box = false;
  /// Each press acts at its position, also in quick succession; the tool stays selected until Esc.
  bool clicks = false;
  void (*paintAt)(QPainter& painter,
                  const SlicePress& pointer) = nullptr;  ///< drawn in slices at the pointer
  /// Handles a key in slices. Returns true if the key is consumed.
  bool (*takesKey)(Session& session, int key) = nullptr;
  QString otherWords{};  ///< words by which other programs call it, for the search of commands

  /// Returns whether the tool takes the left button in all views where it works. When it ends, or after Esc,
  /// the tool selected before is active again.
  bool draws() const { return measuring || box || clicks; }
};

/// A part of a measurement under the pointer.
enum class MeasurementPart { handle, line, text };
struct MeasurementHit {
  int id = 0;
  MeasurementPart part = MeasurementPart::line;
  std::size_t handle = 0;    ///< index in handlesOf()
  glm::dvec3 textOffset{0};  ///< Measurement::textOffset of the text as shown
  bool movable = true;       ///< false if the plane only cuts it
};

/// Returns all tools. Each has a file in this folder, which tools.cpp declares; measuring tools share one.
const std::vector<Tool>& tools();
/// Returns the tool with this name, which must exist.
const Tool& toolNamed(std::string_view name);
/// Returns the slice tool with this key, or null.
const Tool* sliceToolOfKey(int key);
/// Returns the 3D tools that have a key and draw nothing, which can be bound to the left button.
std::vector<const Tool*> chosenSceneTools();

/// Draws a lasso. `done` receives it at the end; with Ctrl held it selects the outside.
std::unique_ptr<SceneDrag> drawLasso(const ScenePress& press, std::function<void(const Lasso& lasso)> done);
/// Draws a measurement on the surface seen. Calls missed() and returns null if there is none.
std::unique_ptr<SceneDrag> beginSurfaceShape(const ScenePress& press, ShapeKind kind);
/// Moves a point of a measurement, seen at `seenAt`, over the surface seen. Movements too short for a drag
/// change nothing.
std::unique_ptr<SceneDrag> beginSurfacePoint(const ScenePress& press, int measurement, std::size_t point,
                                             QPointF seenAt);
std::unique_ptr<SceneDrag> beginScenePan(const ScenePress& press);
std::unique_ptr<Drag> beginSlicePan(const SlicePress& press);
/// Returns the press for tools that edit segments. If the Segments panel belongs to the overlaid series, the
/// result has that series and the plane in its patient space.
SlicePress ofPainted(SlicePress press);
/// Returns the beginning of a stroke, without voxels. Ctrl erases.
SegmentStroke strokeOf(const SlicePress& press);
/// Draws an outline by one drag, or point by point. `done` receives its points once it is closed.
std::unique_ptr<Drag> drawOutline(const SlicePress& press,
                                  std::function<void(const std::vector<glm::dvec3>& points)> done);
std::unique_ptr<Drag> beginCrosshair(const SlicePress& press);
/// Limits of Enlarged::factor.
inline constexpr double leastEnlarged = 1.5, mostEnlarged = 8;

/// Rotates the other planes about the crosshair as the pointer circles it.
std::unique_ptr<Drag> beginTurn(const SlicePress& press);
/// Moves a plane perpendicular to its line. `across` is a unit vector in logical pixels.
std::unique_ptr<Drag> beginMovePlane(const SlicePress& press, QPointF across);
/// Moves the pressed part of a measurement.
std::unique_ptr<Drag> beginMeasurementEdit(const SlicePress& press, const MeasurementHit& hit);

/// Returns the speed of window drags relative to the pointer: Shift is fine, Ctrl fast.
double windowDragSpeed(Qt::KeyboardModifiers keys);
/// Returns how the view shows its series.
FlatLook lookOf(const SlicePress& press);
/// Changes how a flat view shows its series. Changes with the same `text` within a gesture are one undo step.
void editFlat(Session& session, ViewId view, const QString& text,
              const std::function<void(FlatLook&)>& change);
/// Scrolls a flat view to a position of its stack (withPlace). Changes within a gesture are one undo step.
void goToPlace(Session& session, ViewId view, const LoadedSeriesPtr& shown, int place);
/// Moves and rotates the crosshair of a view's series.
void setCrosshair(Session& session, ViewId view, const LoadedSeries& series, const QString& text,
                  const Crosshair& after);
/// Moves the crosshair without rotating it.
void moveCrosshair(Session& session, ViewId view, const LoadedSeries& series, const QString& text,
                   glm::dvec3 pPatient);
/// Zooms a flat view about `fixed`, which stays in place. `plane` is the plane of `from`.
void zoomFlat(Session& session, ViewId view, const FlatLook& from, const SlicePlane& plane, glm::dvec3 fixed,
              double factor);

}  // namespace volumen
