#include "ui/widgets/job_view.h"

#include <QHBoxLayout>
#include <cmath>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {
constexpr qint64 appearAfterMs = 300;
}

JobView::JobView(QWidget* parent)
    : QWidget(parent), text_(plainLabel()), bar_(new QProgressBar), cancel_(new QToolButton) {
  text_->setObjectName(QStringLiteral("taskText"));
  cancel_->setObjectName(QStringLiteral("cancelTask"));
  cancel_->setText(tr("Cancel"));
  bar_->setFixedSize(140, 12);
  bar_->setTextVisible(false);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(8);
  row->addWidget(text_, 1);
  row->addWidget(bar_);
  row->addWidget(cancel_);
  // Another job may replace the one for which the button was pressed.
  connect(cancel_, &QToolButton::pressed, this, [this] { pressedFor_ = job_; });
  connect(cancel_, &QToolButton::clicked, this, [this] {
    if (pressedFor_ == job_) Q_EMIT cancelRequested(job_);
  });
}

void JobView::showJob(const JobRow& job) {
  job_ = job.id;
  text_->setText(job.text);
  bar_->setRange(0, job.part < 0 ? 0 : 1000);
  if (job.part >= 0) bar_->setValue(int(std::lround(1000 * job.part)));
  bar_->setAccessibleName(job.text);
  cancel_->setAccessibleName(tr("Cancel: %1").arg(job.text));
  cancel_->setVisible(job.canBeCancelled);
}

JobLine::JobLine(Jobs& jobs, QWidget* parent)
    : QWidget(parent),
      jobs_(jobs),
      first_(makeView()),
      more_(new QToolButton),
      all_(new QFrame(this, Qt::Popup)) {
  more_->setObjectName(QStringLiteral("moreTasks"));
  all_->setObjectName(QStringLiteral("allTasks"));
  all_->setFrameShape(QFrame::StyledPanel);
  new QVBoxLayout(all_);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(first_);
  row->addWidget(more_);
  connect(more_, &QToolButton::clicked, this, [this] {
    all_->show();
    showJobs();
  });
  connect(&jobs_, &Jobs::changed, this, &JobLine::showJobs);
  showJobs();
}

JobView* JobLine::makeView() {
  auto* view = new JobView;
  connect(view, &JobView::cancelRequested, this, [this](int job) { jobs_.cancel(job); });
  return view;
}

void JobLine::showJobs() {
  std::vector<JobRow> rows = jobs_.rows();
  std::erase_if(rows, [](const JobRow& row) { return row.sinceMs < appearAfterMs; });
  if (!rows.empty()) first_->showJob(rows.front());
  first_->setVisible(!rows.empty());
  more_->setText(tr("%1 more").arg(rows.size() - 1));
  more_->setToolTip(tr("All that runs and waits"));
  more_->setVisible(rows.size() > 1);
  if (rows.empty()) all_->hide();
  if (all_->isVisible()) showAll(rows);
}

// Shows all jobs above the line, at its left end.
void JobLine::showAll(const std::vector<JobRow>& rows) {
  while (views_.size() < rows.size()) {
    views_.push_back(makeView());
    all_->layout()->addWidget(views_.back());
  }
  for (std::size_t n = 0; n < views_.size(); ++n) {
    views_[n]->setVisible(n < rows.size());
    if (n < rows.size()) views_[n]->showJob(rows[n]);
  }
  all_->adjustSize();
  all_->move(mapToGlobal(QPoint(0, -all_->height() - 4)));
}

}  // namespace volumen
