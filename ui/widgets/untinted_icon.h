#pragma once

#include <QIcon>
#include <QImage>

namespace volumen {

/// Returns an icon that looks the same in selected rows: selection must not tint the greys.
QIcon untintedIcon(const QImage& image);

}  // namespace volumen
