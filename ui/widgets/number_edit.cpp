#include "ui/widgets/number_edit.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QMouseEvent>
#include <algorithm>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {
constexpr int numberWidth = 48;  // for five digits
}

NumberEdit::NumberEdit(const QString& noun, int now, int count, QWidget* parent)
    : QWidget(parent),
      field_(new TypedNumber("placeNumber", tr("Number to go to"))),
      said_(plainLabel(tr("of %1").arg(count))) {
  setObjectName(QStringLiteral("numberEdit"));
  setAutoFillBackground(true);
  said_->setObjectName(QStringLiteral("placeNumberSaid"));
  field_->setFixedWidth(numberWidth);
  field_->setNumber(now, 1, count);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(6, 2, 6, 2);
  row->setSpacing(4);
  row->addWidget(plainLabel(noun));
  row->addWidget(field_);
  row->addWidget(said_);
  setFocusProxy(field_);
  connect(field_, &TypedNumber::typed, this, [this](double number) { Q_EMIT chosen(int(number)); });
  connect(field_, &TypedNumber::refused, this, &NumberEdit::tell);
  connect(field_, &TypedNumber::givenUp, this, &NumberEdit::leave);
  connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, const QWidget* focus) {
    if (focus && isVisible() && !isAncestorOf(focus)) leave();
  });
  field_->selectAll();
}

// Keeps clicks from the widgets below.
void NumberEdit::mousePressEvent(QMouseEvent* event) { event->accept(); }

// Wraps the text so that it stays inside its parent.
void NumberEdit::tell(const QString& sentence) {
  constexpr int leastWidth = 60;
  const int room = parentWidget()->width() - (width() - said_->width());
  said_->setText(sentence);
  said_->setWordWrap(true);
  said_->setFixedWidth(std::clamp(said_->fontMetrics().horizontalAdvance(sentence) + 4, leastWidth,
                                  std::max(leastWidth, room)));
  adjustSize();
  move(std::clamp(x(), 0, std::max(0, parentWidget()->width() - width())), y());
}

void NumberEdit::leave() {
  if (isHidden()) return;
  const bool hasKeys = isAncestorOf(window()->focusWidget());
  hide();
  deleteLater();
  if (hasKeys) Q_EMIT closed();
}

}  // namespace volumen
