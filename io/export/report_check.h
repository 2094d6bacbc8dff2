#pragma once

#include <functional>

#include "io/export/document_dicom.h"
#include "io/report.h"

namespace volumen {

/// Calls visit(code) with each code of a report, empty ones included.
void forEachCode(const Report& report, const std::function<void(const Code& code)>& visit);

/// Returns a sentence, with the number of the group, if a report cannot be written (writeReport()).
Status checkReport(const Report& report, const DocumentSource& source);

}  // namespace volumen
