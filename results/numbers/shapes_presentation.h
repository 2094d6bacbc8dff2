#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/numbers/measured_shape.h"
#include "results/pictures/picture_greys.h"

namespace volumen {

/// Draws shapes with their names and numbers on the pictures of a presentation state, in a layer
/// "MEASUREMENTS", and labels it so. Shapes that lie on none of its pictures are left out, with a note in
/// `shown`. The Error begins with the name of a shape that cannot be measured.
Status drawShapes(std::span<const ShapeToMeasure> shapes, const SeriesPictures& pictures, PictureGreys& shown,
                  const CancelToken& cancel);

}  // namespace volumen
