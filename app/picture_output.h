#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "io/files/picture_file.h"
#include "io/study/warning.h"

namespace volumen {

/// Adds -o; `help` describes the two formats.
void addPictureOutput(CLI::App& app, std::string& output, const std::string& help);
/// Adds --no-warning-line.
void addNoWarningLine(CLI::App& app, bool& noWarningLine);

/// True for float output (.nrrd).
bool isFloatPicture(const std::string& path);
/// The Error (wrong usage): the name ends neither in .png nor in .nrrd.
Status checkPictureName(const std::string& path);

/// Adds warnings that change what is visible to a picture's text, and to its corner if `warningLine`.
void addWarnings(QImage& image, PictureText& text, const std::vector<Warning>& warnings, bool warningLine);

/// Writes a picture with addWarnings() as PNG.
Status writePictureWithWarnings(QImage image, PictureText text, const std::vector<Warning>& warnings,
                                bool warningLine, const std::string& path);

}  // namespace volumen
