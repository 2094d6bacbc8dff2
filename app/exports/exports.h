#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/overlay_options.h"
#include "app/plane_options.h"
#include "app/scene_to_draw.h"
#include "io/study/unread.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// What `volumen export --as` writes: PATH, the file or folder, and the values of the options of formats.
struct ExportJob {
  std::string path, output, series;
  std::string shapes, images, title, segments, pdf, window;
  PlaneOptions plane;
  std::optional<double> spacingMm{};  ///< from slice to slice
  std::string onto, ontoSeries;       ///< the other series, whose grid to resample on
  OverlayOptions overlay;
  RelationOptions relation;  ///< of the two series
  bool hasPlane = false;     ///< an option of the plane is given
  bool isOfFrames() const { return hasPlane && plane.plane == acquiredPlane; }
  SceneOptions scene;
  MethodOptions method;
  std::optional<int> turntable{};  ///< pictures of a full turn
  double frameMs = 100;
  std::optional<int> framesPerSecond{};  ///< of a film; by default that of the clip, or 10
  bool rle = false, timePoints = false, removeTable = false, deface = false;
  bool withoutSegments = false;  ///< what lies in the segments is taken away, not all else
  bool takesAway() const { return removeTable || !segments.empty(); }  ///< of a series
  bool isOnto() const { return !onto.empty() || !ontoSeries.empty(); }
};

/// The most pictures that a film shows in a second.
inline constexpr int mostPerSecond = 100;

/// What was written.
struct Exported {
  std::vector<std::string> notes{};  ///< sentences for the user
  std::vector<Unread> unread{};      ///< files that could not be read
  std::vector<std::string> files{};  ///< if empty, that of the job
};

/// Check the options of a job before anything is read. The Error (wrong usage) names the option.
Status checkReport(const ExportJob& job);
Status checkKeyObjects(const ExportJob& job);
Status checkDrawn(const ExportJob& job);
Status checkCapture(const ExportJob& job);
Status checkAnimatedPng(const ExportJob& job);
Status checkMp4(const ExportJob& job);
Status checkPresentation(const ExportJob& job);
Status checkSeries(const ExportJob& job);

/// Parses --window and --overlay-window. The Error (wrong usage) names the option.
Status checkWindows(const ExportJob& job);

/// Each writes what a job names in one format (exportFormats()). The Error is a sentence for the user.
Result<Exported> exportCapture(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportFilm(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportPdf(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportReport(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportKeyObjects(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportPresentation(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportStructureSet(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportSegmentation(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportSegmentSurfaces(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportSeries(const ExportJob& job, const CancelToken& cancel);

}  // namespace volumen
