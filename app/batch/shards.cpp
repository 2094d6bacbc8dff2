#include "app/batch/shards.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <map>
#include <optional>

namespace volumen {

namespace {

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
  std::vector<std::size_t> load(count);
  std::vector<std::vector<Piece>> own;
  for (std::vector<Piece>& group : groupsOf(pieces, part)) {
    const auto least = std::ranges::min_element(load);
    *least += group.size();
    if (least - load.begin() == shard.index - 1) own.push_back(std::move(group));
  }
  return own;
}

}  // namespace volumen
