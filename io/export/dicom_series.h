#pragma once

#include <string>
#include <vector>

#include "io/study.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// What a written series says of itself beside its pixels and geometry. Text is UTF-8.
struct DicomSeriesTags {
  std::string patientName, patientId;
  std::string studyUid;  ///< empty: made from the contents
  std::string studyDate, studyDescription, seriesDescription;
  std::string bodyPart;                  ///< BodyPartExamined, in DICOM's capitals
  std::string patientPosition;           ///< "HFS" etc., empty where unknown
  std::string kvp;                       ///< peak voltage of the tube, empty where unknown
  std::vector<std::string> windowNames;  ///< one for each of the volume's windows, or none
  bool synthetic = false;                ///< computed, of no patient: says so in the tags meant for it
};

/// The tags that a series which was opened has to say; a phantom is patient "Volumen^Sample".
DicomSeriesTags dicomTags(const Series& series);

/// Whether a series can be written into this folder: it is empty, or missing where one can be made; leaves
/// nothing. The Error names it.
Status checkDicomFolder(const std::string& folder);

/// Writes a volume as a DICOM series, one uncompressed file (Explicit VR Little Endian) a slice, into
/// `folder`, which must not exist or be empty; it appears whole or not at all. CT and MR volumes become CT
/// and MR Image Storage, others Secondary Capture. UIDs follow from the contents: the same volume and tags
/// give the same files. Stored integers are exact; rescale and geometry have the 16 characters of a decimal
/// string. Slices may be oblique and shifted against each other (gantry tilt). Refused with a sentence: rows
/// and columns that are not perpendicular, a volume that is not calibrated, real values that are not whole
/// numbers within 16 bits.
Status writeDicomSeries(const Volume& volume, const DicomSeriesTags& tags, const std::string& folder,
                        const Progress& progress = {}, const CancelToken& cancel = {});

}  // namespace volumen
