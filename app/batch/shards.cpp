#include "app/batch/shards.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <utility>

namespace volumen {

namespace {

constexpr int mostShards = 1000000;

std::optional<int> wholeNumberIn(std::string_view text) {
  int number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool isWhole = problem == std::errc() && end == text.data() + text.size();
  return isWhole ? std::optional(number) : std::nullopt;
}

std::optional<int> numberInEnvironment(const char* name) {
  const char* text = std::getenv(name);
  return text ? wholeNumberIn(text) : std::nullopt;
}

// Returns the groups of pieces, in the order of their first pieces, none larger than `most`.
std::vector<std::vector<Piece>> groupsOf(const std::vector<Piece>& pieces, std::size_t most) {
  std::vector<std::vector<Piece>> groups;
  std::map<std::string, std::size_t> open;
  for (const Piece& piece : pieces) {
    const auto found = open.find(piece.group);
    if (found == open.end() || groups[found->second].size() >= most) {
      open[piece.group] = groups.size();
      groups.emplace_back();
    }
    groups[open[piece.group]].push_back(piece);
  }
  return groups;
}

}  // namespace

Result<Shard> shardOf(const std::string& text) {
  Shard shard;
  if (const std::size_t slash = text.find('/'); !text.empty()) {
    const auto index = wholeNumberIn(text.substr(0, slash));
    const auto count = slash == text.npos ? std::nullopt : wholeNumberIn(text.substr(slash + 1));
    if (!index || !count || *index < 1 || *index > *count)
      return Error{"--shard is I/N, such as 3/20: the third of twenty parts."};
    if (*count > mostShards)
      return Error{"--shard has " + std::to_string(*count) + " parts: give at most " +
                   std::to_string(mostShards) + "."};
    return Shard{*index, *count};
  }
  const auto id = numberInEnvironment("SLURM_ARRAY_TASK_ID"),
             count = numberInEnvironment("SLURM_ARRAY_TASK_COUNT");
  if (!id || !count) return shard;
  const int first = numberInEnvironment("SLURM_ARRAY_TASK_MIN").value_or(0),
            step = std::max(1, numberInEnvironment("SLURM_ARRAY_TASK_STEP").value_or(1));
  shard = {(*id - first) / step + 1, *count};
  if ((*id - first) % step != 0 || shard.index < 1 || shard.index > shard.count)
    return Error{
        "The numbers of this Slurm array have gaps: submit the whole array, as what is done is skipped, or "
        "give --shard."};
  return shard;
}

std::vector<std::vector<Piece>> dealt(const std::vector<Piece>& pieces, Shard shard) {
  const auto count = std::size_t(shard.count);
  const std::size_t part = std::max<std::size_t>(1, (pieces.size() + count - 1) / count);
  std::vector<std::vector<Piece>> groups = groupsOf(pieces, part), own;
  // Load and index of shards, the least one first. Shards that are more than groups get none.
  using Load = std::pair<std::size_t, std::size_t>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (std::size_t n = 0; n < std::min(count, groups.size()); ++n) loads.emplace(0, n);
  for (std::vector<Piece>& group : groups) {
    const auto [load, index] = loads.top();
    loads.pop();
    loads.emplace(load + group.size(), index);
    if (index + 1 == std::size_t(shard.index)) own.push_back(std::move(group));
  }
  return own;
}

}  // namespace volumen
