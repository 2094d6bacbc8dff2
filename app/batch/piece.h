#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/command_line.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A piece of work: one command of a list, and the files that it reads and writes.
struct Piece {
  int line = 0;                    ///< line in the list, from 1
  std::string command, path;       ///< as written in the list
  std::vector<std::string> words;  ///< the command line without the name of the program
  std::vector<std::string> reads;  ///< the path, and files that options name
  /// Names of the files that it writes, "output" first. A name that ends with '/' is a folder. The stamp
  /// lies beside the first file.
  std::vector<std::string> outputs;
  bool keepsStdout = false;  ///< true if stdout of the command becomes the first output
  std::string group;         ///< equal for pieces that read one series, which one process does
  bool isFolder() const { return outputs[0].ends_with('/'); }
};

/// Returns the name of an output without the '/' at the end of a folder.
std::string bareName(const std::string& output);

/// Reads a list of work: one JSON object a line. Its keys are "command", "path", "output" or "csv", and long
/// options of the command without dashes. The value true sets a flag. An array stands for its texts joined
/// by commas. Empty lines and lines that begin with # are skipped. Returns an Error that names the line if
/// it is no JSON object, has a key twice, an unknown command or option, a value that does not fit, or no
/// output. Returns an Error, too, if reading was cancelled.
Result<std::vector<Piece>> readPieces(std::string_view list, const CommandLine& commands,
                                      const CancelToken& cancel = {});

}  // namespace volumen
