#pragma once

#include "io/files/image_header.h"

namespace volumen {

/// What the first bytes of a file (decompressed where it is gzip) and its name in lower case claim it to be.
struct FileClaim {
  const std::string& head;
  const std::string& name;
  bool isCompressed = false;
};

/// Whether a file claims to be Analyze 7.5 (the .hdr of a pair), MGH or MGZ (FreeSurfer), GIPL, VTK (legacy),
/// MRC (MRC2014).
bool isAnalyze(const FileClaim& file);
bool isMgh(const FileClaim& file);
bool isGipl(const FileClaim& file);
bool isVtk(const FileClaim& file);
bool isMrc(const FileClaim& file);

/// Their headers, checked: sizes, types, and that the file can hold what it promises. GIPL, VTK, MRC and
/// Analyze give no directions, which is said; without spacing the volume is not calibrated. An Error names
/// the file and what cannot be shown: colour, complex numbers, packed bits, grids other than structured
/// points.
Result<ImageHeader> readAnalyzeHeader(const std::string& path);
Result<ImageHeader> readMghHeader(const std::string& path);
Result<ImageHeader> readGiplHeader(const std::string& path);
Result<ImageHeader> readVtkHeader(const std::string& path);
Result<ImageHeader> readMrcHeader(const std::string& path);

/// The name of a format that is known but not read (HDF5, MINC, TIFF, Bruker, PAR/REC ...); empty where it is
/// none.
std::string unreadFormat(const FileClaim& file);

}  // namespace volumen
