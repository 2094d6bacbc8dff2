#pragma once

#include <string>
#include <vector>

#include "io/deidentify/file_parts.h"
#include "io/deidentify/profile.h"
#include "io/export/dicom_pixels.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Says how files are de-identified.
struct Deidentification {
  Retained retained;
  std::string key;      ///< secret key of the Pseudonyms
  bool deface = false;  ///< remove faces from heads in CT and MR (FacelessSeries), which changes all new UIDs
};

/// The message of the Error of deidentifiedFile() for a file that is not DICOM.
inline constexpr const char* noDicomFile = "it is no DICOM file";

/// A de-identified DICOM file: the bytes to write, and what its pixels may still show.
struct DeidentifiedFile {
  std::vector<FilePart> parts;  ///< the data set, in `transferSyntax`
  std::string transferSyntax, sopClass, studyUid, seriesUid, instanceUid;  ///< after de-identification
  std::string modality;
  bool mayShowText = false;    ///< names may be burned into the pixels
  bool mayShowFace = false;    ///< a face may be recognised in a rendering
  bool hasLostSuv = false;     ///< PET without weight or times, from which SUV cannot be computed
  bool hasLostMosaic = false;  ///< a Siemens mosaic without the private header that tells its slices apart
  dicom::Encoding encoding;    ///< of the data set
  std::size_t words = 0;       ///< number of pixels of one 16-bit grey frame; 0 for all other pixels
};

/// Returns a DICOM file (PS3.10) de-identified (rewriteDataSet()). Reads it in a worker if there are any.
/// Returns an Error without the file's name and full stop if the file cannot be read or its class cannot be
/// cleaned.
Result<DeidentifiedFile> deidentifiedFile(const std::string& path, const Deidentification& how,
                                          const CancelToken& cancel);

/// Returns a single-frame image as deidentifiedFile() does, with `pixels` in place of its own. `pixels`
/// lack the face, so the image becomes DERIVED and uncompressed. It says Recognizable Visual Features NO and
/// has the code of that option. Also returns an Error if the file is not one 16-bit frame of this size.
Result<DeidentifiedFile> facelessFile(const std::string& path, const StoredSlice& pixels,
                                      const Deidentification& how, const CancelToken& cancel);

/// Returns true if the file at `path` holds exactly what writeDeidentified() would write.
bool isWrittenAt(const DeidentifiedFile& file, const std::string& source, const std::string& path);

/// Writes the de-identified copy of `source` to the new file `to`. Returns an Error if `to` exists or cannot
/// be written, or if `source` cannot be read.
Status writeDeidentified(const DeidentifiedFile& file, const std::string& source, const std::string& to);

}  // namespace volumen
