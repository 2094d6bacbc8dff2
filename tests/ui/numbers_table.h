#pragma once

#include <QTableWidget>

#include "tests/ui/journey.h"

namespace volumen::tests {

/// Returns all texts of the segment statistics table by row and column title, separated by a tab.
inline QStringList tableTexts(Journey& w) {
  QStringList texts;
  const auto* table = w.child<QTableWidget>("segmentNumbers");
  for (int row = 0; row < table->rowCount(); ++row)
    for (int column = 0; column < table->columnCount(); ++column)
      texts << table->horizontalHeaderItem(column)->text() + QLatin1Char('\t') +
                   table->item(row, column)->text();
  return texts;
}

/// Opens the segment statistics table and returns true once its values are computed.
inline bool openTable(Journey& w) {
  QTest::mouseClick(w.child<QWidget>("segmentNumbersButton"), Qt::LeftButton);
  return QTest::qWaitFor(
      [&] {
        const auto* table = w.child<QTableWidget>("segmentNumbers");
        return table && table->rowCount() > 0 && w.window.jobs().rows().empty();
      },
      longest);
}

/// Returns the first cell under a column title; empty if there is none.
inline QString cellOf(Journey& w, const QString& head) {
  for (const QString& text : tableTexts(w))
    if (text.startsWith(head + QLatin1Char('\t'))) return text.section(QLatin1Char('\t'), 1);
  return {};
}

}  // namespace volumen::tests
