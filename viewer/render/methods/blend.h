#pragma once

#include "viewer/render/render.h"

namespace volumen {

/// Algorithm 2 of the paper (3.2): slice by slice from the back to the front, each resampled, shaded where it
/// has opacity and blended into a frame buffer, which may be as coarse as one of 1998. No early termination.
/// Slice n holds the n-th sample (SCENE 9) of every ray, so that slices are parallel to the face where the
/// rays enter and the picture of a frame buffer of floats is that of the midpoint rule, in perspective too.
Result<Rendered> renderBlend(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

}  // namespace volumen
