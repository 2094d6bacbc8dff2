#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QToolButton>

#include "ui/document/jobs.h"

namespace volumen {

/// One job: what it does, how far it is, and a button that cancels it.
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

/// The jobs that have run for a moment: the first in a line, all of them where the button beside it is
/// pressed.
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
