#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <vector>

#include "app/exports/exports.h"

namespace volumen {

/// A format of `volumen export --as`.
struct ExportFormat {
  const char* name;                ///< "sr"
  const char* text;                ///< what it is: "measurements as a DICOM structured report"
  std::vector<const char*> needs;  ///< options that it cannot do without
  std::vector<const char*> takes;  ///< other options
  Result<Exported> (*write)(const ExportJob& job, const CancelToken& cancel);
  Status (*check)(const ExportJob& job) = nullptr;  ///< of the options before anything is read
  bool isDicom = true;                              ///< archives take it
  bool hasPages = false;  ///< which may name the patient: it is not written without identity
};

/// Returns all formats.
std::span<const ExportFormat> exportFormats();

/// Adds the options of all formats.
void addFormatOptions(CLI::App& app, ExportJob& job);

/// Checks that the options of formats in the command line fit a format; null stands for none. The Error
/// (wrong usage) names an option.
Status checkFormatOptions(const CLI::App& app, const ExportFormat* format);

/// Checks that options of another series fit each other. The Error (wrong usage) names an option.
Status checkOther(const CLI::App& app, const ExportJob& job);

/// Checks that no other option places the slices of a series that lie across the curve of --roi. The Error
/// (wrong usage) names an option.
Status checkCurve(const CLI::App& app, const ExportFormat& format);

/// Completes a job: whether it shows a plane, and that plane's size. The Error (wrong usage): an option of 3D
/// pictures is given beside a plane.
Status settlePlane(const CLI::App& app, const ExportFormat& format, ExportJob& job);

}  // namespace volumen
