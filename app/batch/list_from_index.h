#pragma once

#include <string>

#include "app/command_line.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Returns a list of work (readPieces()): a command, as typed after `volumen`, for each study of the user's
/// index that has all of these words. In the command, {out} becomes a name of the study that is fit for a
/// file. The Error: the index or the command cannot be read, no study has the words, or all studies would
/// write one file. `isMistyped` tells whether the command is at fault.
Result<std::string> listFromIndex(const std::string& words, const std::string& typed,
                                  const std::string& indexFolder, const CommandLine& commands,
                                  bool& isMistyped);

}  // namespace volumen
