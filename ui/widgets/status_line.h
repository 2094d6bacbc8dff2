#pragma once

#include <QLabel>
#include <QTimer>

#include "ui/widgets/job_view.h"

namespace volumen {

/// The line at the bottom: value under the cursor, running jobs, warnings of the series.
class StatusLine : public QWidget {
  Q_OBJECT
 public:
  explicit StatusLine(Jobs& jobs, QWidget* parent = nullptr);

  void showHover(const QString& text) { hover_->setText(text); }
  /// Shows a message for a moment ("Saved head.png").
  void tell(const QString& sentence);
  /// Shows the first warning in the line, and all in the tooltip.
  void showWarnings(const QStringList& sentences);

 protected:
  bool eventFilter(QObject* label, QEvent* event) override;
  void resizeEvent(QResizeEvent*) override;
  void changeEvent(QEvent*) override;

 private:
  void elideWarning();
  void setHeight();

  QLabel *hover_, *told_, *warning_;
  JobLine* jobs_;
  QTimer fade_;
  QStringList warnings_;
};

}  // namespace volumen
