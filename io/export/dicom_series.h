#pragma once

#include <string>
#include <vector>

#include "io/export/dicom_source.h"
#include "io/study/identity.h"
#include "io/study/loaded.h"
#include "viewer/volume/volume.h"

namespace volumen {

struct Series;

/// What a written series says of itself beside its pixels and geometry: whose it is, and what its source
/// says. Text is UTF-8. An empty studyUid is made from the contents; seriesUid is that of the source.
struct DicomSeriesTags : SeriesIdentity {
  std::string bValue;                    ///< diffusion weight, s/mm^2; empty where it is not known
  std::string patientPosition;           ///< "HFS" etc., empty where unknown
  std::string kvp;                       ///< peak voltage of the tube, empty where unknown
  std::vector<std::string> windowNames;  ///< one for each of the volume's windows, or none
  bool synthetic = false;                ///< computed, of no patient: says so in the tags meant for it

  DicomSource source;                ///< of DICOM series: what its slices say; else empty
  std::vector<SliceOrigin> origins;  ///< which of them each slice of the volume is
};

/// The tags that a series which was opened has to say; a phantom is patient "Volumen^Sample".
DicomSeriesTags dicomTags(const Series& series);

/// The same of a series that was loaded, of a DICOM series with all that its files say of patient, study,
/// equipment and acquisition: reads their headers again. An Error names a file that is not what it was.
Result<DicomSeriesTags> readDicomTags(const Series& series, const Loaded& loaded,
                                      const Progress& progress = {}, const CancelToken& cancel = {});

/// Whether a series can be written into this folder: it is empty, or missing where one can be made; leaves
/// nothing. The Error names it.
Status checkDicomFolder(const std::string& folder);

/// Writes a volume as a DICOM series, one uncompressed file (Explicit VR Little Endian) a slice, into
/// `folder`, which must not exist or be empty; it appears whole or not at all. CT, MR and PET volumes become
/// CT, MR and PET Image Storage, others Secondary Capture (PET without units, too). What the source says of
/// patient, study, equipment, frame of reference, acquisition and windows stays as it is; each slice names
/// its source images. UIDs follow from the contents: the same volume and tags give the same files. Values are
/// exact, rescale and geometry have the 16 characters of a decimal string; of PET, slices that cannot be
/// exact are rounded to 16 bits. Slices may be oblique and shifted against each other (gantry tilt). Gives
/// sentences that are to be known (how far values are rounded, what became a Secondary Capture). Refused with
/// a sentence: rows and columns that are not perpendicular, a volume that is not calibrated, doses, real
/// values that are not exact in 16 bits.
Result<std::vector<std::string>> writeDicomSeries(const Volume& volume, const DicomSeriesTags& tags,
                                                  const std::string& folder, const Progress& progress = {},
                                                  const CancelToken& cancel = {});

}  // namespace volumen
