#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "app/printable.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Exit statuses of the program (design.md 4).
enum ExitStatus { exitDone = 0, exitFailed = 1, exitUsage = 2, exitLosses = 3 };

/// One command: adds its options to `app` and returns what runs it. `app` and what the function captured live
/// until it has run.
using MakeCommand = std::function<int()> (*)(CLI::App& app, const CancelToken& cancel);

// One file a command in app/commands.
std::function<int()> makeAccuracy(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeBench(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeCompare(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeConvert(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeForget(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeImport(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeInfo(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeList(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeMeasure(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeOpen(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeRender(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeSegment(CLI::App& app, const CancelToken& cancel);
std::function<int()> makeSlice(CLI::App& app, const CancelToken& cancel);

/// Writes "volumen: SENTENCE" to stderr, control characters but line ends escaped, and returns exitFailed.
int fail(const std::string& sentence);
/// The same; where the command was interrupted that alone is said: nothing is left half written.
int fail(const std::string& sentence, const CancelToken& cancel);
/// The same with exitUsage, for a command line that cannot be meant.
int failUsage(const std::string& sentence);

}  // namespace volumen
