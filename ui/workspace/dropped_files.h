#pragma once

#include <QMimeData>
#include <QStringList>
#include <QUrl>

namespace volumen {

/// Returns the local files and folders among dropped items.
inline QStringList localFiles(const QMimeData& dropped) {
  QStringList paths;
  for (const QUrl& url : dropped.urls())
    if (url.isLocalFile()) paths << url.toLocalFile();
  return paths;
}

}  // namespace volumen
