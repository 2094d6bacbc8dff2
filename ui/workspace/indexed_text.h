#pragma once

#include <QStringList>

#include "io/index/index.h"

namespace volumen {

/// Returns the name of a patient, "Doe, Jane", followed by its form in a second script; "(no name)" or "(name
/// hidden)".
QString patientNameText(const std::string& name);

/// Returns an ID, or "(ID hidden)" while names are hidden.
QString idText(const std::string& id);

/// Returns an institution, or "(institution hidden)" while names are hidden.
QString institutionText(const std::string& institution);

/// Returns "Series 3", or "Series" without a number.
QString seriesNameText(const IndexedSeries& series);

/// Returns description and distinguishing label: "Chest 1.0 mm, 4 echoes".
QString contentText(const IndexedSeries& series);

/// Returns a number, or an empty text for -1: unknown.
QString countText(int count);

/// Returns "120 images" or "1 image, 96 frames"; empty if the number is unknown.
QString imagesText(const IndexedSeries& series);

/// Returns all known facts, one per line. Warnings and the reason why it cannot be opened come last.
QStringList everythingOf(const IndexedSeries& series);
QStringList everythingOf(const IndexedStudy& study);

/// Returns "! 3 warnings: hover over the series to read them", or an empty text for none.
QString warningsText(int warnings);

/// Returns the result of an import as a sentence: "312 images imported; 20 were in the list already."
QString importText(const ImportReport& report);

}  // namespace volumen
