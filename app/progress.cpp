#include "app/progress.h"

#include <unistd.h>

#include <cstdio>

namespace volumen {

namespace {
constexpr const char* clearLine = "\r\033[K";
bool onTerminal() { return isatty(STDERR_FILENO) == 1; }
}  // namespace

Progress terminalProgress() {
  if (!onTerminal()) return {};
  return [lastPercent = -1](const char* what, std::size_t done, std::size_t total) mutable {
    const int percent = total == 0 ? 0 : int(100.0 * double(done) / double(total));
    if (percent == lastPercent) return;
    lastPercent = percent;
    std::fprintf(stderr, "%s%s %d %%", clearLine, what, percent);
    std::fflush(stderr);
  };
}

void endTerminalProgress() {
  if (onTerminal()) std::fputs(clearLine, stderr);
}

}  // namespace volumen
