#include "io/study/iso_date.h"

#include <algorithm>
#include <cctype>

namespace volumen {

std::string isoDate(const std::string& date) {
  std::string digits = date;
  if (date.size() == 10 && date[4] == '.' && date[7] == '.') std::erase(digits, '.');
  const auto isDigit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (digits.size() != 8 || !std::ranges::all_of(digits, isDigit)) return date;
  return digits.substr(0, 4) + "-" + digits.substr(4, 2) + "-" + digits.substr(6);
}

}  // namespace volumen
