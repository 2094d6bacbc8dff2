#pragma once

#include <QImage>

#include "viewer/evaluation/truth.h"

namespace volumen {

/// The 8-bit picture, transparency left out.
QImage imageOf(const Picture& picture);

/// |picture - truth| of the colours at the truth's pixels, so many times as large; pixels that are
/// ill-conditioned and do not count are dark blue.
QImage differenceImage(const Picture& picture, const Truth& truth, double magnification);

}  // namespace volumen
