#include "ui/widgets/offer_bar.h"

#include <QHBoxLayout>
#include <QToolButton>

#include "ui/widgets/plain_text.h"

namespace volumen {

OfferBar::OfferBar(QWidget* parent)
    : QFrame(parent), sentence_(plainLabel()), accept_(new QPushButton), refuse_(new QPushButton) {
  setObjectName(QStringLiteral("offerBar"));
  setStyleSheet(
      QStringLiteral("#offerBar { background: #16324a; border-bottom: 1px solid #4aa3ff; }"
                     "#offerBar QLabel { background: transparent; color: #d7e9ff; }"));
  sentence_->setObjectName(QStringLiteral("offerText"));
  sentence_->setWordWrap(true);
  accept_->setObjectName(QStringLiteral("offerAccept"));
  refuse_->setObjectName(QStringLiteral("offerRefuse"));
  auto* close = new QToolButton;
  close->setObjectName(QStringLiteral("offerClose"));
  close->setText(tr("Not now"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 6, 8, 6);
  row->addWidget(sentence_, 1);
  row->addWidget(accept_);
  row->addWidget(refuse_);
  row->addWidget(close);
  const auto answer = [this](auto told) {
    return [this, told] {
      hide();
      Q_EMIT(this->*told)();
    };
  };
  connect(accept_, &QPushButton::clicked, this, answer(&OfferBar::accepted));
  connect(refuse_, &QPushButton::clicked, this, answer(&OfferBar::refused));
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  hide();
}

void OfferBar::offer(const QString& sentence, const QString& accept, const QString& refuse) {
  sentence_->setText(sentence);
  accept_->setText(accept);
  refuse_->setText(refuse);
  show();
}

}  // namespace volumen
