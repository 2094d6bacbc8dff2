#include "viewer/scene/similar_name.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace volumen {

namespace {

std::string lowerCase(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Returns the Levenshtein distance.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> similarName(const std::string& word, const std::vector<std::string>& names) {
  constexpr std::size_t longest = 100;
  if (word.size() > longest) return {};
  std::optional<std::string> best;
  std::size_t least = word.size() / 3 + 1;
  for (const std::string& name : names) {
    if (name.size() > word.size() + least) continue;
    const std::size_t d = distance(lowerCase(word), lowerCase(name));
    if (d < least) least = d, best = name;
  }
  return best;
}

}  // namespace volumen
