#pragma once

#include "viewer/evaluation/setting.h"
#include "viewer/evaluation/truth.h"
#include "viewer/render/render.h"

namespace volumen {

/// Results of one setting.
struct StudyRow {
  Setting setting;
  std::string method;  ///< Result of methodName().
  double stepVoxels = 0;
  int bits = 0;  ///< Stored precision.
  glm::ivec2 size{0};
  /// Over `frames` interleaved frames, none of which had to fill caches.
  double medianMs = 0, minimumMs = 0;
  int frames = 0;
  std::size_t bytes = 0;  ///< Memory held for the picture: densities, gradients, blocks, tables.
  std::int64_t resampled = 0, shaded = 0, composited = 0;
  PictureError error;  ///< Over the truth's well-conditioned pixels (design.md 2).
  bool front = false;  ///< True if no other row is both faster and more accurate (median ms, RMSE).
  Picture pixels;      ///< The truth's pixels as this setting draws them.
};

struct AccuracyStudy {
  Truth truth;
  Plan plan;  ///< Plan of the first row: scene and effects.
  std::string kernel;
  int threads = 0;
  std::vector<StudyRow> rows;
  std::vector<std::string> leftOut;  ///< Settings that cannot be drawn here, each with its reason.
};

struct StudyOptions {
  int frames = 5;          ///< Frames per row. A round draws every row once, so that noise affects all alike.
  double mostMs = 3000;    ///< Rows that have taken longer get no more frames.
  int mostPixels = 16384;  ///< Largest number of reference pixels.
};

/// Measures every setting on one scene. The first setting's size is that of the scene's picture. Returns an
/// Error "cancelled", or one saying that nothing could be drawn.
Result<AccuracyStudy> measure(const Scene& scene, const std::vector<Setting>& settings,
                              const StudyOptions& options, RenderCaches& caches,
                              const StudyProgress& progress = {}, const CancelToken& cancel = {});

/// Returns the points (cost, error) that no other point dominates: no other is at most as large in both and
/// smaller in one.
std::vector<bool> paretoFront(const std::vector<glm::dvec2>& points);

/// Subject, machine and date of a study, for the head of a report.
struct StudyTitle {
  std::string volume, scene, machine, date;
};

/// Returns the name of this machine's processor and the number of threads that may be used.
std::string machineName();

/// Returns one line per row, quoted where needed, after a header line.
std::string studyCsv(const AccuracyStudy& study);
/// Returns title, reference and rows as one JSON object.
std::string studyJson(const AccuracyStudy& study, const StudyTitle& title);
/// Returns e.g. "16384 of 262144 pixels, one of each cell of a 128 x 128 grid; 3 ill-conditioned ones left
/// out".
std::string referenceText(const Truth& truth);

}  // namespace volumen
