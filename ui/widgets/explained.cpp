#include "ui/widgets/explained.h"

#include "ui/widgets/plain_text.h"

namespace volumen {

Explained::Explained(QWidget* panel) : sentence_(plainLabel()) {
  sentence_->setObjectName(QStringLiteral("whyNothing"));
  sentence_->setWordWrap(true);
  sentence_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  sentence_->setMargin(8);
  // Word by word under each other it would make the window as tall as that.
  sentence_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
  sentence_->setEnabled(false);  // as grey as what it stands for
  addWidget(panel);
  addWidget(sentence_);
}

void Explained::explain(const QString& sentence) {
  if (!sentence.isEmpty()) sentence_->setText(sentence);
  setCurrentIndex(sentence.isEmpty() ? 0 : 1);
}

}  // namespace volumen
