#pragma once

#include <QSizeF>
#include <QString>
#include <QStringList>
#include <vector>

class QPaintDevice;
class QPainter;

namespace volumen {

/// A column of a table on pages, and its width relative to the other columns.
struct PageColumn {
  QString head;
  double width = 1;
};

/// A table of texts, which wrap in their cells. Line ends begin lines.
struct PageTable {
  QString title;
  QString note;  ///< a line below the title; may be empty
  std::vector<PageColumn> columns;
  std::vector<QStringList> rows;  ///< a text for each column
};

/// Returns the tables as parts that fit on pages with this room, mm, for them. Pages break between rows, and
/// each part has title, note and heads. Texts too long for a page are cut off at its end.
std::vector<std::vector<PageTable>> dividedTables(const std::vector<PageTable>& tables, QSizeF roomMm,
                                                  QPaintDevice& device);

/// Paints tables one below another from `topMm` on. The width is that of the room they were divided for.
void paintTables(QPainter& painter, const std::vector<PageTable>& tables, double topMm, QSizeF roomMm);

}  // namespace volumen
