#pragma once

#include <QString>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// What a step on a segment works on.
struct SegmentStepInput {
  const BitMask& own;    ///< the voxels of the segment
  const BitMask& other;  ///< of another one; empty where the step takes none
  double amount;         ///< mm or ml, as the step says
  const CancelToken& cancel;
};

/// A row a step that changes the voxels of a segment.
struct SegmentStep {
  enum class Amount { none, mm, ml };

  const char* name;
  QString text;   ///< of its button and of the step to undo
  QString says;   ///< what it does, a sentence
  QString doing;  ///< of the job
  Amount amount;
  bool takesOther;  ///< another segment
  BitMask (*run)(const SegmentStepInput&);
};

/// All of them, in the order of their buttons. Parts are connected by faces.
const std::vector<SegmentStep>& segmentSteps();

}  // namespace volumen
