#pragma once

#include <QSet>
#include <QStringList>

#include "ui/document/job_lane.h"

namespace volumen {

/// The files and folders opened last, the latest first; kept in the settings.
class RecentFiles : public QObject {
  Q_OBJECT
 public:
  explicit RecentFiles(QObject* parent = nullptr);

  const QStringList& paths() const { return paths_; }
  /// Whether it was not there when it was last looked for.
  bool isGone(const QString& path) const { return gone_.contains(path); }
  /// Not what exists nowhere, such as phantoms.
  void add(const QString& path);
  void clear();
  /// Looks which are still there, on a thread of its own: a folder of the network may take its time.
  void look();

 Q_SIGNALS:
  void changed();

 private:
  void setPaths(const QStringList& paths);

  QStringList paths_;
  QSet<QString> gone_;
  JobLane lane_;
};

}  // namespace volumen
