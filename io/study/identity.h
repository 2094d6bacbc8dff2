#pragma once

#include <compare>
#include <optional>
#include <string>

namespace volumen {

/// The place of a picture within its series: by instance number, then by acquisition time.
struct PictureOrder {
  long instance = 0;  ///< grows with InstanceNumber and, within a file, with the frame
  std::string time;   ///< time of day as DICOM writes it: of the acquisition, else of the series
  auto operator<=>(const PictureOrder&) const = default;
};

/// Identifies the patient, study and series of pictures. Text is UTF-8, exactly as in the file; code that
/// shows it must escape control characters.
struct SeriesIdentity {
  std::string patientName, patientId;
  std::string patientIdIssuer;   ///< assigner of `patientId`; empty if not given
  std::string patientBirthDate;  ///< date as DICOM writes it, YYYYMMDD
  std::string patientSex;        ///< "F", "M", "O"
  std::string patientAge;        ///< age at the study as DICOM writes it: "045Y"
  std::string studyUid, studyDate, studyTime, studyId, accessionNumber, studyDescription;
  std::string seriesUid, seriesNumber, modality, description;
  std::string sopClassUid;  ///< SOP class of the pictures, of the first one if they differ; empty if unknown
  std::string bodyPart, laterality;  ///< values of the file: "BREAST", "L"
  /// View of a projection, as in the file: "MLO", "PA", or the meaning of the view code. Empty if the
  /// pictures of a series differ (Series::projections).
  std::string viewPosition;
  std::string frameOfReferenceUid;  ///< positions with equal UIDs are comparable; empty if not given
  /// Lossy compression ratio as in the file: "20", or empty if not given. No value means lossless pictures.
  std::optional<std::string> lossyRatio;
  bool operator==(const SeriesIdentity&) const = default;
};

}  // namespace volumen
