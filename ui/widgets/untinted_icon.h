#pragma once

#include <QIcon>
#include <QImage>

namespace volumen {

/// A picture as an icon that looks the same where its row is selected: selection must not colour the greys.
QIcon untintedIcon(const QImage& image);

}  // namespace volumen
