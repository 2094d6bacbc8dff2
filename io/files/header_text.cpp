#include "io/files/header_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/files/image_header.h"

namespace volumen {

namespace {

bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

template <class T>
std::optional<T> parsed(std::string_view text) {
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  T value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size()) return {};
  return value;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> found;
  while (!(text = trimmed(text)).empty()) {
    const std::size_t length = std::find_if(text.begin(), text.end(), isSpace) - text.begin();
    found.emplace_back(text.substr(0, length));
    text.remove_prefix(length);
  }
  return found;
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return lower;
}

std::string upperCase(std::string_view text) {
  std::string upper(text);
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
  return upper;
}

std::optional<double> toNumber(std::string_view text) { return parsed<double>(text); }
std::optional<std::int64_t> toInteger(std::string_view text) { return parsed<std::int64_t>(text); }

std::optional<std::vector<double>> toNumbers(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string& word : words(text)) {
    const auto number = toNumber(word);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<std::vector<std::uint64_t>> toSizes(std::string_view text) {
  std::vector<std::uint64_t> sizes;
  for (const std::string& word : words(text)) {
    const auto size = toInteger(word);
    if (!size || *size < 1) return {};
    sizes.push_back(std::uint64_t(*size));
  }
  return sizes;
}

std::string exactText(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value + 0.0).ptr);
}

std::string_view takeLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

Result<std::vector<std::string>> expandPattern(const std::vector<std::string>& patternAndRange,
                                               const std::string& path) {
  const Error unclear{path +
                      " names its data files by a pattern that is not understood; it must be NAME FIRST LAST "
                      "STEP with one %d (or %03d) in NAME."};
  if (patternAndRange.size() != 4) return unclear;
  const std::string& pattern = patternAndRange[0];
  const auto first = toInteger(patternAndRange[1]), last = toInteger(patternAndRange[2]),
             step = toInteger(patternAndRange[3]);
  const std::size_t percent = pattern.find('%'), end = pattern.find('d', percent);
  if (!first || !last || !step || *step == 0 || percent == std::string::npos || end == std::string::npos ||
      pattern.find('%', percent + 1) != std::string::npos)
    return unclear;
  const std::string width = pattern.substr(percent + 1, end - percent - 1);
  const std::int64_t digits = width.empty() ? 0 : toInteger(width).value_or(-1);
  constexpr std::int64_t largest = 1'000'000'000;
  if (digits < 0 || digits > 20 || std::abs(*first) > largest || std::abs(*last) > largest ||
      std::abs(*step) > largest)
    return unclear;
  const std::int64_t count = (*last - *first) / *step + 1;
  if ((*last<*first&& * step> 0) || (*last > *first && *step < 0) || count > std::int64_t(mostDataFiles))
    return unclear;
  std::vector<std::string> names;
  for (std::int64_t n = 0; n < count; ++n) {
    const std::int64_t value = *first + n * *step;
    std::string number = std::to_string(std::abs(value));
    const std::size_t sign = value < 0;
    if (number.size() + sign < std::size_t(digits))
      number.insert(0, digits - sign - number.size(), width[0] == '0' ? '0' : ' ');
    if (sign) number.insert(number.find_first_not_of(' '), 1, '-');
    names.push_back(pattern.substr(0, percent) + number + pattern.substr(end + 1));
  }
  return names;
}

std::string fieldText(std::string_view field) {
  constexpr std::size_t most = 200;
  std::string text(trimmed(field.substr(0, field.find('\0'))).substr(0, most));
  const auto ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  if (!std::all_of(text.begin(), text.end(), ascii))
    std::replace_if(text.begin(), text.end(), std::not_fn(ascii), '?');
  return text;
}

}  // namespace volumen
