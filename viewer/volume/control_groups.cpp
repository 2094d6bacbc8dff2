#include "viewer/volume/control_groups.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace volumen {

namespace {

namespace fs = std::filesystem;

bool listed(const std::string& names, const std::string& name) {
  return ("," + names + ",").find("," + name + ",") != std::string::npos;
}

// A tree of control groups: its mount point, and the group visible there as its root.
struct GroupTree {
  fs::path mountedAt, rootGroup;
};

std::vector<GroupTree> groupTrees(const fs::path& root, const std::string& controller, bool version2) {
  std::vector<GroupTree> trees;
  std::ifstream file(root / "proc/self/mountinfo");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word, group, place, type, source, options;
    words >> word >> word >> word >> group >> place;
    while (words >> word && word != "-") {
    }
    words >> type >> source >> options;
    if (version2 ? type == "cgroup2" : type == "cgroup" && listed(options, controller))
      trees.push_back({root / fs::path(place).relative_path(), group});
  }
  return trees;
}

// Returns the process's group in the tree, from its line in proc/self/cgroup.
std::string groupOfProcess(const fs::path& root, const std::string& controller, bool version2) {
  std::ifstream file(root / "proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (version2 ? controllers.empty() : listed(controllers, controller)) return line.substr(second + 1);
  }
  return "/";
}

constexpr int noQuota = 1 << 20;

// Quota and period are in microseconds. Version 1 gives -1 for no quota, version 2 the word "max".
int threadsOf(double quota, double period) {
  return quota > 0 && period > 0 ? std::max(1, int(std::ceil(std::min(quota / period, double(noQuota)))))
                                 : noQuota;
}

int threadsOfGroup(const fs::path& group, bool version2) {
  double quota = 0, period = 0;
  if (version2)
    std::ifstream(group / "cpu.max") >> quota >> period;
  else if (std::ifstream(group / "cpu.cfs_quota_us") >> quota)
    std::ifstream(group / "cpu.cfs_period_us") >> period;
  return threadsOf(quota, period);
}

}  // namespace

std::vector<fs::path> controlGroups(const fs::path& root, const std::string& controller, bool version2) {
  std::vector<fs::path> groups;
  const std::string name = groupOfProcess(root, controller, version2);
  for (const GroupTree& tree : groupTrees(root, controller, version2)) {
    // In a container the own group is mounted as the root, but named as seen from outside.
    const fs::path below = fs::path(name).lexically_relative(tree.rootGroup);
    const bool inside = !below.empty() && *below.begin() != ".." && below != ".";
    fs::path group = tree.mountedAt;
    groups.push_back(group);
    if (!inside) continue;
    for (const fs::path& part : below) groups.push_back(group /= part);
  }
  return groups;
}

int threadsOfControlGroups(const fs::path& root) {
  int threads = noQuota;
  for (const bool version2 : {false, true})
    for (const fs::path& group : controlGroups(root, "cpu", version2))
      threads = std::min(threads, threadsOfGroup(group, version2));
  return threads;
}

}  // namespace volumen
