#include "io/study/natural_order.h"

#include <algorithm>

namespace volumen {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Removes the leading digits of `text` and returns them without leading zeros.
std::string_view takeNumber(std::string_view& text) {
  const auto end = std::size_t(std::ranges::find_if_not(text, isDigit) - text.begin());
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

}  // namespace

int naturalOrder(std::string_view a, std::string_view b) {
  std::string_view restA = a, restB = b;
  while (!restA.empty() && !restB.empty()) {
    if (isDigit(restA[0]) && isDigit(restB[0])) {
      const std::string_view x = takeNumber(restA), y = takeNumber(restB);
      if (x.size() != y.size()) return x.size() < y.size() ? -1 : 1;
      if (const int order = x.compare(y)) return order;
    } else {
      if (restA[0] != restB[0]) return restA[0] < restB[0] ? -1 : 1;
      restA.remove_prefix(1);
      restB.remove_prefix(1);
    }
  }
  if (restA.empty() != restB.empty()) return restA.empty() ? -1 : 1;
  return a.compare(b);  // "01" and "1"
}

}  // namespace volumen
