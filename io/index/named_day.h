#pragma once

#include <QDate>
#include <QString>

namespace volumen {

/// Returns the day that a word of a search means, "today" or "yesterday" in any case; an invalid date for
/// other words.
QDate namedDay(const QString& word, const QDate& today);

}  // namespace volumen
