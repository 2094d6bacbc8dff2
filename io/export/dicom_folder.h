#pragma once

#include <functional>
#include <string>

#include "viewer/volume/result.h"

class DcmFileFormat;

namespace volumen {

/// Checks that a series can be written into this folder: it is empty, or can be created. Leaves nothing
/// behind. The Error names the folder.
Status checkDicomFolder(const std::string& folder);

/// Makes a folder of what `write` writes into a temporary one, whole or not at all. The Error: as
/// checkDicomFolder(), or that of `write`.
Status writeDicomFolder(const std::string& folder,
                        const std::function<Status(const std::string& aside)>& write);

/// Saves slice `k` of a series into a folder (Explicit VR Little Endian). The Error names the file.
Status saveSlice(DcmFileFormat& file, const std::string& folder, int k);

}  // namespace volumen
