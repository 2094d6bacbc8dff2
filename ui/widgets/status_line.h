#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QTimer>
#include <QToolButton>

namespace volumen {

/// The line at the bottom: what is under the cursor, what is running, what is to be known of the series.
class StatusLine : public QWidget {
  Q_OBJECT
 public:
  explicit StatusLine(QWidget* parent = nullptr);

  void showHover(const QString& text) { hover_->setText(text); }
  /// A sentence in passing ("Saved head.png").
  void tell(const QString& sentence);
  /// Shows what runs once it has run for 0.3 s.
  void begin(const QString& what);
  /// total 0: not known.
  void progress(const QString& what, qint64 done, qint64 total);
  /// The same of a part, 0 to 1; `text` says all.
  void progressTo(const QString& text, double part);
  void end();
  /// All of them in the tooltip, the first in the line.
  void showWarnings(const QStringList& sentences);

 Q_SIGNALS:
  void cancelRequested();

 protected:
  void resizeEvent(QResizeEvent*) override;
  void changeEvent(QEvent*) override;

 private:
  void elideWarning();
  void setHeight();

  QLabel *hover_, *task_, *warning_;
  QProgressBar* bar_;
  QToolButton* cancel_;
  QTimer appear_, fade_;
  QStringList warnings_;
};

}  // namespace volumen
