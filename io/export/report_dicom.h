#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/export/document_dicom.h"
#include "io/report.h"

namespace volumen {

/// Returns the SOPInstanceUIDs that a report refers to, each once, in their order.
std::vector<std::string> instancesOf(const Report& report);

/// Writes a report as DICOM structured report of TID 1500 into `path`, in the study of its images
/// (writeDocument()): Comprehensive SR, or Comprehensive 3D SR if a shape is in patient space. loadReport()
/// reads an equal report, but points are float32, frames of single-frame images are not written, groups
/// without tracking UID get one, and a report without title becomes an Imaging Measurement Report.
/// Returns notes for the user: texts of codes that were shortened to 64 characters. The Error, besides those
/// of writeDocument(): there is no group, a number is not finite or has no unit, a code is incomplete, a
/// shape has the wrong number of points, no image or no frame of reference, or the source lacks an image.
Result<std::vector<std::string>> writeReport(const Report& report, const DocumentSource& source,
                                             const std::string& path);

}  // namespace volumen
