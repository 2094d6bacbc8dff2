#include "viewer/volume/free_name.h"

#include <algorithm>
#include <charconv>

namespace volumen {

namespace {

// "Bone (3)" is the third "Bone".
struct CountedName {
  std::string name;
  int count = 1;
};

CountedName countedName(const std::string& name) {
  constexpr int most = 999;  // larger numbers are years or the like
  const std::size_t open = name.rfind(" (");
  if (open == std::string::npos || !name.ends_with(')')) return {name};
  const char *const first = name.data() + open + 2, *const end = name.data() + name.size() - 1;
  int count = 0;
  const auto read = std::from_chars(first, end, count);
  const bool isCount = read.ec == std::errc() && read.ptr == end && count >= 2 && count < most;
  return isCount ? CountedName{name.substr(0, open), count} : CountedName{name};
}

}  // namespace

bool isBlank(const std::string& name) {
  return std::ranges::all_of(name, [](unsigned char c) { return c <= ' '; });
}

std::string freeName(const std::string& wanted, const std::function<bool(const std::string&)>& isTaken) {
  auto [name, count] = countedName(wanted);
  std::string free = wanted;
  while (isTaken(free)) free = name + " (" + std::to_string(++count) + ")";
  return free;
}

}  // namespace volumen
