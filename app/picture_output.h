#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "io/files/picture_file.h"
#include "io/study/warning.h"

namespace volumen {

/// Adds -o; `help` says what the two formats hold.
void addPictureOutput(CLI::App& app, std::string& output, const std::string& help);
/// Adds --no-warning-line.
void addNoWarningLine(CLI::App& app, bool& noWarningLine);

/// Whether floats are written, .nrrd.
bool isFloatPicture(const std::string& path);
/// An Error (wrong usage) where a picture's name ends neither in .png nor in .nrrd.
Status checkPictureName(const std::string& path);

/// Writes a picture as PNG. The warnings that change what is seen stand in its text, and in its corner where
/// `warningLine`.
Status writePictureWithWarnings(QImage image, PictureText text, const std::vector<Warning>& warnings,
                                bool warningLine, const std::string& path);

}  // namespace volumen
