#include "io/deidentify/dates.h"

#include <QDate>
#include <QString>

#include "io/dicom/data_set.h"

namespace volumen {

std::optional<std::string> movedDate(const std::string& text, int days) {
  constexpr std::size_t digits = 8;
  const std::string plain = dicom::dateOrTime(text);
  const QString date = QString::fromLatin1(plain.data(), qsizetype(std::min(digits, plain.size())));
  const QDate moved = QDate::fromString(date, QStringLiteral("yyyyMMdd")).addDays(days);
  if (!moved.isValid() || moved.year() < 1 || moved.year() > 9999) return {};
  return moved.toString(QStringLiteral("yyyyMMdd")).toStdString() + plain.substr(digits);
}

}  // namespace volumen
