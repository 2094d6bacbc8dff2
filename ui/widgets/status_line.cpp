#include "ui/widgets/status_line.h"

#include <QEvent>
#include <QHBoxLayout>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {
constexpr int appearAfterMs = 300, fadeAfterMs = 8000;
}

StatusLine::StatusLine(QWidget* parent)
    : QWidget(parent),
      hover_(plainLabel()),
      task_(plainLabel()),
      warning_(plainLabel()),
      bar_(new QProgressBar),
      cancel_(new QToolButton) {
  hover_->setObjectName(QStringLiteral("hoverText"));
  task_->setObjectName(QStringLiteral("taskText"));
  warning_->setObjectName(QStringLiteral("warningText"));
  cancel_->setObjectName(QStringLiteral("cancelTask"));
  cancel_->setText(tr("Cancel"));
  hover_->setMinimumWidth(300);
  warning_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  warning_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  bar_->setFixedSize(140, 12);
  bar_->setTextVisible(false);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 2, 8, 2);
  row->setSpacing(8);
  row->addWidget(hover_);
  row->addWidget(task_);
  row->addWidget(bar_);
  row->addWidget(cancel_);
  row->addWidget(warning_, 1);
  setHeight();
  for (QTimer* timer : {&appear_, &fade_}) timer->setSingleShot(true);
  connect(&appear_, &QTimer::timeout, this, [this] {
    for (QWidget* part :
         {static_cast<QWidget*>(task_), static_cast<QWidget*>(bar_), static_cast<QWidget*>(cancel_)})
      part->show();
  });
  connect(&fade_, &QTimer::timeout, task_, [this] { task_->clear(); });
  connect(cancel_, &QToolButton::clicked, this, &StatusLine::cancelRequested);
  end();
}

void StatusLine::tell(const QString& sentence) {
  task_->setText(sentence);
  task_->show();
  fade_.start(fadeAfterMs);
}

void StatusLine::begin(const QString& what) {
  fade_.stop();
  task_->setText(what);
  task_->hide();
  bar_->setRange(0, 0);
  appear_.start(appearAfterMs);
}

void StatusLine::progress(const QString& what, qint64 done, qint64 total) {
  task_->setText(total > 0 ? tr("%1: %2 of %3").arg(what).arg(done).arg(total) : what);
  bar_->setRange(0, total > 0 ? 1000 : 0);
  if (total > 0) bar_->setValue(int(1000 * done / total));
}

void StatusLine::progressTo(const QString& text, double part) {
  task_->setText(text);
  bar_->setRange(0, 1000);
  bar_->setValue(int(1000 * part));
}

void StatusLine::end() {
  appear_.stop();
  task_->clear();
  bar_->hide();
  cancel_->hide();
}

void StatusLine::showWarnings(const QStringList& sentences) {
  warnings_ = sentences;
  QStringList lines;
  for (const QString& sentence : sentences) lines << QStringLiteral("! ") + sentence;
  warning_->setToolTip(toolTipOf(lines));
  elideWarning();
}

void StatusLine::elideWarning() {
  if (warnings_.isEmpty()) return warning_->clear();
  QString more;
  if (warnings_.size() > 1) more = tr("  (and %1 more)").arg(warnings_.size() - 1);
  const int room = warning_->width() - fontMetrics().horizontalAdvance(more) - 4;
  warning_->setText(fontMetrics().elidedText(QStringLiteral("! ") + warnings_[0], Qt::ElideRight, room) +
                    more);
}

// Or the picture above would be resized, and drawn again, whenever something runs.
void StatusLine::setHeight() {
  setFixedHeight(std::max(cancel_->sizeHint().height(), hover_->sizeHint().height()) + 4);
}

void StatusLine::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) setHeight();
}

void StatusLine::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  elideWarning();
}

}  // namespace volumen
