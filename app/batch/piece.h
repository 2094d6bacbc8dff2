#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/command_line.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A piece of work: one command of a list, with the files that it writes.
struct Piece {
  int line = 0;                    ///< in the list, from 1
  std::string command, path;       ///< as written
  std::vector<std::string> words;  ///< the command line without the name of the program
  std::vector<std::string> reads;  ///< the path, and values of options that name files
  /// Files that it writes, "output" first. A name that ends with '/' is a folder. The stamp lies beside the
  /// first.
  std::vector<std::string> outputs;
  bool keepsStdout = false;  ///< the command writes to stdout, which becomes the first output
  std::string group;         ///< equal for pieces that one process does, as they read one series
  bool isFolder() const { return outputs[0].ends_with('/'); }
};

/// Returns the name of an output without the '/' behind a folder.
std::string bareName(const std::string& output);

/// Reads a list of work, a JSON object a line. Its keys are "command", "path", "output" or "csv", and long
/// options of the command without dashes. The value true sets a flag, and a list stands for its texts joined
/// by commas. Empty lines and lines that begin with # are skipped. The Error names the line: it is no JSON
/// object, has a key twice, an unknown command or option, a value that does not fit, or no output; or reading
/// it was cancelled.
Result<std::vector<Piece>> readPieces(std::string_view list, const CommandLine& commands,
                                      const CancelToken& cancel = {});

}  // namespace volumen
