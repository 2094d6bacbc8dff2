#pragma once

#include <QStringList>

#include "io/report.h"
#include "io/study/derived_object.h"

namespace volumen {

/// Returns kind and label of an object: "Key objects: Of Interest".
QString derivedName(const DerivedObject& object);

/// Returns two sentences for an object whose pictures are not open: what it is and what to do.
QString aloneText(const DerivedObject& object);

/// Returns its name, then its date and how many pictures are missing: "2 of 179 pictures are not here".
QStringList referenceLines(const DerivedObject& object, std::size_t notHere);

/// Returns a report as rich text: findings, measurements and links "picture:N" to pictures. N is an index
/// into reportPictures(); `isHere` says for each of them whether it is open.
QString reportHtml(const DerivedObject& object, const Report& report, const std::vector<bool>& isHere);

/// Returns all pictures that a report's measurements refer to, each once, in report order.
std::vector<ReferencedPicture> reportPictures(const Report& report);

}  // namespace volumen
