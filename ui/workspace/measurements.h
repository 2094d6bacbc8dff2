#pragma once

#include <QString>
#include <span>

#include "results/numbers/measurement_chart.h"
#include "results/series/loaded_frame.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Returns the measurement with this id, or null.
const Measurement* findMeasurement(const Workspace& workspace, int id);

/// Returns the measurements in patient space of series with this frame of reference, in their order.
std::vector<const Measurement*> measurementsIn(const Workspace& workspace, const std::string& frame);

/// Returns the measurements drawn on a frame of a series, in their order.
std::vector<const Measurement*> measurementsOn(const Workspace& workspace, const Series& series, int frame);

/// Adds a measurement to a series of the workspace and selects it, in one undo step. Returns its id.
int addMeasurement(Session& session, const SeriesKey& series, const Shape& shape);
/// Adds several measurements in one undo step and selects the last. An empty list changes nothing.
void addMeasurements(Session& session, const SeriesKey& series, std::span<const Shape> shapes);

/// Changes a measurement. Edits with one text in one gesture are one undo step. Ignores unknown ids.
void editMeasurement(Session& session, int id, const QString& text,
                     const std::function<void(Measurement&)>& change);

/// Returns whether a new measurement needs a text from the user. This holds for arrows, the first label of a
/// series, and labels without a name to continue from.
bool isToBeNamed(const Workspace& workspace, const Measurement& made);

void renameMeasurement(Session& session, int id, const QString& name);
void deleteMeasurement(Session& session, int id);
void deleteAllMeasurements(Session& session);
void showMeasurements(Session& session, bool shown);

/// Returns the shape and its plane moved by `way`, mm; on frames, pixels.
Shape movedBy(Shape shape, glm::dvec3 way);

/// Returns the positions of the handles of a shape: its points. Ellipses and rectangles have the corners of
/// the box. Freehand outlines have twelve points evenly along them, or all if there are fewer.
std::vector<glm::dvec3> handlesOf(const Shape& shape);

/// Returns the shape with a handle moved to `place`, projected onto the shape's plane if it has one. A box
/// stays a box. On a freehand outline, points follow up to the next handles, less with distance. Axes stay
/// perpendicular: the short one turns with the long one and moves along it as a whole. Chest widths keep
/// their direction. `unit` is the length of a coordinate step; on frames, the pixel size.
Shape withHandleAt(Shape shape, std::size_t handle, glm::dvec3 place, glm::dvec3 unit = glm::dvec3(1));

/// Returns the charts of a measurement, the default first; empty if it has none.
std::vector<ChartKind> chartsOf(const Workspace& workspace, const Measurement& measurement);

}  // namespace volumen
