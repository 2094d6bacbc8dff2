#pragma once

#include <string>

namespace volumen {

/// Quality levels, each with an error promise against the reference (design.md 2).
enum class Quality { draft, standard, high, exact };

/// Error bounds that a level keeps on any scene, against the reference, over well-conditioned pixels. Errors
/// in 1/255.
struct LevelPromise {
  double leastPsnrDb = 0, most99 = 255, mostMaximum = 255;
};

/// Error bounds of a draft against `standard`: of means over square blocks of pixels, and of the mean of the
/// whole picture. Errors in 1/255.
struct DraftPromise {
  int blockEdge = 16;
  double mostRmse = 3, mostMeanColour = 1;
};
inline constexpr DraftPromise draftPromise;

/// A row of the table of levels. The table in resources/docs/design.md must match; a test compares them.
struct QualityLevel {
  const char* name;
  LevelPromise promise;
  /// Error budget of a ray that goes cell by cell, 1/255. Standard and high use their promise for 99 % of
  /// pixels, exact uses half of its promise for all.
  double rayBudget;
  /// Length of plain steps where curve and values are smooth and no ray goes cell by cell.
  double stepVoxels;
  /// Time relative to plain steps of one voxel, median over scenes; 0: the requested frame time.
  double timeGoal;
  double mostTime;  ///< The same on any scene; 0 means no goal
};
inline constexpr QualityLevel qualityLevels[] = {{"draft", {}, 32, 1.0 / 2, 0, 0},
                                                 {"standard", {42, 8, 255}, 8, 1.0 / 4, 1.5, 2},
                                                 {"high", {52, 2.5, 255}, 2.5, 1.0 / 8, 2.2, 0},
                                                 {"exact", {0, 255, 1}, 0.5, 1.0 / 32, 4, 0}};

constexpr const QualityLevel& levelOf(Quality quality) { return qualityLevels[int(quality)]; }
constexpr const LevelPromise& promiseOf(Quality quality) { return levelOf(quality).promise; }
/// Returns "draft", "standard", "high" or "exact".
constexpr const char* qualityName(Quality quality) { return levelOf(quality).name; }

/// Returns for example "PSNR >= 42 dB, 99th percentile <= 8/255".
std::string promiseText(Quality quality);

}  // namespace volumen
