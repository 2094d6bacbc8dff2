#pragma once

#include <QImage>

#include "ui/controller/segment_layer.h"

namespace volumen {

/// Mixes the shown labels of a layer into a picture of a plane, of Format_RGB32: their insides, and along
/// their borders an outline 1.5 pixels wide.
void paintLabels(QImage& picture, const SlicePlane& plane, const SegmentLayer& layer);

}  // namespace volumen
