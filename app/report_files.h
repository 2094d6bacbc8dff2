#pragma once

#include <QImage>
#include <string>

#include "viewer/evaluation/accuracy_study.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Whether a folder can be made, or written into where it is there; leaves nothing. The Error names it.
Status checkFolder(const std::string& folder);

/// A folder that a command writes its reports into; makes it. The Error names it.
Status makeFolder(const std::string& folder);

/// Write FOLDER/name whole or not at all, and say its path on stdout.
Status writeReport(const std::string& folder, const char* name, const std::string& text);
Status writeReport(const std::string& folder, const char* name, const QImage& picture);

/// Today, on this machine.
StudyTitle titleOf(const std::string& volume, const std::string& scene);

/// Makes fonts usable for drawing on pictures, without any display; for the whole run of the program.
void prepareFonts();

}  // namespace volumen
