#pragma once

#include <QSet>
#include <QStringList>

#include "ui/document/job_lane.h"

namespace volumen {

/// The files and folders opened last, latest first, stored in the settings.
class RecentFiles : public QObject {
  Q_OBJECT
 public:
  explicit RecentFiles(QObject* parent = nullptr);

  const QStringList& paths() const { return paths_; }
  /// Returns whether the path was missing at the last check.
  bool isGone(const QString& path) const { return gone_.contains(path); }
  /// Adds a path; ignores paths that do not exist, such as phantoms.
  void add(const QString& path);
  void clear();
  /// Checks on its own thread which paths still exist, because network folders may be slow.
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
