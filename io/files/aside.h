#pragma once

#include <sys/types.h>

#include <string>

namespace volumen {

/// Name of temporary files and folders, beside their final place, until they are complete (mkstemp).
inline constexpr const char* asideName = ".volumen-XXXXXX";

/// Returns the end of a name's symbolic links, even if nothing exists there.
std::string endOfLinks(const std::string& name);

/// Locks an open temporary file or folder, so that other programs do not take it for an abandoned one.
void claimAside(int descriptor);

/// Returns the permission bits that this process does not grant to new files (its umask).
mode_t rightsKept();

/// Removes temporary files that killed programs left in a folder ("": the working directory). Looks once a
/// run.
void sweepAside(const std::string& folder);

}  // namespace volumen
