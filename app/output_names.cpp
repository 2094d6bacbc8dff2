#include "app/output_names.h"

#include <cstdio>
#include <filesystem>
#include <set>

namespace volumen {

std::string placeOfFile(const std::string& path) {
  std::error_code failed;
  const auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(path, failed), failed);
  return failed ? path : place.string();
}

std::string numberedName(const std::string& path, int n) {
  const std::size_t dot = path.rfind('.');
  char number[16];
  std::snprintf(number, sizeof number, "-%03d", n);
  return path.substr(0, dot) + number + path.substr(dot);
}

Status checkApart(std::span<const std::string> written, std::span<const std::string> read) {
  std::set<std::string> inputs, outputs;
  for (const std::string& path : std::set<std::string>(read.begin(), read.end()))
    inputs.insert(placeOfFile(path));
  for (const std::string& path : written) {
    const std::string place = placeOfFile(path);
    if (inputs.contains(place))
      return Error{"Cannot write " + path + ": it is a file that is read; choose another name."};
    if (!outputs.insert(place).second)
      return Error{"Cannot write " + path + ": another file of this command has this name."};
  }
  return {};
}

}  // namespace volumen
