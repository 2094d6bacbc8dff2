#include "io/files/b_values.h"

#include <algorithm>
#include <filesystem>

#include "io/files/data_file.h"
#include "io/files/header_text.h"

namespace volumen {

std::vector<double> bValuesBeside(const std::string& path, std::size_t count,
                                  std::vector<Warning>& warnings) {
  constexpr std::size_t mostBytes = 1 << 20;
  constexpr double most = 1e6;  // s/mm^2
  std::filesystem::path name = std::filesystem::path(path).filename();
  if (lowerCase(name.extension().string()) == ".gz") name.replace_extension();
  name.replace_extension(".bval");
  const auto file = resolveBeside(path, name.string());
  if (!file) return {};
  const auto text = readHead(*file, mostBytes);
  const auto numbers = text ? toNumbers(*text) : std::nullopt;
  const bool fits = numbers && numbers->size() == count &&
                    std::ranges::all_of(*numbers, [](double b) { return b >= 0 && b <= most; });
  if (fits) return *numbers;
  warnings.emplace_back(fieldText(name.string()) + " is not used: it does not hold " + std::to_string(count) +
                        " numbers, a diffusion weight for each volume.");
  return {};
}

}  // namespace volumen
