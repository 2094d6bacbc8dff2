#pragma once

#include "io/files/image_header.h"

namespace volumen {

/// First bytes of a file (decompressed if it is gzip) and its lower-case name, from which its format is
/// detected.
struct FileClaim {
  const std::string& head;
  const std::string& name;
  bool isCompressed = false;
};

/// True if a file claims to be Analyze 7.5 (the .hdr of a pair), MGH or MGZ (FreeSurfer), GIPL, VTK (legacy)
/// or MRC (MRC2014).
bool isAnalyze(const FileClaim& file);
bool isMgh(const FileClaim& file);
bool isGipl(const FileClaim& file);
bool isVtk(const FileClaim& file);
bool isMrc(const FileClaim& file);

/// These functions read headers and check sizes, types and the file's length. GIPL, VTK, MRC and Analyze give
/// no directions, which adds a warning; without spacing the volume is not calibrated. The Error names the
/// file and the unsupported content: colour, complex numbers, packed bits, grids other than structured
/// points.
Result<ImageHeader> readAnalyzeHeader(const std::string& path);
Result<ImageHeader> readMghHeader(const std::string& path);
Result<ImageHeader> readGiplHeader(const std::string& path);
Result<ImageHeader> readVtkHeader(const std::string& path);
Result<ImageHeader> readMrcHeader(const std::string& path);

/// Returns the name of a known but unsupported format (HDF5, MINC, TIFF, Bruker, PAR/REC ...), else an empty
/// string.
std::string unreadFormat(const FileClaim& file);

}  // namespace volumen
