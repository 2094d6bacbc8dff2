#pragma once

#include <string>
#include <vector>

namespace volumen {

/// Columns of text that stand below each other on a terminal; wide characters (Chinese, Japanese, Korean)
/// take two places, marks none.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> heads) : rows_{std::move(heads)} {}

  /// Adds a row of as many cells as there are heads; UTF-8 without control characters.
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  /// All rows, one a line; two spaces between columns, none at the ends of lines. Columns of numbers
  /// alone stand to the right.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace volumen
