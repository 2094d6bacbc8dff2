#include "ui/widgets/explained.h"

#include "ui/widgets/plain_text.h"

namespace volumen {

Explained::Explained(QWidget* panel) : sentence_(plainLabel()) {
  sentence_->setObjectName(QStringLiteral("whyNothing"));
  sentence_->setWordWrap(true);
  sentence_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  sentence_->setMargin(8);
  // The minimum size of a wrapped label would make the window as tall as one word per line.
  sentence_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
  sentence_->setEnabled(false);  // grey like the panel
  addWidget(panel);
  addWidget(sentence_);
}

void Explained::explain(const QString& sentence) {
  if (!sentence.isEmpty()) sentence_->setText(sentence);
  setCurrentIndex(sentence.isEmpty() ? 0 : 1);
}

}  // namespace volumen
