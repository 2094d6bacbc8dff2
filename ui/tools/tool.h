#pragma once

#include <QString>
#include <memory>
#include <vector>

#include "ui/tools/drag.h"
#include "ui/workspace/session.h"
#include "viewer/measure/shape.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// A flat view when the mouse was pressed, as far as tools know it.
struct FlatPress {
  Session& session;
  ViewId view;
  ShownSeriesPtr series;
  SlicePlane plane;                   ///< in device pixels
  double pixelRatio;                  ///< device pixels a logical one
  QPointF at;                         ///< logical pixels
  Window window{};                    ///< in use
  std::optional<ShapeFrame> frame{};  ///< of frames: which; shapes are drawn on it

  glm::dvec3 patientAt(QPointF p) const {
    return plane.patientFromPixel({p.x() * pixelRatio, p.y() * pixelRatio});
  }
  QPointF pixelAt(glm::dvec3 pPatient) const {
    const glm::dvec2 p = plane.pixelFromPatient(pPatient) / pixelRatio;
    return {p.x, p.y};
  }
  /// Where shapes have a point: in the patient, or in pixels of the frame.
  glm::dvec3 shapePointAt(QPointF p) const {
    if (!frame) return patientAt(p);
    const glm::dvec3 pixel = series->volume->geometry().voxelFromPatient(patientAt(p));
    return {pixel.x, pixel.y, 0};
  }
};

/// What a drag in a flat view does.
struct FlatTool {
  const char* name;
  QString text;
  Qt::CursorShape cursor;
  std::unique_ptr<Drag> (*begin)(const FlatPress& press);
  int key = 0;             ///< chooses it in a flat view; 0: none
  bool measuring = false;  ///< draws a measurement; its icon is "measure-NAME"
};

/// A part of a measurement under the pointer.
enum class MeasurementPart { handle, line, text };
struct MeasurementHit {
  int id = 0;
  MeasurementPart part = MeasurementPart::line;
  std::size_t handle = 0;    ///< which of handlesOf()
  glm::dvec3 textOffset{0};  ///< of where its text stands now (Measurement::textOffset)
  bool movable = true;       ///< false: the plane only cuts it
};

/// All of them; each is a file of this folder, those that measure are one.
const std::vector<FlatTool>& flatTools();
/// The tool of this name; there must be one.
const FlatTool& flatTool(const char* name);
/// The tool of a key; null: it is none's.
const FlatTool* flatToolOfKey(int key);

std::unique_ptr<Drag> beginWindow(const FlatPress& press);
std::unique_ptr<Drag> beginPan(const FlatPress& press);
std::unique_ptr<Drag> beginFlatZoom(const FlatPress& press);
std::unique_ptr<Drag> beginScroll(const FlatPress& press);
std::unique_ptr<Drag> beginCrosshair(const FlatPress& press);

/// Turns the other planes about the crosshair as the pointer goes around it.
std::unique_ptr<Drag> beginTurn(const FlatPress& press);
/// Moves a plane across its line; `across`: a unit vector, logical pixels.
std::unique_ptr<Drag> beginMovePlane(const FlatPress& press, QPointF across);
/// Those that draw a measurement, one a kind that is drawn.
std::vector<FlatTool> measuringTools();
/// Moves the part of a measurement that was pressed.
std::unique_ptr<Drag> beginMeasurementEdit(const FlatPress& press, const MeasurementHit& hit);

/// How the view shows its series.
FlatLook lookOf(const FlatPress& press);
/// Changes how a flat view shows its series; steps of one name in a gesture are one.
void editFlat(Session& session, ViewId view, const QString& text,
              const std::function<void(FlatLook&)>& change);
/// Shows another frame of a view that shows frames; as many as there are.
void showFrame(Session& session, ViewId view, int frame);
/// Moves the crosshair of a view's series, and turns it.
void setCrosshair(Session& session, ViewId view, const ShownSeries& series, const QString& text,
                  const Crosshair& after);
/// Moves it alone.
void moveCrosshair(Session& session, ViewId view, const ShownSeries& series, const QString& text,
                   glm::dvec3 pPatient);
/// Enlarges a flat view about a point, which stays where it is. `plane` shows `from`.
void zoomFlat(Session& session, ViewId view, const FlatLook& from, const SlicePlane& plane, glm::dvec3 fixed,
              double factor);

}  // namespace volumen
