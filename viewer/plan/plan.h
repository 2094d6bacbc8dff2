#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/plan/facts.h"
#include "viewer/plan/kernel_key.h"
#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// One line of --explain: an effect or a choice, whether it is on, and why.
struct Effect {
  std::string name;  ///< "lighting", "gradients", "specular", "clip", "empty blocks", ...
  bool on = false;
  bool sound =
      false;  ///< a sound rule (off: same bytes); else a choice within the level's promise (design.md 5)
  std::string reason;  ///< one clause a radiologist's physicist would agree with
  bool operator==(const Effect&) const = default;
};

/// Plain steps that a pilot may find, voxels.
struct PilotSteps {
  double shortest = 0;  ///< shorter ones take longer than what is planned without them
  double first = 0;     ///< that it tries first
  bool operator==(const PilotSteps&) const = default;
};

/// What some thousand rays of a picture, followed by plain steps and cell by cell, tell of those steps
/// (completedPlan).
struct PilotFinding {
  double stepVoxels = 1;
  bool kept = false;        ///< they keep the level's promise, and are taken
  int rays = 0;             ///< that show anything
  double psnrDb = 0;        ///< of all that shows anything, at least, as PictureError
  double percentile99 = 0;  ///< likewise, at most
  bool operator==(const PilotFinding&) const = default;
};

/// What is computed for a picture, decided before the first sample: a pure function of its inputs.
/// The renderer does what it says and decides nothing itself but, where the plan leaves it open, what a pilot
/// finds.
struct Plan {
  Scene scene;            ///< complete: camera, window and gradientFloor are set
  RenderOptions options;  ///< as asked

  TransferFunction curve;  ///< that is drawn: the scene's, but where a choice of the options changes it
  Method method = Method::planes;
  Resampler resampler = Resampler::cpu;
  Shader shader = Shader::phong;  ///< never automatic
  Blending blending = Blending::floats;
  int mapSize = 64;
  MapLookup mapLookup = MapLookup::bilinear;
  int bits = 16;            ///< stored precision
  double stepVoxels = 1;    ///< picture.md 9
  bool cellByCell = false;  ///< rays go from cell to cell of the grid, else by plain steps
  double errorBudget = 1;   ///< cell by cell: what a ray may be off by, as a share of white (ErrorBudget)
  /// What is left open for a pilot to find (completedPlan): whether plain steps, and how long ones, keep the
  /// level's promise and take the place of the integration.
  std::optional<PilotSteps> pilotSteps;
  std::optional<PilotFinding> pilot;  ///< what it found
  double stopTransmittance = 0;       ///< a ray ends where its transmittance falls below; 0: never

  bool gradients = false;  ///< gradients are computed, stored and fetched: the rule of that name decides
  GradientOperator gradientOperator = GradientOperator::sobel;
  bool lit = false;              ///< D and S of picture.md 5 are evaluated
  bool specular = false;         ///< the S part is evaluated
  bool colouredLight = false;    ///< D and S for red, green and blue; else once for all three
  bool gradientOpacity = false;  ///< the factor over |g_p| is evaluated
  bool clip = false;             ///< clip box and planes cut the rays
  bool segments = false;         ///< surfaces of segments are drawn
  bool skipBlocks = false;       ///< blocks of opacity 0 are never touched; what cannot change an extreme is
                                 ///< passed over but for single samples
  double visibleShare = 1;       ///< share of blocks that hold any visible value
  bool skipCells = false;        ///< plain steps: samples are taken only in cells that can show something

  Cut cut;  ///< what was taken away from the volume that is drawn

  std::vector<Effect> effects;
  bool operator==(const Plan&) const = default;
};

/// Decides a picture; with what a pilot found, for good. The scene must be valid (validateScene). Refused,
/// with a sentence that names the option: what the methods cannot do (e.g. a reflectance map with
/// localViewer).
Result<Plan> makePlan(const Scene& scene, const VolumeFacts& facts, const RenderOptions& options,
                      const std::optional<PilotFinding>& pilot = {});

/// The plan as --explain prints it, one effect a line: "on   gradients: the scene is lit".
std::string explain(const Plan& plan);
/// The same as JSON, for --stats.
std::string explainJson(const Plan& plan);

}  // namespace volumen
