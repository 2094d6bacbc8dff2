#pragma once

#include <sys/types.h>

#include <string>

namespace volumen {

/// What is written stands under such a name, in the folder that it is for, until it is whole (mkstemp).
inline constexpr const char* asideName = ".volumen-XXXXXX";

/// Where a name leads: the end of its symbolic links, whether something is there or not.
std::string endOfLinks(const std::string& name);

/// Keeps other programs from taking an open file or folder of that name for one that was left behind.
void claimAside(int descriptor);

/// The rights that are kept from what this process makes (its umask).
mode_t rightsKept();

/// Removes what programs that were killed have left aside in a folder ("": the working one); looks once a
/// run.
void sweepAside(const std::string& folder);

}  // namespace volumen
