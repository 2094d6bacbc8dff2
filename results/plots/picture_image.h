#pragma once

#include <QImage>

#include "viewer/evaluation/truth.h"

namespace volumen {

/// Returns the picture in 8 bits without transparency.
QImage imageOf(const Picture& picture);

/// Returns |picture - truth| of the colours at the truth's pixels, times `magnification`. Ill-conditioned
/// pixels, which do not count, are dark blue.
QImage differenceImage(const Picture& picture, const Truth& truth, double magnification);

}  // namespace volumen
