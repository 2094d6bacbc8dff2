#include "ui/widgets/typed_number.h"

#include <QKeyEvent>
#include <cmath>

#include "ui/widgets/plain_text.h"

namespace volumen {

TypedNumber::TypedNumber(const char* objectName, const QString& name, QWidget* parent) : QLineEdit(parent) {
  setObjectName(QLatin1String(objectName));
  setAccessibleName(name);
  setToolTip(toolTipOf(name));
  setAlignment(Qt::AlignRight);
}

QString TypedNumber::textOf(double number) const {
  QString text = QString::number(number, 'f', decimals_);
  while (text.contains(u'.') && (text.endsWith(u'0') || text.endsWith(u'.'))) text.chop(1);
  return text;
}

QString TypedNumber::stands() const { return number_ < least_ ? QString() : textOf(number_); }

void TypedNumber::setNumber(double number, double least, double most, int decimals) {
  number_ = number;
  least_ = least;
  most_ = most;
  decimals_ = decimals;
  if (!hasFocus() && text() != stands()) setText(stands());
}

std::optional<double> TypedNumber::number() const {
  bool isNumber = false;
  const double number = text().trimmed().replace(u',', u'.').toDouble(&isNumber);
  const bool fits = isNumber && number >= least_ && number <= most_;
  return fits && (decimals_ > 0 || number == std::round(number)) ? std::optional(number) : std::nullopt;
}

QString TypedNumber::whyNot() const {
  if (number()) return {};
  return (decimals_ > 0 ? tr("Type a number from %1 to %2.") : tr("Type a whole number from %1 to %2."))
      .arg(textOf(least_), textOf(most_));
}

// Claims Esc before other shortcuts.
bool TypedNumber::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();
    return true;
  }
  return QLineEdit::event(event);
}

void TypedNumber::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    setText(stands());
    Q_EMIT givenUp();
    return;
  }
  if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) return QLineEdit::keyPressEvent(event);
  const std::optional<double> number = this->number();
  selectAll();
  if (!number) {
    Q_EMIT refused(whyNot());
    return;
  }
  number_ = *number;
  Q_EMIT typed(*number);
}

void TypedNumber::focusOutEvent(QFocusEvent* event) {
  QLineEdit::focusOutEvent(event);
  if (event->reason() != Qt::PopupFocusReason && event->reason() != Qt::ActiveWindowFocusReason)
    setText(stands());
}

}  // namespace volumen
