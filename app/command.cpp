#include "app/command.h"

#include <iostream>
#include <sstream>

namespace volumen {

namespace {
// Prints each line separately, so that a list stays a list.
void tell(const std::string& sentence) {
  std::istringstream lines(sentence);
  const char* before = "volumen: ";
  for (std::string line; std::getline(lines, line); before = "")
    std::cerr << before << printable(line) << '\n';
}
}  // namespace

int fail(const std::string& sentence) {
  tell(sentence);
  return exitFailed;
}

int fail(const std::string& sentence, const CancelToken& cancel) {
  return fail(cancel.cancelled() ? "Interrupted; nothing was written." : sentence);
}

int failUsage(const std::string& sentence) {
  tell(sentence);
  return exitUsage;
}

}  // namespace volumen
