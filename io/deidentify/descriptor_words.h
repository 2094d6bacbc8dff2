#pragma once

#include <string>

namespace volumen {

/// Returns the words of a description that a list of anatomy, techniques and directions holds, and numbers of
/// up to three digits, in their order; other words may name somebody (PS3.15 E.3.5).
std::string knownWordsOf(const std::string& description);

}  // namespace volumen
