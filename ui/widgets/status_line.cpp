#include "ui/widgets/status_line.h"

#include <QEvent>
#include <QHBoxLayout>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {
constexpr int fadeAfterMs = 8000;
constexpr int leastHover = 300, leastWarning = 220, leastInNarrow = 120;
constexpr int narrow = 900;
}  // namespace

StatusLine::StatusLine(Jobs& jobs, QWidget* parent)
    : QWidget(parent),
      hover_(plainLabel()),
      told_(plainLabel()),
      warning_(plainLabel()),
      jobs_(new JobLine(jobs)) {
  hover_->setObjectName(QStringLiteral("hoverText"));
  told_->setObjectName(QStringLiteral("toldText"));
  warning_->setObjectName(QStringLiteral("warningText"));
  warning_->installEventFilter(this);
  told_->setMinimumWidth(1);  // may shrink
  warning_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  warning_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 2, 8, 2);
  row->setSpacing(8);
  row->addWidget(hover_);
  row->addWidget(jobs_);
  row->addWidget(told_);
  row->addWidget(warning_, 1);
  setHeight();
  fade_.setSingleShot(true);
  connect(&fade_, &QTimer::timeout, told_, &QLabel::clear);
}

void StatusLine::tell(const QString& sentence) {
  told_->setText(sentence);
  fade_.start(fadeAfterMs);
}

void StatusLine::showWarnings(const QStringList& sentences) {
  warnings_ = sentences;
  QStringList lines;
  for (const QString& sentence : sentences) lines << QStringLiteral("! ") + sentence;
  warning_->setToolTip(toolTipOf(lines));
  elideWarning();
}

void StatusLine::elideWarning() {
  warning_->setMinimumWidth(warnings_.isEmpty() ? 0 : leastWarning);
  if (warnings_.isEmpty()) return warning_->clear();
  QString more;
  if (warnings_.size() > 1) more = tr("  (and %1 more)").arg(warnings_.size() - 1);
  const int room = warning_->width() - fontMetrics().horizontalAdvance(more) - 4;
  warning_->setText(fontMetrics().elidedText(QStringLiteral("! ") + warnings_[0], Qt::ElideRight, room) +
                    more);
}

// A fixed height: otherwise each job would resize the picture above and render it again.
void StatusLine::setHeight() {
  setFixedHeight(std::max(JobView().sizeHint().height(), hover_->sizeHint().height()) + 4);
}

void StatusLine::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) setHeight();
}

// In a narrow window the value under the cursor leaves room for warnings.
void StatusLine::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  hover_->setMinimumWidth(width() < narrow ? leastInNarrow : leastHover);
}

bool StatusLine::eventFilter(QObject* label, QEvent* event) {
  if (event->type() == QEvent::Resize) elideWarning();
  return QWidget::eventFilter(label, event);
}

}  // namespace volumen
