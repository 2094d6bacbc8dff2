#pragma once

#include <QImage>

#include "viewer/volume/picture.h"

namespace volumen {

/// The 8-bit picture, transparency left out.
QImage imageOf(const Picture& picture);

}  // namespace volumen
