#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace volumen::tests {

/// The processes that a process has forked, also those that ended and that nobody asked for.
inline std::vector<pid_t> childrenOf(pid_t pid) {
  std::vector<pid_t> children;
  const std::string of = std::to_string(pid);
  std::ifstream list("/proc/" + of + "/task/" + of + "/children");
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

/// The workers of this process.
inline std::vector<pid_t> workers() {
  std::vector<pid_t> all;
  for (const pid_t zygote : childrenOf(getpid()))
    for (const pid_t worker : childrenOf(zygote)) all.push_back(worker);
  return all;
}

/// A process's state as ps shows it, and how long it has computed, in ticks.
struct Activity {
  char state = 0;
  long ticks = 0;
};
inline Activity activityOf(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string skipped;
  Activity now;
  std::getline(stat, skipped, ')');
  stat >> now.state;
  for (int n = 0; n < 10; ++n) stat >> skipped;
  stat >> now.ticks;
  return now;
}

/// How many descriptors this process has open.
inline std::size_t openDescriptors() {
  return std::size_t(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

/// The most memory that this process has had at once, in MiB.
inline double peakMebibytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kibibytes = 0; word == "VmHWM:" && status >> kibibytes) return kibibytes / 1024;
  return 0;
}

}  // namespace volumen::tests
