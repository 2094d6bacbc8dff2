#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Splits a command line into words as a POSIX shell does, with quotes and backslashes, but expands nothing
/// (wordexp() of the C library would, and refuses characters such as < and ;). The Error is the end of a
/// sentence: a quote is not closed, or nothing follows a backslash.
Result<std::vector<std::string>> shellWords(std::string_view text);

}  // namespace volumen
