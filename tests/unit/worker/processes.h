#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace volumen::tests {

/// Returns the children of a process, including zombies.
inline std::vector<pid_t> childrenOf(pid_t pid) {
  std::vector<pid_t> children;
  const std::string of = std::to_string(pid);
  std::ifstream list("/proc/" + of + "/task/" + of + "/children");
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

/// Returns the workers of this process.
inline std::vector<pid_t> workers() {
  std::vector<pid_t> all;
  for (const pid_t zygote : childrenOf(getpid()))
    for (const pid_t worker : childrenOf(zygote)) all.push_back(worker);
  return all;
}

/// A process's state as shown by ps, and its CPU time in ticks.
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

/// Returns the number of descriptors that this process has open.
inline std::size_t openDescriptors() {
  return std::size_t(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

/// Returns the peak memory of this process in MiB.
inline double peakMebibytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kibibytes = 0; word == "VmHWM:" && status >> kibibytes) return kibibytes / 1024;
  return 0;
}

}  // namespace volumen::tests
