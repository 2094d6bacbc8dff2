#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viewer/plan/plan.h"
#include "viewer/volume/picture.h"

namespace volumen {

/// How far a picture was found to be from the reference, at some of its pixels.
struct MeasuredError {
  PictureError error;
  std::size_t pixels = 0, ofPixels = 0;
};

/// What is known of a picture's error beside what its plan promises.
struct KnownError {
  std::optional<PictureError> estimated{};  ///< by the picture itself (estimateOf(plan, map))
  std::optional<MeasuredError> measured{};
};

/// What a picture is said to be off by, of what each pixel may be (estimateOf(map)): nowhere more than its
/// plan promises. Pixels add up the errors of all parts of their rays as if all were of one sign. Where rays
/// pass through many faint parts that is far more than they are off by.
std::optional<PictureError> estimateOf(const Plan& plan, const std::vector<float>& map255);

/// "at most 0.61/255, 99th percentile 0.2/255, PSNR at least 71 dB", and what that leaves out (notEstimated).
std::string estimateText(const Plan& plan, const PictureError& estimated);
/// What was chosen by hand that no picture's estimate holds, as it belongs to what is integrated; else empty.
std::string notEstimated(const Plan& plan);
/// Why a picture of this plan has no estimate: a sentence.
std::string whyNoEstimate(const Plan& plan);

/// "99 % of pixels within 1.23/255, largest 4.88/255, RMSE 0.697/255, measured at 972 of 750000 pixels".
std::string errorText(const MeasuredError& measured);

/// What a PNG says of itself (design.md 10): program, method, level or step, promised error, what is known
/// of exactly this picture's, scene; key and value.
std::vector<std::pair<std::string, std::string>> pictureText(const Plan& plan, const KnownError& known = {});

/// "planes", "blend", "preshaded", "gpu", "reference".
const char* methodName(Method method);

}  // namespace volumen
