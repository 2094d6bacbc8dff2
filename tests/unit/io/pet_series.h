#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cmath>
#include <functional>

#include "tests/unit/io/dicom_folder.h"

namespace volumen::tests {

using Edit = std::function<void(DcmDataset&)>;

/// Makes a PET of 80 kg, 100 MBq at 10:00 and a half-life of 6000 s. The series at 11:40 is 6000 s later, so
/// that half of the dose is left.
inline void makePet(DcmDataset& data) {
  data.putAndInsertString(DCM_Modality, "PT");
  data.putAndInsertString(DCM_Units, "BQML");
  data.putAndInsertString(DCM_CorrectedImage, "NORM\\DECY\\ATTN");
  data.putAndInsertString(DCM_DecayCorrection, "START");
  data.putAndInsertString(DCM_PatientWeight, "80");
  data.putAndInsertString(DCM_SeriesDate, "20260228");
  data.putAndInsertString(DCM_SeriesTime, "114000");
  data.putAndInsertString(DCM_AcquisitionDate, "20260228");
  data.putAndInsertString(DCM_AcquisitionTime, "114000.0");
  DcmItem* dose = nullptr;
  data.findOrCreateSequenceItem(DCM_RadiopharmaceuticalInformationSequence, dose);
  dose->putAndInsertString(DCM_RadionuclideTotalDose, "100000000");
  dose->putAndInsertString(DCM_RadionuclideHalfLife, "6000");
  dose->putAndInsertString(DCM_RadiopharmaceuticalStartTime, "100000.000");
}

inline DcmItem& doseOf(DcmDataset& data) {
  DcmItem* dose = nullptr;
  data.findOrCreateSequenceItem(DCM_RadiopharmaceuticalInformationSequence, dose);
  return *dose;
}

/// Returns the volume of two slices of such a PET.
inline Series petWith(const Edit& edit) {
  const DicomFolder folder;
  for (int n = 0; n < 2; ++n) {
    DicomPicture slice = sliceAt(3 * n, 100);
    slice.edit = [&](DcmDataset& data) {
      makePet(data);
      edit(data);
    };
    folder.add(numbered("s", n), slice);
  }
  const Study study = folder.open();
  return study.volumes.size() == 1 ? study.volumes[0] : Series{};
}

inline bool isNear(double a, double b) { return std::abs(a / b - 1) < 1e-9; }

}  // namespace volumen::tests
