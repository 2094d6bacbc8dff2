#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "app/printable.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Exit statuses of the program (design.md 4).
enum ExitStatus { exitDone = 0, exitFailed = 1, exitUsage = 2, exitLosses = 3 };

/// Adds a command's options to `app` and returns the function that runs it. `app` and the function's captures
/// live until it has run.
using MakeCommand = std::function<int()> (*)(CLI::App& app, const CancelToken& cancel);

// The makers of the commands, one file each in app/commands.
std::function<int()> makeAccuracy(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeArchive(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeBatch(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeBench(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeCompare(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeConvert(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeExport(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeForget(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeImport(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeInfo(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeList(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeMeasure(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeOpen(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeRender(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeSegment(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeSlice(CLI::App& app, const CancelToken& cancel);

/// Writes "volumen: SENTENCE" to stderr, with control characters escaped except line ends, and returns
/// exitFailed.
int fail(const std::string& sentence);
/// Reports only the interruption if the command was interrupted: nothing is left half written.
int fail(const std::string& sentence, const CancelToken& cancel);
/// Writes the sentence and returns exitUsage: the command line is invalid.
int failUsage(const std::string& sentence);

}  // namespace volumen
