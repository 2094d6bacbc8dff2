#pragma once

#include <string>
#include <vector>

#include "io/deidentify/file_parts.h"
#include "io/deidentify/profile.h"
#include "io/export/dicom_pixels.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// How files are de-identified.
struct Deidentification {
  Retained retained;
  std::string key;      ///< of Pseudonyms
  bool deface = false;  ///< take faces from heads of CT and MR (FacelessSeries); all UIDs are then others
};

/// The Error of deidentifiedFile() for a file that is not DICOM.
inline constexpr const char* noDicomFile = "it is no DICOM file";

/// A DICOM file without identity: what to write, and what the pixels may still show.
struct DeidentifiedFile {
  std::vector<FilePart> parts;  ///< of the data set, in `transferSyntax`
  std::string transferSyntax, sopClass, studyUid, seriesUid, instanceUid;  ///< the new ones
  std::string modality;
  bool mayShowText = false;    ///< names may be burned into the pixels
  bool mayShowFace = false;    ///< a face may be recognised in a rendering
  bool hasLostSuv = false;     ///< weight or times are gone, without which PET shows no SUV
  bool hasLostMosaic = false;  ///< the private header is gone that tells the slices of a Siemens mosaic
  dicom::Encoding encoding;    ///< of the data set
  std::size_t words = 0;       ///< of 16 bits, in its pixels; 0 if these are of another kind
};

/// Returns a file of PS3.10 de-identified (rewriteDataSet()), read in a worker if there are any. The Error,
/// without the file's name and full stop: it cannot be read, or it is of a class that cannot be cleaned.
Result<DeidentifiedFile> deidentifiedFile(const std::string& path, const Deidentification& how,
                                          const CancelToken& cancel);

/// Returns a picture of one frame de-identified in the same way, with `pixels` in place of its own. `pixels`
/// lack the face, so the picture is DERIVED, with Recognizable Visual Features NO and the code of that
/// option, and uncompressed. The Error also: its own pixels are not as many words of 16 bits.
Result<DeidentifiedFile> facelessFile(const std::string& path, const StoredSlice& pixels,
                                      const Deidentification& how, const CancelToken& cancel);

/// Returns whether a file holds exactly what writeDeidentified() would write.
bool isWrittenAt(const DeidentifiedFile& file, const std::string& source, const std::string& path);

/// Writes the de-identified copy of `source` to the new file `to`. The Error: `to` exists or cannot be
/// written, or `source` cannot be read.
Status writeDeidentified(const DeidentifiedFile& file, const std::string& source, const std::string& to);

}  // namespace volumen
