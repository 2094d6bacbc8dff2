#pragma once

#include <compare>
#include <optional>
#include <string>

namespace volumen {

/// Where a picture stands among those of its series: by its number, else by when it was taken.
struct PictureOrder {
  long instance = 0;  ///< grows with InstanceNumber and, within a file, from frame to frame
  std::string time;   ///< of day, as DICOM writes it: of the acquisition, else of the series
  auto operator<=>(const PictureOrder&) const = default;
};

/// Whose pictures these are and which series they belong to. Text is UTF-8, exactly as in the file; whoever
/// shows it escapes control characters.
struct SeriesIdentity {
  std::string patientName, patientId;
  std::string patientIdIssuer;   ///< whose number patientId is; empty: not given
  std::string patientBirthDate;  ///< as DICOM writes it, YYYYMMDD
  std::string patientSex;        ///< "F", "M", "O"
  std::string patientAge;        ///< at the study, as DICOM writes it: "045Y"
  std::string studyUid, studyDate, studyTime, studyId, accessionNumber, studyDescription;
  std::string seriesUid, seriesNumber, modality, description;
  std::string sopClassUid;  ///< of its pictures, of the first one where they differ; empty: not known
  std::string bodyPart, laterality;  ///< as in the file: "BREAST", "L"
  std::string viewPosition;          ///< of projections, as in the file: "MLO", "PA"; of a code its word.
                                     ///< Of a series whose pictures differ empty (Series::projections)
  std::string frameOfReferenceUid;   ///< positions of one frame of reference are comparable; empty: not given
  std::optional<std::string> lossyRatio;  ///< of pictures with losses by compression, as in the file: "20",
                                          ///< empty where it is not given; none: they have none
  bool operator==(const SeriesIdentity&) const = default;
};

}  // namespace volumen
