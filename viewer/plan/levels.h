#pragma once

#include <string>

namespace volumen {

/// Levels of quality, each an error promise against the reference (design.md 2).
enum class Quality { draft, standard, high, exact };

/// What a level keeps on any scene: against the reference, of well-conditioned pixels. Errors in 1/255.
struct LevelPromise {
  double leastPsnrDb = 0, most99 = 255, mostMaximum = 255;
};

/// What is promised of a draft: beside `standard`, of means over square blocks of pixels and of the whole
/// picture. Errors in 1/255.
struct DraftPromise {
  int blockEdge = 16;
  double mostRmse = 3, mostMeanColour = 1;
};
inline constexpr DraftPromise draftPromise;

/// A row of the table of levels. The one in resources/docs/design.md shows the same; a test compares them.
struct QualityLevel {
  const char* name;
  LevelPromise promise;
  /// What a ray that goes cell by cell may be off by, 1/255. Of standard and high what they promise of 99
  /// pixels of a hundred, of exact half of what it promises of all.
  double rayBudget;
  double stepVoxels;  ///< plain steps where curve and values are smooth and no ray goes cell by cell
  double timeGoal;    ///< times plain steps of one voxel, median over scenes; 0: the frame time asked for
  double mostTime;    ///< likewise, on any scene; 0: no goal
};
inline constexpr QualityLevel qualityLevels[] = {{"draft", {}, 32, 1.0 / 2, 0, 0},
                                                 {"standard", {42, 8, 255}, 8, 1.0 / 4, 1.5, 2},
                                                 {"high", {52, 2.5, 255}, 2.5, 1.0 / 8, 2.2, 0},
                                                 {"exact", {0, 255, 1}, 0.5, 1.0 / 32, 4, 0}};

constexpr const QualityLevel& levelOf(Quality quality) { return qualityLevels[int(quality)]; }
constexpr const LevelPromise& promiseOf(Quality quality) { return levelOf(quality).promise; }
/// "draft", "standard", "high", "exact".
constexpr const char* qualityName(Quality quality) { return levelOf(quality).name; }

/// "PSNR >= 42 dB, 99th percentile <= 8/255".
std::string promiseText(Quality quality);

}  // namespace volumen
