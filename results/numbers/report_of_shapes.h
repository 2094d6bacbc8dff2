#pragma once

#include "io/report.h"
#include "results/numbers/shape_places.h"
#include "viewer/measure/measure.h"

namespace volumen {

/// Returns a measured shape as a measurement group of TID 1500 that OHIF brings back to life: its tracking
/// identifier names the tool of Cornerstone3D and the shape's name. Numbers are those of `measured`, with
/// UCUM units. A shape on one acquired slice has pixels of that image (0, 0 is the outer corner), other
/// shapes of a volume are in patient space and name the nearest slices. Areas are also the region of the
/// group (TID 1410). The Error says why without the shape's name or full stop: lengths are in pixels, the
/// series is not from DICOM files or has no frame of reference, or a shape on a frame leaves it.
Result<MeasurementGroup> reportedShape(const Shape& shape, const Measured& measured, const MeasuredOn& on);

}  // namespace volumen
