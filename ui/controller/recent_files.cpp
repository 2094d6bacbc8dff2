#include "ui/controller/recent_files.h"

#include <QDir>
#include <QFileInfo>
#include <QSettings>

namespace volumen {

namespace {
constexpr int mostFiles = 10;
QString key() { return QStringLiteral("recent"); }
}  // namespace

RecentFiles::RecentFiles(QObject* parent)
    : QObject(parent), paths_(QSettings().value(key()).toStringList().mid(0, mostFiles)) {}

void RecentFiles::add(const QString& path) {
  const QString whole = QDir::cleanPath(QFileInfo(path).absoluteFilePath());
  if (!QFileInfo::exists(whole)) return;
  QStringList paths = paths_;
  paths.removeAll(whole);
  paths.prepend(whole);
  gone_.remove(whole);
  setPaths(paths.mid(0, mostFiles));
}

void RecentFiles::clear() { setPaths({}); }

void RecentFiles::setPaths(const QStringList& paths) {
  paths_ = paths;
  QSettings().setValue(key(), paths);
  Q_EMIT changed();
}

void RecentFiles::look() {
  lane_.giveUpAll();
  lane_.run(
      {},
      [paths = paths_](const Job&) {
        QSet<QString> gone;
        for (const QString& path : paths)
          if (!QFileInfo::exists(path)) gone.insert(path);
        return gone;
      },
      [this](const QSet<QString>& gone) {
        if (gone == gone_) return;
        gone_ = gone;
        Q_EMIT changed();
      });
}

}  // namespace volumen
