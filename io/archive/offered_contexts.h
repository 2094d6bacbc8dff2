#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/assoc.h>

#include <string>

namespace volumen {

/// Returns whether instances of a class may be stored here: of any standard or private class but those of the
/// standard that are known to be of other services.
bool isStorageClass(const std::string& sopClass);

/// Accepts the presentation contexts of a request for verification and storage, each with the transfer syntax
/// nearest to how instances are stored (storedSyntaxes). Refuses the others.
void acceptContexts(T_ASC_Parameters& parameters);

}  // namespace volumen
