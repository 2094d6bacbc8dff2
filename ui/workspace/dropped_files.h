#pragma once

#include <QMimeData>
#include <QStringList>
#include <QUrl>

namespace volumen {

/// The files and folders of this machine among what is dropped.
inline QStringList localFiles(const QMimeData& dropped) {
  QStringList paths;
  for (const QUrl& url : dropped.urls())
    if (url.isLocalFile()) paths << url.toLocalFile();
  return paths;
}

}  // namespace volumen
