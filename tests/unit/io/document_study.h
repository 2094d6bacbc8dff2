#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <string>
#include <vector>

#include "io/export/document_dicom.h"
#include "io/report.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_frames.h"
#include "tests/unit/io/dicom_objects.h"

namespace volumen::tests {

/// A study of three slices, a picture of `frames` frames and a segmentation, in series 3, 7 and 12.
class DocumentStudy {
 public:
  static constexpr int frames = 5;

  /// `edit` adds attributes to all pictures.
  explicit DocumentStudy(const std::function<void(DcmDataset&)>& edit = {}) {
    for (int n = 0; n < 3; ++n) {
      DicomPicture slice = sliceAt(2 * n, n);
      slice.edit = [&](DcmDataset& data) { name(data, slices_, "3", edit); };
      folder_.add(numbered("slice", n), slice);
    }
    DicomPicture clip{.seriesUid = "1.2.3.7"};
    clip.edit = [&](DcmDataset& data) {
      makeFrames(data, frames);
      data.putAndInsertString(DCM_SOPClassUID, UID_MultiframeGrayscaleWordSecondaryCaptureImageStorage);
      data.putAndInsertString(DCM_Modality, "OT");
      data.findAndDeleteElement(DCM_ImagePositionPatient);
      name(data, clip_, "7", edit);
    };
    folder_.add("clip", clip);
    writeObject(folder_.path("seg"), segmentationClass, [&](DcmItem& data) {
      put(data, 0x0020, 0x000d, "1.2.3.4");
      put(data, 0x0020, 0x000e, "1.2.3.12");
      put(data, 0x0020, 0x0011, "12");
      OFString uid;
      data.findAndGetOFString(DCM_SOPInstanceUID, uid);
      segmentation_ = uid.c_str();
    });
  }

  std::string path(const std::string& name) const { return folder_.path(name); }
  const std::vector<std::string>& slices() const { return slices_; }
  const std::string& clip() const { return clip_.front(); }
  const std::string& segmentation() const { return segmentation_; }
  std::vector<std::string> all() const {
    std::vector<std::string> uids = slices_;
    uids.push_back(clip());
    uids.push_back(segmentation_);
    return uids;
  }
  Result<DocumentSource> source() const { return readDocumentSource(folder_.open(), all()); }

 private:
  static void name(DcmDataset& data, std::vector<std::string>& uids, const char* seriesNumber,
                   const std::function<void(DcmDataset&)>& edit) {
    OFString uid;
    data.findAndGetOFString(DCM_SOPInstanceUID, uid);
    uids.emplace_back(uid.c_str());
    data.putAndInsertString(DCM_SeriesNumber, seriesNumber);
    data.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.3.4.99");
    data.putAndInsertString(DCM_PatientID, "P1");
    if (edit) edit(data);
  }

  DicomFolder folder_;
  std::vector<std::string> slices_, clip_;
  std::string segmentation_;
};

/// Returns a report that can be written: a length on a slice.
inline Report oneLength(const DocumentStudy& study, double value = 12.5) {
  ReportShape line{ReportShape::Type::polyline, false, {{1, 2, 0}, {3, 4, 0}}, {}, {}, {}};
  line.pictures.push_back({study.slices()[1], {}, {}, {}});
  MeasurementGroup group;
  group.trackingId = "Cornerstone3DTools@^0.1.0:Length";
  group.trackingUid = "2.25.1";
  group.measurements.push_back(
      {{"410668003", "SCT", "Length"}, {"mm", "UCUM", "millimeter"}, value, {}, {line}});
  return {{"126000", "DCM", "Imaging Measurement Report"}, {group}, {}};
}

}  // namespace volumen::tests
