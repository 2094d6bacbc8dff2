#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/numbers/shape_places.h"
#include "viewer/slice/presentation.h"

namespace volumen {

/// A shape as a presentation state draws it on one acquired image.
struct ShapeAnnotation {
  ReferencedPicture picture;        ///< the image, with its frame
  std::vector<Graphic> graphics;    ///< in pixels; none for a label
  std::optional<GraphicText> text;  ///< at the shape's rightmost point; empty without words
};

/// Returns a shape as graphics of the image that it lies on, with `words` (UTF-8) beside it, all in one
/// layer. Empty if the shape has no place, lies on no acquired slice (within 0.01 mm) or leaves its image.
std::optional<ShapeAnnotation> annotationOf(const Shape& shape, const MeasuredOn& on,
                                            const std::string& words, const std::string& layer);

}  // namespace volumen
