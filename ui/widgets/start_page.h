#pragma once

#include <QSet>
#include <QWidget>

class QVBoxLayout;

namespace volumen {

/// The page before anything is opened: three ways to open a study, and recent paths.
class StartPage : public QWidget {
  Q_OBJECT
 public:
  explicit StartPage(QWidget* parent = nullptr);

  /// Shows recent paths, the latest first; those in `gone` are disabled.
  void showRecent(const QStringList& paths, const QSet<QString>& gone);

 Q_SIGNALS:
  void openFolderRequested();
  void openFileRequested();
  void sampleRequested();
  void recentRequested(const QString& path);
  void clearRecentRequested();

 private:
  void addRecent(const QString& path, bool gone);

  QWidget* recent_;
  QVBoxLayout* recentColumn_;
};

}  // namespace volumen
