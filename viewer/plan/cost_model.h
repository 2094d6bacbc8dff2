#pragma once

#include "viewer/plan/plan.h"

namespace volumen {

/// What a picture is predicted to cost before it is drawn, from the plan and facts of the volume alone: in
/// nanoseconds of one core of the machine its constants were measured on (cost_model.cpp). Elsewhere only
/// ratios mean anything, and only they are used: a choice must not depend on the machine.
struct PredictedCost {
  double samplingNs = 0;  ///< finding samples, their densities and gradients
  double lightNs = 0;     ///< lighting those that are seen; a reflectance map's nodes once
  double ns() const { return samplingNs + lightNs; }
};

/// Of a plan of planes or blend that is complete but for its later lines.
PredictedCost predictedCost(const Plan& plan, const VolumeFacts& facts);

/// The same with another shader (map or phong), with the map's size as planned.
PredictedCost predictedCost(const Plan& plan, const VolumeFacts& facts, Shader shader);

/// The share of what is visible that is seen before rays are opaque, predicted from plan.visibleShare and
/// plan.stopTransmittance; 1 where that is 0 or nothing is known of the blocks.
double seenShare(const Plan& plan, const VolumeFacts& facts);

/// Of the blocks that hold a visible value, the share of their values that are visible, estimated from their
/// least, middle and largest; 1 where there is no such block.
double shareInVisibleBlocks(const TransferFunction& curve, const BlockRanges& blockRanges);

/// Samples of all rays inside the clip box, visible or not: the box's volume over a pixel's area and the step
/// (picture.md 9), or what of it the picture shows.
double samplesInBox(const Plan& plan, const VoxelGeometry& geometry);

}  // namespace volumen
