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

/// "99 % of pixels within 1.23/255, largest 4.88/255, RMSE 0.697/255, measured at 972 of 750000 pixels".
std::string errorText(const MeasuredError& measured);

/// What a PNG says of itself (DESIGN 10): program, method, level or step, promised error, the measured one
/// where it is known of exactly this picture, scene; key and value.
std::vector<std::pair<std::string, std::string>> pictureText(
    const Plan& plan, const std::optional<MeasuredError>& measured = {});

/// "draft", "standard", "high", "exact".
const char* qualityName(Quality quality);
/// "planes", "blend", "preshaded", "gpu", "reference".
const char* methodName(Method method);

}  // namespace volumen
