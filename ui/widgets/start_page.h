#pragma once

#include <QSet>
#include <QWidget>

class QVBoxLayout;

namespace volumen {

/// What is seen before anything is opened: three ways in, and what was opened last.
class StartPage : public QWidget {
  Q_OBJECT
 public:
  explicit StartPage(QWidget* parent = nullptr);

  /// The paths offered, the latest first; those in `gone` cannot be chosen.
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
