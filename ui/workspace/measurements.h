#pragma once

#include <QString>
#include <span>

#include "ui/data/loaded_frame.h"
#include "ui/workspace/session.h"
#include "viewer/measure/frame_measure.h"

namespace volumen {

/// Null: there is none of this id.
const Measurement* findMeasurement(const Workspace& workspace, int id);

/// The measurements of the patient whose series has this frame of reference, in their order.
std::vector<const Measurement*> measurementsIn(const Workspace& workspace, const std::string& frame);

/// Those that were drawn on a frame of a series, in their order.
std::vector<const Measurement*> measurementsOn(const Workspace& workspace, const Series& series, int frame);

/// What names a frame of a series (from 0) whatever else the series holds.
ShapeFrame frameNamed(const Series& series, int frame);
/// Which one that is; none: the series does not hold it.
std::optional<int> frameMeant(const Series& series, const ShapeFrame& name);

/// A frame as it is measured on.
FramePixels pixelsOf(const LoadedFrame& frame);

/// Adds one to a series of the workspace and selects it: one step. The id it got.
int addMeasurement(Session& session, const SeriesKey& series, const Shape& shape);
/// The same for a list of them; the last one is selected. An empty list changes nothing.
void addMeasurements(Session& session, const SeriesKey& series, std::span<const Shape> shapes);

/// Changes one: steps of one text in a gesture are one. Nothing where there is none of this id.
void editMeasurement(Session& session, int id, const QString& text,
                     const std::function<void(Measurement&)>& change);

/// Whether one that was just made is to be given its text: an arrow, the first label of a series, what has no
/// name to follow another's.
bool isToBeNamed(const Workspace& workspace, const Measurement& made);

void renameMeasurement(Session& session, int id, const QString& name);
void deleteMeasurement(Session& session, int id);
void deleteAllMeasurements(Session& session);
void showMeasurements(Session& session, bool shown);

/// The shape moved by so many mm, with its plane; of frames by so many pixels.
Shape movedBy(Shape shape, glm::dvec3 way);

/// The places by which a shape is edited, where its points are: its points; of ellipses and rectangles the
/// corners of the box; of freehand outlines twelve points evenly along it, or all where it has fewer.
std::vector<glm::dvec3> handlesOf(const Shape& shape);

/// The shape with a handle moved to a place (its foot on the plane, where it has one). A corner takes its
/// neighbours along, so that the box stays one; a point of a freehand outline those up to the next handles,
/// the less the further they are. Axes stay at right angles: the short one turns with the long one, and moves
/// along it as a whole; the widths of a chest keep their direction. `unit`: how long steps of the points'
/// coordinates are, of frames the size of a pixel.
Shape withHandleAt(Shape shape, std::size_t handle, glm::dvec3 place, glm::dvec3 unit = glm::dvec3(1));

}  // namespace volumen
