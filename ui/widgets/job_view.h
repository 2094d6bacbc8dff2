#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QToolButton>

#include "ui/document/jobs.h"

namespace volumen {

/// One job: its activity, progress, and a cancel button.
class JobView : public QWidget {
  Q_OBJECT
 public:
  explicit JobView(QWidget* parent = nullptr);
  void showJob(const JobRow& job);

 Q_SIGNALS:
  void cancelRequested(int job);

 private:
  QLabel* text_;
  QProgressBar* bar_;
  QToolButton* cancel_;
  int job_ = 0, pressedFor_ = 0;
};

/// Jobs that have run for a moment. The line shows the first; the button beside it shows all.
class JobLine : public QWidget {
  Q_OBJECT
 public:
  explicit JobLine(Jobs& jobs, QWidget* parent = nullptr);

 private:
  void showJobs();
  void showAll(const std::vector<JobRow>& rows);
  JobView* makeView();

  Jobs& jobs_;
  JobView* first_;
  QToolButton* more_;
  QFrame* all_;
  std::vector<JobView*> views_;  // in all_
};

}  // namespace volumen
