#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <QWidget>

namespace volumen {

/// How far an import is, with a button to cancel it; hidden while nothing is imported.
class ImportBar : public QWidget {
  Q_OBJECT
 public:
  explicit ImportBar(QWidget* parent = nullptr);
  void setImporting(bool importing);
  /// `total` 0: not known.
  void progress(qint64 done, qint64 total);

 Q_SIGNALS:
  void cancelRequested();

 private:
  QLabel* text_;
  QProgressBar* bar_;
};

}  // namespace volumen
