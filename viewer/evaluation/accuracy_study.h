#pragma once

#include "viewer/evaluation/setting.h"
#include "viewer/evaluation/truth.h"
#include "viewer/render/render.h"

namespace volumen {

/// What one setting came to.
struct StudyRow {
  Setting setting;
  std::string method;  ///< methodName
  double stepVoxels = 0;
  int bits = 0;  ///< stored precision
  glm::ivec2 size{0};
  double medianMs = 0, minimumMs = 0;  ///< of `frames` interleaved frames, of which none made caches
  int frames = 0;
  std::size_t bytes = 0;  ///< held for the picture: densities, gradients, blocks, tables
  std::int64_t resampled = 0, shaded = 0, composited = 0;
  PictureError error;  ///< over the truth's well-conditioned pixels (design.md 2)
  bool front = false;  ///< no other row is both faster and nearer to the truth (median ms, RMSE)
  Picture pixels;      ///< the truth's pixels as this setting draws them
};

struct AccuracyStudy {
  Truth truth;
  Plan plan;  ///< of the first row: scene and effects
  std::string kernel;
  int threads = 0;
  std::vector<StudyRow> rows;
  std::vector<std::string> leftOut;  ///< settings that cannot be drawn here, each with its reason
};

struct StudyOptions {
  int frames = 5;          ///< a row; a round draws every row once, so that noise hits all alike
  double mostMs = 3000;    ///< a row that has taken so long gets no more frames
  int mostPixels = 16384;  ///< of the reference
};

/// Measures every setting on one scene. The scene's picture is that of the first setting's size. An Error:
/// "cancelled", or that nothing could be drawn.
Result<AccuracyStudy> measure(const Scene& scene, const std::vector<Setting>& settings,
                              const StudyOptions& options, RenderCaches& caches,
                              const StudyProgress& progress = {}, const CancelToken& cancel = {});

/// Which points (cost, error) no other point beats: none is smaller in one and not larger in the other.
std::vector<bool> paretoFront(const std::vector<glm::dvec2>& points);

/// Who measured what, for the head of a report.
struct StudyTitle {
  std::string volume, scene, machine, date;
};

/// The name of this machine's processor, and how many threads may be used of it.
std::string machineName();

/// One line a row, quoted where needed, a head line first.
std::string studyCsv(const AccuracyStudy& study);
/// Title, reference and rows as one JSON object.
std::string studyJson(const AccuracyStudy& study, const StudyTitle& title);
/// "16384 of 262144 pixels, one of each cell of a 128 x 128 grid; 3 ill-conditioned ones left out".
std::string referenceText(const Truth& truth);

}  // namespace volumen
