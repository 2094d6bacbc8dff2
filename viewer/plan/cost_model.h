#pragma once

#include "viewer/plan/plan.h"

namespace volumen {

/// Predicted cost of a picture before it is drawn, from the plan and the volume's facts alone. Times are
/// nanoseconds on one core of the machine where the constants were measured (cost_model.cpp). Only ratios are
/// meaningful elsewhere, and only ratios are used, because choices must not depend on the machine.
struct PredictedCost {
  double samplingNs = 0;  ///< Finding samples, their densities and gradients
  double lightNs = 0;     ///< Lighting visible samples; the nodes of a reflectance map once
  double ns() const { return samplingNs + lightNs; }
};

/// Predicts the cost of a planes or blend plan; only later effect lines may be missing.
PredictedCost predictedCost(const Plan& plan, const VolumeFacts& facts);

/// Predicts the cost with another shader (map or phong) at the planned map size.
PredictedCost predictedCost(const Plan& plan, const VolumeFacts& facts, Shader shader);

/// Returns the predicted fraction of visible matter that is seen before rays become opaque, from
/// plan.visibleShare and plan.stopTransmittance. 1 if either is 0 or the block ranges are unknown.
double seenShare(const Plan& plan, const VolumeFacts& facts);

/// Returns the fraction of visible values in blocks that hold a visible value, estimated from each block's
/// minimum, middle and maximum. 1 if there is no such block.
double shareInVisibleBlocks(const TransferFunction& curve, const BlockRanges& blockRanges);

/// Returns the number of samples of all rays inside the clip box, visible or not: the visible box volume over
/// pixel area and step (picture.md 9).
double samplesInBox(const Plan& plan, const VoxelGeometry& geometry);

}  // namespace volumen
