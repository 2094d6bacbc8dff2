#pragma once

#include <string>

#include "app/command_line.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Returns a list of work (readPieces()): a command for each study of the user's index that has all of
/// `words`. `typed` is the command as typed after `volumen`. Its {out} becomes a name of the study that is
/// fit for files. Returns an Error if the index or the command cannot be read, if no study has the words, or
/// if all studies would write one file. `isMistyped` then tells whether the command is at fault.
Result<std::string> listFromIndex(const std::string& words, const std::string& typed,
                                  const std::string& indexFolder, const CommandLine& commands,
                                  bool& isMistyped);

}  // namespace volumen
