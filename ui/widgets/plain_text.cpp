#include "ui/widgets/plain_text.h"

namespace volumen {

QLabel* plainLabel(const QString& text) {
  auto* label = new QLabel;
  label->setTextFormat(Qt::PlainText);
  label->setText(text);
  return label;
}

QString toolTipOf(QStringList lines) {
  lines.removeAll(QString());
  if (lines.isEmpty()) return {};
  return QStringLiteral("<p style='white-space:pre-wrap'>%1</p>")
      .arg(lines.join(QLatin1Char('\n')).toHtmlEscaped().replace(QLatin1Char('\n'), QStringLiteral("<br>")));
}

QString toolTipOf(const QString& line) { return toolTipOf(QStringList{line}); }

}  // namespace volumen
