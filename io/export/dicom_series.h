#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/export/dicom_source.h"
#include "io/study/identity.h"
#include "io/study/loaded.h"
#include "viewer/segment/code.h"
#include "viewer/volume/volume.h"

namespace volumen {

struct Series;

/// How the slices of a volume were made of those of its source.
struct Resampling {
  std::string words;                      ///< what was done, for DerivationDescription
  Code code;                              ///< the same as a code of CID 7203
  std::string imageType;                  ///< the same as a value of ImageType
  double thicknessMm = 0;                 ///< SliceThickness
  std::vector<std::vector<int>> sources;  ///< for each slice, the slices of the source that it shows
  std::string frameOfReferenceUid{};      ///< of their positions, if it is not that of the source
  /// For each slice a grid of that slice alone, if they are not parallel. The spacing of slices of the volume
  /// is then that along their curve.
  std::vector<VoxelGeometry> places{};
};

/// Attributes of a written series beside pixels and geometry: its identity and its source's attributes.
/// Text is UTF-8. An empty studyUid is made from the contents; seriesUid is that of the source.
struct DicomSeriesTags : SeriesIdentity {
  std::string bValue;                    ///< diffusion weight, s/mm^2; empty if unknown
  std::string patientPosition;           ///< "HFS" etc.; empty if unknown
  std::string kvp;                       ///< peak tube voltage; empty if unknown
  std::vector<std::string> windowNames;  ///< one for each of the volume's windows, or empty
  bool hasNoUnit = false;                ///< a CT that gives no rescale: its values are no HU
  bool synthetic = false;  ///< computed, not of a patient: marked in the attributes meant for it

  DicomSource source;                ///< attributes of the slices of a DICOM series; else empty
  std::vector<SliceOrigin> origins;  ///< slices of the source that each slice of the volume comes from
  /// In place of `origins`, if slices lie on other planes. The series is then a new one each time.
  std::optional<Resampling> resampling;
  /// The parts that were replaced by air, for DerivationDescription: "the table". Empty if there are none. A
  /// series with such parts gets new UIDs each time.
  std::string takenAway;
  bool isDefaced = false;  ///< `takenAway` is the face (defaced()): said in the attribute meant for it
};

/// What was taken away from a volume, in words.
struct TakenAway {
  std::string title;  ///< for SeriesDescription: "Without table"
  std::string parts;  ///< for DerivationDescription, "with air in place of ...": "the table"
};

/// Returns the tags of an opened series; the patient of a phantom is "Volumen^Sample".
DicomSeriesTags dicomTags(const Series& series);

/// Returns the tags of a loaded series. Reads the headers of DICOM files again for all attributes of patient,
/// study, equipment and acquisition. The Error names a file that has changed since.
Result<DicomSeriesTags> readDicomTags(const Series& series, const Loaded& loaded,
                                      const Progress& progress = {}, const CancelToken& cancel = {});

/// Returns the tags of a series from which parts were taken away, as a new series of its study.
DicomSeriesTags tagsWithout(const TakenAway& what, DicomSeriesTags all, int seriesNumber);
/// Returns the tags of a loaded series whose face was taken away, as a new series of its study.
DicomSeriesTags defacedTags(DicomSeriesTags ofSource, int seriesNumber);

/// Writes a volume as a DICOM series into `folder`, one uncompressed file (Explicit VR Little Endian) a
/// slice.
/// `folder` must be empty or not exist; the series appears whole or not at all. CT, MR and PET volumes become
/// CT, MR and PET Image Storage; others, and PET without units, become Secondary Capture.
/// Patient, study, equipment, frame of reference, acquisition and windows are kept from the source; each
/// slice names its source images. UIDs derive from the contents, except for resampled slices and those
/// of which parts were taken away: the same volume and tags give the same files. Values are exact; rescale
/// and geometry have the 16 characters of a decimal string. PET slices that cannot be exact are rounded to 16
/// bits, and so are resampled ones, by one rescale for all slices unless they are PET. Slices may be oblique
/// and sheared (gantry tilt). Returns notes for the user: how far values are rounded, what became a Secondary
/// Capture. The Error: rows and columns are not perpendicular, the volume is not calibrated, it holds doses,
/// or its real values are not exact in 16 bits.
Result<std::vector<std::string>> writeDicomSeries(const Volume& volume, const DicomSeriesTags& tags,
                                                  const std::string& folder, const Progress& progress = {},
                                                  const CancelToken& cancel = {});

}  // namespace volumen
