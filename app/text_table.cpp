#include "app/text_table.h"

#include <QList>
#include <QString>
#include <algorithm>

namespace volumen {

namespace {

bool isWide(char32_t c) {
  return (c >= 0x1100 && c <= 0x115f) || (c >= 0x2e80 && c <= 0xa4cf) || (c >= 0xac00 && c <= 0xd7a3) ||
         (c >= 0xf900 && c <= 0xfaff) || (c >= 0xfe30 && c <= 0xfe6f) || (c >= 0xff00 && c <= 0xff60) ||
         (c >= 0xffe0 && c <= 0xffe6) || (c >= 0x1f300 && c <= 0x1faff) || (c >= 0x20000 && c <= 0x3fffd);
}

std::size_t places(const std::string& utf8) {
  std::size_t count = 0;
  for (const uint c : QString::fromStdString(utf8).toUcs4()) {
    const QChar::Category category = QChar::category(c);
    if (category == QChar::Mark_NonSpacing || category == QChar::Mark_Enclosing) continue;
    count += isWide(c) ? 2 : 1;
  }
  return count;
}

bool isNumber(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

std::string TextTable::text() const {
  std::vector<std::size_t> widths(rows_[0].size());
  std::vector<bool> ofNumbers(rows_[0].size(), true);
  for (const auto& row : rows_)
    for (std::size_t n = 0; n < row.size(); ++n) {
      widths[n] = std::max(widths[n], places(row[n]));
      if (&row != &rows_[0] && !isNumber(row[n])) ofNumbers[n] = false;
    }
  std::string out;
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t n = 0; n < row.size(); ++n) {
      const std::string space(widths[n] - places(row[n]), ' ');
      line += (n ? "  " : "") + (ofNumbers[n] ? space + row[n] : row[n] + space);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

}  // namespace volumen
