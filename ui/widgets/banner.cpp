#include "ui/widgets/banner.h"

#include <QHBoxLayout>

#include "ui/widgets/plain_text.h"

namespace volumen {

Banner::Banner(QWidget* parent)
    : QFrame(parent),
      sentence_(plainLabel()),
      details_(new QPlainTextEdit),
      more_(new QToolButton),
      offer_(new QToolButton) {
  setObjectName(QStringLiteral("banner"));
  setStyleSheet(
      QStringLiteral("#banner { background: #4a3312; border-bottom: 1px solid #c98a2b; }"
                     "#banner QLabel, #banner QPlainTextEdit { background: transparent; color: #ffe2b0; }"));
  sentence_->setObjectName(QStringLiteral("bannerText"));
  sentence_->setWordWrap(true);
  sentence_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  details_->setObjectName(QStringLiteral("bannerDetails"));
  details_->setReadOnly(true);
  details_->setFrameShape(QFrame::NoFrame);
  details_->setFixedHeight(7 * fontMetrics().lineSpacing());  // scrolled where there are more
  more_->setText(tr("Details"));
  more_->setCheckable(true);
  offer_->setObjectName(QStringLiteral("bannerOffer"));
  auto* close = new QToolButton;
  close->setObjectName(QStringLiteral("bannerClose"));
  close->setText(tr("Close"));
  auto* row = new QHBoxLayout;
  row->addWidget(sentence_, 1);
  row->addWidget(more_);
  row->addWidget(offer_);
  row->addWidget(close);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 6, 8, 6);
  column->addLayout(row);
  column->addWidget(details_);
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  connect(offer_, &QToolButton::clicked, this, &Banner::accepted);
  connect(more_, &QToolButton::toggled, details_, &QWidget::setVisible);
  hide();
}

void Banner::tell(const QString& sentence, const QStringList& details) {
  told_ = sentence;
  toldDetails_ = details;
  refresh();
  more_->setVisible(!details.isEmpty());
  more_->setChecked(false);
  offer_->hide();
  details_->hide();
  show();
}

void Banner::refresh() {
  sentence_->setText(writing_(told_));
  details_->setPlainText(writing_(toldDetails_.join(QLatin1Char('\n'))));
}

void Banner::add(const QString& sentence, const QStringList& details) {
  if (isHidden()) return tell(sentence, details);
  if (told_.contains(sentence)) return;
  const bool isOffered = !offer_->isHidden();
  tell(told_ + QLatin1Char('\n') + sentence, toldDetails_ + details);
  offer_->setVisible(isOffered);
}

void Banner::offer(const QString& text) {
  offer_->setText(text);
  offer_->show();
}

}  // namespace volumen
