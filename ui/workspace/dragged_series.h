#pragma once

#include <QString>

namespace volumen {

/// MIME type of a series dragged from a list into a view.
inline const QString draggedSeriesType = QStringLiteral("application/x-volumen-series");

/// MIME type of the picture of a view that is dragged out of the window.
inline const QString draggedPictureType = QStringLiteral("application/x-volumen-picture");

}  // namespace volumen
