#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viewer/plan/plan.h"
#include "viewer/volume/picture.h"

namespace volumen {

/// Error of a picture against the reference, measured at some of its pixels.
struct MeasuredError {
  PictureError error;
  std::size_t pixels = 0, ofPixels = 0;
};

/// Known errors of a picture, beside the promise of its plan.
struct KnownError {
  std::optional<PictureError> estimated{};  ///< estimate by the picture itself (estimateOf())
  std::optional<MeasuredError> measured{};
};

/// Returns the stated error of a picture from the bound of each pixel, never more than its plan promises. A
/// pixel adds up the errors of all parts of its ray as if all had one sign. On rays through many faint parts
/// that is far more than the true error.
std::optional<PictureError> estimateOf(const Plan& plan, const std::vector<float>& map255);

/// Returns for example "at most 0.61/255, 99th percentile 0.2/255, PSNR at least 71 dB", and what that leaves
/// out (notEstimated).
std::string estimateText(const Plan& plan, const PictureError& estimated);
/// Returns the manual choices that no error estimate covers, because they change the integrand. May be empty.
std::string notEstimated(const Plan& plan);
/// Returns a sentence on why a picture of this plan has no estimate.
std::string whyNoEstimate(const Plan& plan);

/// Returns for example "99 % of pixels within 1.23/255, largest 4.88/255, RMSE 0.697/255, measured at 972 of
/// 750000 pixels".
std::string errorText(const MeasuredError& measured);

/// Returns the text entries of a PNG as key and value (design.md 10): program, method, level or step,
/// promised error, known errors of this picture, scene.
std::vector<std::pair<std::string, std::string>> pictureText(const Plan& plan, const KnownError& known = {});

/// Returns "planes", "blend", "preshaded", "gpu" or "reference".
const char* methodName(Method method);

}  // namespace volumen
