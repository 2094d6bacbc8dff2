#include "ui/widgets/banner.h"

#include <QHBoxLayout>

namespace volumen {

namespace {
constexpr int mostDetails = 20;
}

Banner::Banner(QWidget* parent)
    : QFrame(parent), sentence_(new QLabel), details_(new QLabel), more_(new QToolButton) {
  setObjectName(QStringLiteral("banner"));
  setStyleSheet(
      QStringLiteral("#banner { background: #4a3312; border-bottom: 1px solid #c98a2b; }"
                     "#banner QLabel { color: #ffe2b0; }"));
  sentence_->setObjectName(QStringLiteral("bannerText"));
  for (QLabel* label : {sentence_, details_}) {
    label->setTextFormat(Qt::PlainText);
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  }
  more_->setText(tr("Details"));
  more_->setCheckable(true);
  auto* close = new QToolButton;
  close->setObjectName(QStringLiteral("bannerClose"));
  close->setText(tr("Close"));
  auto* row = new QHBoxLayout;
  row->addWidget(sentence_, 1);
  row->addWidget(more_);
  row->addWidget(close);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 6, 8, 6);
  column->addLayout(row);
  column->addWidget(details_);
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  connect(more_, &QToolButton::toggled, details_, &QWidget::setVisible);
  hide();
}

void Banner::tell(const QString& sentence, const QStringList& details) {
  sentence_->setText(sentence);
  QStringList shown = details.mid(0, mostDetails);
  if (details.size() > mostDetails) shown << tr("and %1 more").arg(details.size() - mostDetails);
  details_->setText(shown.join(QLatin1Char('\n')));
  more_->setVisible(!details.isEmpty());
  more_->setChecked(false);
  details_->hide();
  show();
}

}  // namespace volumen
