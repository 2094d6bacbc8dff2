#pragma once

#include <span>
#include <string>

#include "io/export/document_dicom.h"
#include "io/report.h"

namespace volumen {

/// Returns the titles of key object documents that can be chosen (PS3.16 CID 7010), "Of Interest" first.
std::span<const Code> keyObjectTitles();
/// Returns the title with this code value; "Of Interest" for an empty one. The Error: it rejects images, or
/// is none of keyObjectTitles().
Result<Code> keyObjectTitle(const std::string& value);

/// Writes a Key Object Selection (PS3.3 A.35.4, TID 2010) into `path`, in the study of its images
/// (writeDocument()). loadKeyObjects() reads equal ones, but frames of single-frame images are not written
/// and an empty title becomes "Of Interest". The Error, besides those of writeDocument(): there is no image,
/// the source lacks one, or the title rejects images, which archives would then hide.
Status writeKeyObjects(const KeyObjects& keys, const DocumentSource& source, const std::string& path);

}  // namespace volumen
