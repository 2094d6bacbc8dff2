#include "app/option_words.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace volumen {

Result<glm::ivec2> sizeOf(const std::string& text) {
  glm::ivec2 size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%6dx%6d%c", &size.x, &size.y, &rest) != 2 || size.x < 1 || size.y < 1)
    return Error{"--size: \"" + text + "\" is not WIDTHxHEIGHT in pixels, as in 512x512."};
  return size;
}

Result<std::vector<double>> numbersOf(const std::string& option, const std::string& text, std::size_t count,
                                      const std::string& example) {
  const Error wrong{option + ": \"" + text + "\" is not " + std::to_string(count) +
                    " numbers with commas between them, as in " + example + "."};
  std::vector<double> numbers;
  const char *at = text.data(), *const end = at + text.size();
  for (std::size_t n = 0; n < count; ++n) {
    double number = 0;
    const auto [behind, error] = std::from_chars(at, end, number);
    const bool isLast = n + 1 == count;
    if (error != std::errc() || !std::isfinite(number) || (behind == end) != isLast ||
        (!isLast && *behind != ','))
      return wrong;
    numbers.push_back(number);
    at = behind + 1;
  }
  return numbers;
}

}  // namespace volumen
