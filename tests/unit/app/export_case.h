#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <string>

#include "tests/fixtures/dciodvfy.h"

namespace volumen::tests {

/// An ultrasound clip of 34 frames in colour, and its SOPInstanceUID.
inline constexpr const char* clip = "dicom-2d/us-cine-aspect-regions.dcm";
inline constexpr const char* clipUid = "1.2.840.113857.1626.160635.1727.151815.1.1";

/// Returns the values of an element, at the first place that has it; empty if there is none.
inline std::string textIn(DcmItem& data, const DcmTagKey& tag) {
  OFString text;
  data.findAndGetOFStringArray(tag, text, OFTrue);
  return text.c_str();
}

/// Returns the errors that dciodvfy finds in a file but not in `source`, which its patient and study come
/// from.
inline QStringList newErrors(const QString& file, const std::string& source) {
  const QStringList known = dciodvfyErrors(QString::fromStdString(source));
  QStringList errors = dciodvfyErrors(file);
  erase_if(errors, [&](const QString& error) { return known.contains(error); });
  return errors;
}

}  // namespace volumen::tests
