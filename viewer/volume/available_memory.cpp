#include "viewer/volume/available_memory.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <new>
#include <sstream>
#include <string>

#include "viewer/volume/control_groups.h"

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

ProcessMemory processMemory(const std::string& folder) {
  const fs::path root(folder);
  ProcessMemory memory{unlimited, unlimited, MemoryBound::machine};
  constexpr std::uint64_t kibi = 1024;
  if (auto machine = numbersByName(root / "proc/meminfo"); machine.contains("MemTotal:")) {
    memory.most = machine["MemTotal:"] * kibi;
    // Kernels before 3.14 do not estimate it.
    memory.available = (machine.contains("MemAvailable:") ? machine["MemAvailable:"]
                                                          : machine["MemFree:"] + machine["Cached:"]) *
                       kibi;
  }
  for (bool version2 : {false, true})
    for (const fs::path& group : controlGroups(root, "memory", version2))
      lowerToGroup(memory, group, version2);
  auto own = numbersByName(root / "proc/self/status");
  lower(memory, limitOf(root, "Max address space"), own["VmSize:"] * kibi, MemoryBound::addressSpace);
  lower(memory, limitOf(root, "Max data size"), own["VmData:"] * kibi, MemoryBound::data);
  return memory;
}

namespace {

constexpr std::uint64_t mebibyte = 1 << 20;

// Room for stacks, tables and other data too small to be counted.
constexpr std::uint64_t besides = 32 * mebibyte;

struct BoundWords {
  std::string limit, remedy;
};

std::string dataLimit = "ulimit -d";

BoundWords wordsOf(MemoryBound bound) {
  switch (bound) {
    case MemoryBound::machine:
      break;
    case MemoryBound::controlGroup:
      return {"the limit of its control group", "allow the control group (container) more"};
    case MemoryBound::addressSpace:
      return {"the limit of ulimit -v", "allow more with ulimit -v"};
    case MemoryBound::data:
      return {"the limit of " + dataLimit, "allow more with " + dataLimit};
  }
  return {"free on this machine", "close other programs, or use a machine with more"};
}

bool asks = true;

bool isEnough(const ProcessMemory& memory, std::uint64_t bytes) {
  return bytes <= less(memory.available, besides);
}

}  // namespace

std::string memoryText(std::uint64_t bytes) {
  const std::uint64_t mebibytes = (bytes + mebibyte - 1) / mebibyte, tenths = (mebibytes * 10 + 1023) / 1024;
  if (mebibytes < 1024) return std::to_string(mebibytes) + " MiB";
  return std::to_string(tenths / 10) + '.' + std::to_string(tenths % 10) + " GiB";
}

bool isAvailable(std::uint64_t bytes) { return isEnough(processMemory(), bytes); }

Error tooLittleMemory(const std::string& what, std::uint64_t bytes) {
  const ProcessMemory memory = processMemory();
  const BoundWords words = wordsOf(memory.bound);
  return Error{what + " needs " + memoryText(bytes + besides) + " of memory, and " +
               memoryText(memory.available / mebibyte * mebibyte) + " are available (" + words.limit + "); " +
               words.remedy + "."};
}

Status checkAvailable(const std::string& what, std::uint64_t bytes) {
  return isAvailable(bytes) ? Status() : tooLittleMemory(what, bytes);
}

void nameDataLimit(const std::string& option) { dataLimit = option; }

void expectAllAvailable() { asks = false; }

void expectAvailable(std::uint64_t bytes) {
  if (asks && bytes >= besides && !isAvailable(bytes)) throw std::bad_alloc();
}

}  // namespace volumen
