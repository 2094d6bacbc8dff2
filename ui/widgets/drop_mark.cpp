#include "ui/widgets/drop_mark.h"

#include <QVBoxLayout>

#include "ui/widgets/plain_text.h"

namespace volumen {

DropMark::DropMark(QWidget* parent) : QFrame(parent), text_(plainLabel()) {
  setObjectName(QStringLiteral("dropMark"));
  setAttribute(Qt::WA_TransparentForMouseEvents);
  text_->setObjectName(QStringLiteral("dropText"));
  // Independent of the theme, because it lies on the picture.
  setStyleSheet(
      QStringLiteral("#dropMark { border: 3px solid #4aa3ff; background: rgba(74,163,255,30); }"
                     "#dropText { color: #f2f4f6; background: rgba(27,30,34,230); border-radius: 3px; "
                     "padding: 4px 12px; }"));
  auto* column = new QVBoxLayout(this);
  column->addWidget(text_, 0, Qt::AlignCenter);
  hide();
}

}  // namespace volumen
