#pragma once

#include <QTableWidget>

#include "tests/ui/journey.h"

namespace volumen::tests {

/// All texts of the table of numbers of segments, by row and head, a tab between.
inline QStringList tableTexts(Journey& w) {
  QStringList texts;
  const auto* table = w.child<QTableWidget>("segmentNumbers");
  for (int row = 0; row < table->rowCount(); ++row)
    for (int column = 0; column < table->columnCount(); ++column)
      texts << table->horizontalHeaderItem(column)->text() + QLatin1Char('\t') +
                   table->item(row, column)->text();
  return texts;
}

/// True once the table of numbers is open and measured.
inline bool openTable(Journey& w) {
  QTest::mouseClick(w.child<QWidget>("segmentNumbersButton"), Qt::LeftButton);
  return QTest::qWaitFor(
      [&] {
        const auto* table = w.child<QTableWidget>("segmentNumbers");
        return table && table->rowCount() > 0 && w.window.jobs().rows().empty();
      },
      longest);
}

/// The first under a head of the table; empty: there is none.
inline QString cellOf(Journey& w, const QString& head) {
  for (const QString& text : tableTexts(w))
    if (text.startsWith(head + QLatin1Char('\t'))) return text.section(QLatin1Char('\t'), 1);
  return {};
}

}  // namespace volumen::tests
