#pragma once

#include <QWidget>

namespace volumen {

/// What is seen before anything is opened: three ways in.
class StartPage : public QWidget {
  Q_OBJECT
 public:
  explicit StartPage(QWidget* parent = nullptr);

 Q_SIGNALS:
  void openFolderRequested();
  void openFileRequested();
  void sampleRequested();
};

}  // namespace volumen
