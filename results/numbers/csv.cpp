#include "results/numbers/csv.h"

#include <algorithm>
#include <cmath>

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

QString csvNumber(double number) {
  constexpr int digits = 7;  // precision of a float voxel
  constexpr double exact = 1e15;
  const bool isWhole = number == std::round(number) && std::abs(number) < exact;
  return isWhole ? QString::number(qint64(number)) : QString::number(number, 'g', digits);
}

}  // namespace volumen
