#pragma once

#include <string>
#include <vector>

namespace volumen {

/// Columns of text for a terminal. Wide characters (Chinese, Japanese, Korean) take two places, combining
/// marks none.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> heads) : rows_{std::move(heads)} {}

  /// Adds a row with one cell for each head; UTF-8 without control characters.
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  /// Returns all rows, one a line, with two spaces between columns and none at the ends. Columns of numbers
  /// are aligned to the right.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace volumen
