#pragma once

#include <QStringList>

#include "io/index/index.h"

namespace volumen {

/// "Doe, Jane" of a DICOM name; "(no name)", "(name hidden)". What it says in a second script stands behind
/// it.
QString patientNameText(const std::string& name);

/// An ID as a person may read it; "(ID hidden)".
QString idText(const std::string& id);

/// Where a study was made; "(institution hidden)".
QString institutionText(const std::string& institution);

/// "Series 3"; "Series" where it has no number.
QString seriesNameText(const IndexedSeries& series);

/// "Chest 1.0 mm, 4 echoes": description and what tells it from others.
QString contentText(const IndexedSeries& series);

/// "120 images", "1 image, 96 frames".
QString imagesText(const IndexedSeries& series);

/// All that is known, one thing a line, warnings and why it cannot be opened last.
QStringList everythingOf(const IndexedSeries& series);
QStringList everythingOf(const IndexedStudy& study);

/// "! 3 warnings: hover over the series to read them"; empty where there are none.
QString warningsText(int warnings);

/// How an import went, in a sentence: "312 images imported; 20 were in the list already."
QString importText(const ImportReport& report);

}  // namespace volumen
