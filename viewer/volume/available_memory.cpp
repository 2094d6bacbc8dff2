#include "viewer/volume/available_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace volumen {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t less(std::uint64_t limit, std::uint64_t used) { return limit > used ? limit - used : 0; }

// Returns the number in a file. Words such as "max" mean no limit.
std::uint64_t numberIn(const fs::path& path) {
  std::uint64_t number = 0;
  return std::ifstream(path) >> number ? number : unlimited;
}

// Returns the numbers of lines such as "MemTotal:  8000000 kB" or "inactive_file 4096", unscaled.
std::map<std::string, std::uint64_t> numbersByName(const fs::path& path) {
  std::map<std::string, std::uint64_t> numbers;
  std::ifstream file(path);
  std::string line, name;
  std::uint64_t number = 0;
  while (std::getline(file, line))
    if (std::istringstream words(line); words >> name >> number) numbers[name] = number;
  return numbers;
}

bool listed(const std::string& names, const std::string& name) {
  return ("," + names + ",").find("," + name + ",") != std::string::npos;
}

// A tree of control groups: its mount point, and the group visible there as its root.
struct GroupTree {
  fs::path mountedAt, rootGroup;
};

// Returns the trees that limit memory in version 1 or 2.
std::vector<GroupTree> groupTrees(const fs::path& root, bool version2) {
  std::vector<GroupTree> trees;
  std::ifstream file(root / "proc/self/mountinfo");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word, group, place, type, source, options;
    words >> word >> word >> word >> group >> place;
    while (words >> word && word != "-") {
    }
    words >> type >> source >> options;
    if (version2 ? type == "cgroup2" : type == "cgroup" && listed(options, "memory"))
      trees.push_back({root / fs::path(place).relative_path(), group});
  }
  return trees;
}

// Returns the process's group in the tree, from its line in proc/self/cgroup.
std::string groupOfProcess(const fs::path& root, bool version2) {
  std::ifstream file(root / "proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (version2 ? controllers.empty() : listed(controllers, "memory")) return line.substr(second + 1);
  }
  return "/";
}

void lower(ProcessMemory& memory, std::uint64_t limit, std::uint64_t used, MemoryBound bound) {
  if (limit == unlimited) return;
  memory.most = std::min(memory.most, limit);
  if (const std::uint64_t left = less(limit, used); left < memory.available)
    memory.available = left, memory.bound = bound;
}

void lowerToGroup(ProcessMemory& memory, const fs::path& group, bool version2) {
  const std::uint64_t limit = numberIn(group / (version2 ? "memory.max" : "memory.limit_in_bytes"));
  if (limit == unlimited) return;
  const std::uint64_t used = numberIn(group / (version2 ? "memory.current" : "memory.usage_in_bytes"));
  auto parts = numbersByName(group / "memory.stat");
  // Version 1 counts child groups in separate lines.
  const std::uint64_t cached = version2
                                   ? parts["inactive_file"] + parts["active_file"] + parts["slab_reclaimable"]
                                   : parts["total_inactive_file"] + parts["total_active_file"];
  lower(memory, limit, used == unlimited ? 0 : less(used, cached), MemoryBound::controlGroup);
}

void lowerToGroups(ProcessMemory& memory, const fs::path& root, bool version2) {
  const std::string name = groupOfProcess(root, version2);
  for (const GroupTree& tree : groupTrees(root, version2)) {
    // In a container the own group is mounted as the root, but named as seen from outside.
    const fs::path below = fs::path(name).lexically_relative(tree.rootGroup);
    fs::path group = tree.mountedAt;
    const bool inside = !below.empty() && *below.begin() != ".." && below != ".";
    lowerToGroup(memory, group, version2);
    if (!inside) continue;
    for (const fs::path& part : below) lowerToGroup(memory, group /= part, version2);
  }
}

// Returns a limit of `ulimit` from lines such as "Max address space  1073741824  unlimited  bytes".
std::uint64_t limitOf(const fs::path& root, const std::string& name) {
  std::ifstream file(root / "proc/self/limits");
  for (std::string line; std::getline(file, line);) {
    std::uint64_t number = 0;
    if (line.starts_with(name) && std::istringstream(line.substr(name.size())) >> number) return number;
  }
  return unlimited;
}

}  // namespace

ProcessMemory processMemory(const fs::path& root) {
  ProcessMemory memory{unlimited, unlimited, MemoryBound::machine};
  constexpr std::uint64_t kibi = 1024;
  if (auto machine = numbersByName(root / "proc/meminfo"); machine.contains("MemTotal:")) {
    memory.most = machine["MemTotal:"] * kibi;
    // Kernels before 3.14 do not estimate it.
    memory.available = (machine.contains("MemAvailable:") ? machine["MemAvailable:"]
                                                          : machine["MemFree:"] + machine["Cached:"]) *
                       kibi;
  }
  for (bool version2 : {false, true}) lowerToGroups(memory, root, version2);
  auto own = numbersByName(root / "proc/self/status");
  lower(memory, limitOf(root, "Max address space"), own["VmSize:"] * kibi, MemoryBound::addressSpace);
  lower(memory, limitOf(root, "Max data size"), own["VmData:"] * kibi, MemoryBound::data);
  return memory;
}

}  // namespace volumen
