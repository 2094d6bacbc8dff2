#include "app/batch/gather.h"

#include <algorithm>
#include <optional>

#include "io/files/output_file.h"
#include "io/regular_file.h"
#include "results/numbers/csv.h"

namespace volumen {

namespace {

using CsvRow = std::vector<std::string>;

// Takes one row off a text (RFC 4180); a quoted field may hold line ends.
CsvRow takeRow(std::string_view& text) {
  CsvRow row(1);
  bool isQuoted = false;
  while (!text.empty()) {
    const char c = text[0];
    text.remove_prefix(1);
    if (c == '"' && isQuoted && text.starts_with('"')) {
      row.back() += c;
      text.remove_prefix(1);
    } else if (c == '"') {
      isQuoted = !isQuoted;
    } else if (c == ',' && !isQuoted) {
      row.emplace_back();
    } else if (c == '\n' && !isQuoted) {
      break;
    } else if (c != '\r' || isQuoted) {
      row.back() += c;
    }
  }
  return row;
}

std::string harmless(const std::string& name) {
  return harmlessName(QString::fromStdString(name)).toStdString();
}

// Collects rows into one table. Columns are added as files bring them.
class Gathered {
 public:
  Gathered() : names_{"line", "path", "file"} {}

  // The Error: the file is not there, or is no table.
  Status add(const Piece& piece, const std::string& file) {
    constexpr std::uint64_t mostBytes = 64 << 20;
    const auto text = wholeText(file, mostBytes, "a table");
    if (!text) return text.error();
    std::string_view rest(*text);
    if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
    const CsvRow header = takeRow(rest);
    std::vector<std::size_t> places;
    for (const std::string& name : header) places.push_back(placeOf(name));
    while (!rest.empty()) {
      const CsvRow fields = takeRow(rest);
      if (fields.size() != header.size())
        return Error{file + " is no table: its rows differ in length from the first."};
      CsvRow row = {std::to_string(piece.line), harmless(piece.path), harmless(file)};
      row.resize(names_.size());
      for (std::size_t n = 0; n < fields.size(); ++n) row[places[n]] = fields[n];
      rows_.push_back(std::move(row));
    }
    return {};
  }

  std::string text() const {
    std::string all;
    addRow(names_, all);
    for (CsvRow row : rows_) {
      row.resize(names_.size());
      addRow(row, all);
    }
    return all;
  }

 private:
  std::size_t placeOf(const std::string& name) {
    const auto found = std::find(names_.begin() + 3, names_.end(), name);
    if (found != names_.end()) return std::size_t(found - names_.begin());
    names_.push_back(name);
    return names_.size() - 1;
  }
  static void addRow(const CsvRow& row, std::string& all) {
    for (std::size_t n = 0; n < row.size(); ++n)
      all += (n == 0 ? "" : ",") + csvField(QString::fromStdString(row[n])).toStdString();
    all += '\n';
  }

  CsvRow names_;
  std::vector<CsvRow> rows_;
};

}  // namespace

Status gather(const std::vector<Piece>& pieces, const std::string& output) {
  Gathered table;
  bool hasTable = false;
  for (const Piece& piece : pieces)
    for (const std::string& file : piece.outputs) {
      if (!file.ends_with(".csv")) continue;
      hasTable = true;
      if (Status s = table.add(piece, file); !s) return s;
    }
  if (!hasTable) return Error{"--gather joins .csv files, and the list writes none."};
  return writeWholeFile(output, table.text());
}

}  // namespace volumen
