#include "ui/workspace/csv.h"

#include <QLocale>
#include <algorithm>

namespace volumen {

QString csvField(QString text) {
  const QString special = QStringLiteral(",\"\r\n");
  if (std::ranges::none_of(text, [&](QChar c) { return special.contains(c); })) return text;
  return QLatin1Char('"') + text.replace(QLatin1Char('"'), QStringLiteral("\"\"")) + QLatin1Char('"');
}

QString harmlessName(const QString& text) {
  const bool isFormula = !text.isEmpty() && QStringLiteral("=+-@\t\r\n").contains(text.front());
  return isFormula ? QLatin1Char('\'') + text : text;
}

QString csvNumber(double number) { return QString::number(number, 'g', QLocale::FloatingPointShortest); }

}  // namespace volumen
