#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcxfer.h>

#include <string>

#include "io/files/output_file.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

class DcmFileFormat;

namespace volumen {

/// Writes DCMTK's output to a file one buffer at a time. The Error names `path`.
Status writeDicomFile(DcmFileFormat& file, OutputFile& out, const std::string& path,
                      E_TransferSyntax syntax = EXS_LittleEndianExplicit);

/// Begins a file that must not exist yet. The Error names it.
Result<OutputFile> createNew(const std::string& path);
/// Completes a file that still must not exist, whoever made it meanwhile. The Error names it.
Status commitNew(OutputFile& out, const std::string& path);

/// Writes a data set to a new file, whole or not at all: Explicit VR Little Endian, or Implicit if a value is
/// longer than the 64 kB that Explicit can say. The Error names the file: it exists, cannot be written, or
/// the export was cancelled.
Status writeNewDicom(DcmFileFormat& file, const std::string& path, const CancelToken& cancel);

}  // namespace volumen
