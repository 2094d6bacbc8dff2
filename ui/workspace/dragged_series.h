#pragma once

#include <QString>

namespace volumen {

/// MIME type of a series dragged from a list into a view.
inline const QString draggedSeriesType = QStringLiteral("application/x-volumen-series");

}  // namespace volumen
