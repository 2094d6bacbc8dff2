#pragma once

#include <QImage>
#include <string>

#include "viewer/evaluation/accuracy_study.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Checks that a folder can be created or written to; leaves nothing behind. The Error names it.
Status checkFolder(const std::string& folder);

/// Creates a folder for a command's reports. The Error names it.
Status makeFolder(const std::string& folder);

/// Write FOLDER/name whole or not at all, and print its path to stdout.
Status writeReport(const std::string& folder, const char* name, const std::string& text);
Status writeReport(const std::string& folder, const char* name, const QImage& picture);

/// Returns the title with today's date and this machine.
StudyTitle titleOf(const std::string& volume, const std::string& scene);

/// Makes fonts usable on pictures without a display, for the whole run of the program.
void prepareFonts();

}  // namespace volumen
