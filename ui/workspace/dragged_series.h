#pragma once

#include <QString>

namespace volumen {

/// What a series is dragged as, from the lists of series into views.
inline const QString draggedSeriesType = QStringLiteral("application/x-volumen-series");

}  // namespace volumen
