#pragma once

#include <QMimeData>
#include <QStringList>
#include <QUrl>

#include "ui/workspace/dragged_series.h"

namespace volumen {

/// Returns the local files and folders among dropped items; none of a series dragged from a list of series,
/// which is not opened again.
inline QStringList localFiles(const QMimeData& dropped) {
  QStringList paths;
  if (dropped.hasFormat(draggedSeriesType)) return paths;
  for (const QUrl& url : dropped.urls())
    if (url.isLocalFile()) paths << url.toLocalFile();
  return paths;
}

}  // namespace volumen
