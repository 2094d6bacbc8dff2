#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/plan/facts.h"
#include "viewer/plan/kernel_key.h"
#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// One line of --explain: an effect or choice, whether it is on, and why.
struct Effect {
  std::string name;  ///< For example "lighting", "gradients", "specular", "clip", "empty blocks"
  bool on = false;
  /// True for a sound rule (off gives the same bytes), else a choice within the level's promise (design.md
  /// 5).
  bool sound = false;
  std::string reason;  ///< One clause that a medical physicist would agree with
  bool operator==(const Effect&) const = default;
};

/// Plain step lengths that a pilot may choose from, voxels.
struct PilotSteps {
  double shortest = 0;     ///< Length below which steps take longer than the plan without plain steps
  double first = 0;        ///< First length to try
  double redoneAbove = 0;  ///< Plan::redoneAbove of a plan with such steps
  bool operator==(const PilotSteps&) const = default;
};

/// Result of a pilot: some hundred rays of a picture, or thousands, followed both by plain steps and cell by
/// cell, to judge those steps (completedPlan).
struct PilotFinding {
  double stepVoxels = 1;
  bool kept = false;        ///< True if the steps keep the level's promise and are used
  int rays = 0;             ///< Rays that show anything
  double psnrDb = 0;        ///< Lower bound over everything shown, as in PictureError; 0 for a draft
  double percentile99 = 0;  ///< Upper bound over everything shown
  double redoneAbove = 0;   ///< Plan::redoneAbove
  double redoneShare = 0;   ///< Fraction of the rays that show anything and are redone
  /// Predicted error of a pixel that is not redone, relative to leastChange plus the change from steps of
  /// twice the length (nested steps; 0 for others). Larger than that of any ray of the pilot, in the manner
  /// of split conformal prediction (Papadopoulos 2002).
  double errorScale = 0;
  static constexpr double leastChange = 0.5;  ///< 1/255
  /// Upper bounds of a draft, 1/255: RMSE of means over blocks of pixels, and mean difference.
  double blockRmse = 0, meanColour = 0;
  bool operator==(const PilotFinding&) const = default;
};

/// The plan of a picture, made before its first sample: a pure function of its inputs. The renderer follows
/// it and decides only what the plan leaves to a pilot.
struct Plan {
  Scene scene;            ///< Complete: camera, window and gradientFloor are set
  RenderOptions options;  ///< Options as requested

  TransferFunction curve;  ///< The drawn curve: the scene's, unless an option changes it
  Method method = Method::planes;
  Resampler resampler = Resampler::cpu;
  Shader shader = Shader::phong;  ///< Never automatic
  Blending blending = Blending::floats;
  int mapSize = 64;
  MapLookup mapLookup = MapLookup::bilinear;
  int bits = 16;            ///< Stored precision
  double stepVoxels = 1;    ///< Step length (picture.md 9)
  bool cellByCell = false;  ///< True if rays go from cell to cell of the grid, false for plain steps
  double errorBudget = 1;   ///< Cell by cell: error of a ray as a fraction of white (ErrorBudget)
  /// Plain steps: rays are redone cell by cell if every other step alone would change them by more than this
  /// fraction of white. 0: none are.
  double redoneAbove = 0;
  /// Choice left to a pilot (completedPlan): whether plain steps, and of what length, keep the level's
  /// promise and replace the integration.
  std::optional<PilotSteps> pilotSteps;
  std::optional<PilotFinding> pilot;  ///< Result of the pilot
  double stopTransmittance = 0;       ///< Transmittance at which a ray ends; 0 means never

  /// True if gradients are computed, stored and fetched; set by the rule of that name.
  bool gradients = false;
  GradientOperator gradientOperator = GradientOperator::sobel;
  bool lit = false;              ///< D and S of picture.md 5 are evaluated
  bool specular = false;         ///< The S part is evaluated
  bool colouredLight = false;    ///< D and S are computed for red, green and blue, else once for all three
  bool gradientOpacity = false;  ///< The factor over |g_p| is evaluated
  bool clip = false;             ///< Clip box and planes cut the rays
  bool segments = false;         ///< Surfaces of segments are drawn
  /// Blocks of opacity 0 are never touched. In projections, blocks that cannot change an extreme are skipped,
  /// except for single samples.
  bool skipBlocks = false;
  double visibleShare = 1;  ///< Fraction of blocks with any visible value
  bool skipCells = false;   ///< Plain steps: only cells that can show something are sampled

  Cut cut;  ///< Parts that were cut away from the drawn volume

  std::vector<Effect> effects;
  bool operator==(const Plan&) const = default;
};

/// Plans a picture; with the result of a pilot, finally. The scene must be valid (validateScene). The Error
/// names an option that the methods cannot do, for example a reflectance map with localViewer.
Result<Plan> makePlan(const Scene& scene, const VolumeFacts& facts, const RenderOptions& options,
                      const std::optional<PilotFinding>& pilot = {});

/// Returns whether the picture estimates the error of each of its pixels.
inline bool tellsError(const Plan& plan) {
  return plan.cellByCell || (plan.pilot && plan.pilot->kept && plan.options.quality != Quality::draft);
}

/// Returns the plan as --explain prints it, one effect per line: "on   gradients: the scene is lit".
std::string explain(const Plan& plan);
/// Returns the same as JSON, for --stats.
std::string explainJson(const Plan& plan);

}  // namespace volumen
