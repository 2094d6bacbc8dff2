#pragma once

#include <QStringList>

#include "io/report.h"
#include "io/study/derived_object.h"

namespace volumen {

/// "Key objects: Of Interest": what it is and what it is called.
QString derivedName(const DerivedObject& object);

/// What it is and what to do where none of its pictures is open: two sentences.
QString aloneText(const DerivedObject& object);

/// Its name; its date and how many of its pictures are not here, "2 of 179 pictures are not here".
QStringList referenceLines(const DerivedObject& object, std::size_t notHere);

/// A report as rich text: findings and measurements, pictures as links "picture:N" where N counts the
/// pictures that reportPictures() lists. `isHere`: of each of those.
QString reportHtml(const DerivedObject& object, const Report& report, const std::vector<bool>& isHere);

/// All pictures that a report's measurements are of, each once, in the report's order.
std::vector<ReferencedPicture> reportPictures(const Report& report);

}  // namespace volumen
