#include "ui/overlays/page_tables.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QTextLayout>
#include <algorithm>
#include <cmath>
#include <memory>

#include "results/pictures/picture_font.h"

namespace volumen {

namespace {

// mm; texts have 9 points, titles 11
constexpr double cellText = 9 * 25.4 / 72, titleText = 11 * 25.4 / 72, columnGap = 2, rowGap = 0.8,
                 tableGap = 6, ruleWidth = 0.15;
constexpr qsizetype mostLetters = 4000;  // of a cell

enum class Rule { none, thin, thick };

// Texts side by side, laid out in their columns.
struct LaidRow {
  struct Cell {
    std::unique_ptr<QTextLayout> text;
    double left;
  };
  std::vector<Cell> cells;
  double height = 0;       // dots
  Rule rule = Rule::none;  // above it
};

// Lays out the rows of tables for a device. Lengths are in dots.
class TableLayouter {
 public:
  TableLayouter(QPaintDevice& device, QSizeF roomMm)
      : device_(device), dotsPerMm_(device.logicalDpiX() / 25.4), room_(roomMm * dotsPerMm_) {}

  double dots(double mm) const { return mm * dotsPerMm_; }
  QSizeF room() const { return room_; }

  // Title, note and heads.
  std::vector<LaidRow> headOf(const PageTable& table) const {
    std::vector<LaidRow> rows;
    const PageTable line{{}, {}, {{}}, {}};
    rows.push_back(laidOut(line, {table.title}, titleText, true, Rule::none));
    if (!table.note.isEmpty()) rows.push_back(laidOut(line, {table.note}, cellText, false, Rule::none));
    QStringList heads;
    for (const PageColumn& column : table.columns) heads << column.head;
    rows.push_back(laidOut(table, heads, cellText, true, Rule::thick));
    return rows;
  }
  LaidRow row(const PageTable& table, const QStringList& texts) const {
    return laidOut(table, texts, cellText, false, Rule::thin);
  }

 private:
  LaidRow laidOut(const PageTable& table, const QStringList& texts, double textMm, bool bold,
                  Rule rule) const {
    QFont font = pictureFont();
    font.setPixelSize(std::max(1, int(std::lround(dots(textMm)))));
    font.setBold(bold);
    double widths = 0, left = 0;
    for (const PageColumn& column : table.columns) widths += column.width;
    LaidRow laid;
    laid.rule = rule;
    for (std::size_t n = 0; n < table.columns.size(); ++n) {
      const double width = room_.width() * table.columns[n].width / widths;
      const double gap = n + 1 < table.columns.size() ? dots(columnGap) : 0;
      auto text = wrapped(texts.value(qsizetype(n)), font, width - gap);
      laid.height = std::max(laid.height, text->boundingRect().height());
      laid.cells.push_back({std::move(text), left});
      left += width;
    }
    laid.height += 2 * dots(rowGap);
    return laid;
  }

  std::unique_ptr<QTextLayout> wrapped(QString text, const QFont& font, double width) const {
    text.replace(QLatin1Char('\n'), QChar::LineSeparator);
    if (text.size() > mostLetters) text = text.left(mostLetters) + QChar(0x2026);
    // With title, note and heads the row still fits.
    const double most = room_.height() * 0.6;
    auto layout = layoutOf(text, font, width);
    for (int n = 1; n < layout->lineCount(); ++n)
      if (layout->lineAt(n).rect().bottom() > most) {
        const int end = layout->lineAt(n).textStart() - 1;
        return layoutOf(text.left(end) + QChar(0x2026), font, width);
      }
    return layout;
  }

  std::unique_ptr<QTextLayout> layoutOf(const QString& text, const QFont& font, double width) const {
    auto layout = std::make_unique<QTextLayout>(text, font, &device_);
    QTextOption option;
    option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
    layout->setTextOption(option);
    layout->beginLayout();
    double height = 0;
    for (QTextLine line = layout->createLine(); line.isValid(); line = layout->createLine()) {
      line.setLineWidth(width);
      line.setPosition({0, height});
      height += line.height();
    }
    layout->endLayout();
    return layout;
  }

  QPaintDevice& device_;
  double dotsPerMm_;
  QSizeF room_;
};

double heightOf(const std::vector<LaidRow>& rows) {
  double height = 0;
  for (const LaidRow& row : rows) height += row.height;
  return height;
}

}  // namespace

std::vector<std::vector<PageTable>> dividedTables(const std::vector<PageTable>& tables, QSizeF roomMm,
                                                  QPaintDevice& device) {
  const TableLayouter layouter(device, roomMm);
  std::vector<std::vector<PageTable>> pages;
  double left = 0;
  for (const PageTable& table : tables) {
    const double head = heightOf(layouter.headOf(table));
    bool isBegun = false;
    for (const QStringList& texts : table.rows) {
      const double row = layouter.row(table, texts).height;
      if (pages.empty() || left < row + (isBegun ? 0 : head)) {
        pages.emplace_back();
        left = layouter.room().height();
        isBegun = false;
      }
      if (!isBegun) {
        pages.back().push_back({table.title, table.note, table.columns, {}});
        left -= head;
        isBegun = true;
      }
      pages.back().back().rows.push_back(texts);
      left -= row;
    }
    left -= layouter.dots(tableGap);
  }
  return pages;
}

void paintTables(QPainter& painter, const std::vector<PageTable>& tables, double topMm, QSizeF roomMm) {
  const TableLayouter layouter(*painter.device(), roomMm);
  double y = layouter.dots(topMm);
  const auto paint = [&](const LaidRow& row) {
    if (row.rule != Rule::none) {
      painter.setPen(QPen(Qt::black, layouter.dots(ruleWidth) * (row.rule == Rule::thick ? 2 : 1)));
      painter.drawLine(QPointF(0, y), QPointF(layouter.room().width(), y));
    }
    for (const LaidRow::Cell& cell : row.cells)
      cell.text->draw(&painter, {cell.left, y + layouter.dots(rowGap)});
    y += row.height;
  };
  for (const PageTable& table : tables) {
    for (const LaidRow& row : layouter.headOf(table)) paint(row);
    for (const QStringList& texts : table.rows) paint(layouter.row(table, texts));
    y += layouter.dots(tableGap);
  }
}

}  // namespace volumen
