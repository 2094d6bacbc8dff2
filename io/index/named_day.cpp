#include "io/index/named_day.h"

namespace volumen {

QDate namedDay(const QString& word, const QDate& today) {
  if (word.compare(QLatin1String("today"), Qt::CaseInsensitive) == 0) return today;
  if (word.compare(QLatin1String("yesterday"), Qt::CaseInsensitive) == 0) return today.addDays(-1);
  return {};
}

}  // namespace volumen
