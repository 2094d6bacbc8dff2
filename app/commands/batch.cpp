#include <unistd.h>

#include <charconv>
#include <iostream>
#include <iterator>
#include <memory>

#include "app/batch/gather.h"
#include "app/batch/list_from_index.h"
#include "app/batch/list_names.h"
#include "app/batch/run_list.h"
#include "app/command.h"
#include "app/index_option.h"
#include "app/usage.h"
#include "io/files/output_file.h"
#include "io/regular_file.h"
#include "io/worker/worker.h"

namespace volumen {

namespace {

struct BatchOptions {
  std::string list, shard, gathered, words, typed, index;
  PieceLimits limits;
};

Result<std::string> textOfList(const std::string& path) {
  constexpr std::uint64_t mostBytes = 256 << 20;
  if (path != "-") return wholeText(path, mostBytes, "a list of work");
  return std::string(std::istreambuf_iterator<char>(std::cin), {});
}

// Returns why a process cannot work with so many bytes; empty: it can. Negative numbers are read as huge
// ones.
std::string problemOfMemory(const std::string& bytes) {
  constexpr std::uint64_t least = 64 << 20, most = std::uint64_t(1) << 60;
  std::uint64_t number = 0;
  std::from_chars(bytes.data(), bytes.data() + bytes.size(), number);
  return number < least || number > most ? "a process needs 64M or more." : "";
}

Status checkBatch(const BatchOptions& options, Shard shard) {
  if (options.typed.empty() != options.words.empty())
    return Error{"--from-index and --do make a list together: give both."};
  if (options.typed.empty() == options.list.empty())
    return Error{"Give a list of work, or --from-index and --do, which write one to stdout."};
  if (!options.gathered.empty() && shard.count > 1)
    return Error{
        "--gather joins what all shards made: run the list once more without a shard when they have ended."};
  return {};
}

int makeList(const BatchOptions& options, const CommandLine& commands) {
  bool isMistyped = false;
  const auto list = listFromIndex(options.words, options.typed, options.index, commands, isMistyped);
  if (!list) return isMistyped ? failUsage(list.message()) : fail(list.message());
  std::cout << *list;
  return exitDone;
}

int statusOf(const ListResult& result) {
  std::cerr << "volumen: " << result.done << " done, " << result.skipped << " done before, " << result.failed
            << " failed" << (result.interrupted ? "; interrupted" : "") << ".\n";
  if (result.failed > 0 || result.interrupted) return exitFailed;
  return result.withLosses > 0 ? exitLosses : exitDone;
}

int run(const BatchOptions& options, const CancelToken& cancel) {
  const auto shard = shardOf(options.shard);
  if (!shard) return failUsage(shard.message());
  if (Status s = checkBatch(options, *shard); !s) return failUsage(s.message());
  const CommandLine commands(cancel);
  if (!options.typed.empty()) return makeList(options, commands);
  const auto text = textOfList(options.list);
  if (!text) return fail(text.message());
  const auto pieces = readPieces(*text, commands, cancel);
  if (!pieces) return failUsage(pieces.message());
  if (Status s = checkNames(*pieces, options.list, options.gathered, cancel); !s)
    return failUsage(s.message());
  worker::stop();  // each process of a piece has its own
  const ListResult result = runList(dealt(*pieces, *shard), options.limits, cancel);
  const int status = statusOf(result);
  if (options.gathered.empty() || result.interrupted) return status;
  const Status gathered = gather(result.there, options.gathered);
  return gathered ? status : fail(gathered.message());
}

}  // namespace

std::function<int()> makeBatch(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<BatchOptions>();
  app.add_option(
         "LIST", options->list,
         "A list of work, or - for stdin: a JSON object a line with \"command\" (render, slice, segment, "
         "measure, info, convert, export), \"path\", \"output\", and the command's long options")
      ->type_name("");
  app.add_option("--shard", options->shard,
                 "Do the I-th of N parts of the list (default: that of the Slurm array, else all)")
      ->type_name("I/N");
  app.add_option("--max-memory", options->limits.bytes,
                 "Memory that a piece of work may take, such as 4G, at least 64M (default: all there is)")
      ->transform(CLI::AsSizeValue(false).description(""))
      ->check(CLI::Validator(problemOfMemory, ""))
      ->type_name("BYTES");
  number(app.add_option("--timeout", options->limits.seconds,
                        "Seconds that a piece of work may take (default: as long as it takes)")
             ->type_name("SECONDS"),
         1, 1e6);
  app.add_option("--gather", options->gathered, "Join the tables (.csv) of all pieces into this one")
      ->type_name("FILE");
  app.add_option(
         "--from-index", options->words,
         "Write a list for the studies of the index that have all of these words, and do nothing else")
      ->type_name("WORDS");
  app.add_option("--do", options->typed,
                 "The command for each of these studies, without PATH; {out} becomes a name for its files")
      ->type_name("COMMAND");
  addIndex(app, options->index);
  addExamples(app, {"volumen batch jobs.jsonl --shard 3/20",
                    "volumen batch --from-index ct --do \"segment --recipe bone --csv {out}.csv\""});
  return [options, cancel] { return run(*options, cancel); };
}

}  // namespace volumen
