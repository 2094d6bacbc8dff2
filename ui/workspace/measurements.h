#pragma once

#include <QString>
#include <span>

#include "ui/workspace/session.h"

namespace volumen {

/// Null: there is none of this id.
const Measurement* findMeasurement(const Workspace& workspace, int id);

/// The measurements whose series has this frame of reference, in their order.
std::vector<const Measurement*> measurementsIn(const Workspace& workspace, const std::string& frame);

/// Adds one to a series of the workspace and selects it: one step. The id it got.
int addMeasurement(Session& session, const SeriesKey& series, const Shape& shape);
/// The same for a list of them; the last one is selected. An empty list changes nothing.
void addMeasurements(Session& session, const SeriesKey& series, std::span<const Shape> shapes);

/// Changes one: steps of one text in a gesture are one. Nothing where there is none of this id.
void editMeasurement(Session& session, int id, const QString& text,
                     const std::function<void(Measurement&)>& change);

void renameMeasurement(Session& session, int id, const QString& name);
void deleteMeasurement(Session& session, int id);
void deleteAllMeasurements(Session& session);
void showMeasurements(Session& session, bool shown);

/// The shape moved by so many mm, with its plane.
Shape movedBy(Shape shape, glm::dvec3 mm);

/// The places by which a shape is edited, patient mm: its points; of ellipses and rectangles the corners of
/// the box; of freehand outlines twelve points evenly along it, or all where it has fewer.
std::vector<glm::dvec3> handlesOf(const Shape& shape);

/// The shape with a handle moved to a place (its foot on the plane, where it has one). A corner takes its
/// neighbours along, so that the box stays one; a point of a freehand outline those up to the next handles,
/// the less the further they are.
Shape withHandleAt(Shape shape, std::size_t handle, glm::dvec3 place);

}  // namespace volumen
