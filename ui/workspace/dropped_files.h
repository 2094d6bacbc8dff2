#pragma once

#include <QMimeData>
#include <QStringList>
#include <QUrl>

#include "ui/workspace/dragged_series.h"

namespace volumen {

/// Returns the local files and folders among dropped items. Series and pictures dragged from a window of this
/// program have none, because they are not opened again.
inline QStringList localFiles(const QMimeData& dropped) {
  QStringList paths;
  if (dropped.hasFormat(draggedSeriesType) || dropped.hasFormat(draggedPictureType)) return paths;
  for (const QUrl& url : dropped.urls())
    if (url.isLocalFile()) paths << url.toLocalFile();
  return paths;
}

}  // namespace volumen
