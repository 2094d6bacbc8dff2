#include "ui/controller/segment_steps.h"

#include <cmath>

#include "ui/workspace/text.h"
#include "viewer/segment/holes.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/parts.h"
#include "viewer/segment/smoothing.h"

namespace volumen {

namespace {

using StepInputs = SegmentStepInput;

BitMask withoutIslands(const StepInputs& s) {
  constexpr double mm3PerMl = 1000;
  const double voxels = s.amount * mm3PerMl / s.own.geometry().voxelVolume();
  const Parts parts(s.own, Neighbours::faces, s.cancel);
  return parts.atLeast(std::int64_t(std::ceil(voxels - 1e-9)));  // rounding makes no voxel more
}

// Two segments share no voxel: what is near the other one is what they may have in common.
BitMask nearOther(const StepInputs& s) { return grown(s.other, s.amount, s.cancel); }

}  // namespace

const std::vector<SegmentStep>& segmentSteps() {
  using enum SegmentStep::Amount;
  static const std::vector<SegmentStep> table{
      {"keepLargest", tr("Keep largest"), tr("Keeps the largest connected part."),
       tr("Finding the largest part"), none, false,
       [](const StepInputs& s) { return Parts(s.own, Neighbours::faces, s.cancel).largest(); }},
      {"fillHoles", tr("Fill holes"), tr("Adds what it encloses."), tr("Filling holes"), none, false,
       [](const StepInputs& s) { return holesFilled(s.own, s.cancel); }},
      {"invert", tr("Invert"), tr("Takes all other voxels in place of its own, but none of locked segments."),
       tr("Inverting"), none, false, [](const StepInputs& s) { return inverted(s.own); }},
      {"removeIslands", tr("Remove islands"), tr("Takes away connected parts smaller than this."),
       tr("Removing islands"), ml, false, withoutIslands},
      {"grow", tr("Grow"), tr("Makes it larger on all sides by so many mm."), tr("Growing"), mm, false,
       [](const StepInputs& s) { return grown(s.own, s.amount, s.cancel); }},
      {"shrink", tr("Shrink"), tr("Makes it smaller on all sides by so many mm."), tr("Shrinking"), mm, false,
       [](const StepInputs& s) { return shrunk(s.own, s.amount, s.cancel); }},
      {"close", tr("Close"), tr("Closes gaps that a ball of this radius does not fit into."),
       tr("Closing gaps"), mm, false, [](const StepInputs& s) { return closed(s.own, s.amount, s.cancel); }},
      {"open", tr("Open"), tr("Takes away what a ball of this radius does not fit into."), tr("Opening"), mm,
       false, [](const StepInputs& s) { return opened(s.own, s.amount, s.cancel); }},
      {"smooth", tr("Smooth"), tr("Smooths its surface: a Gaussian of this standard deviation."),
       tr("Smoothing"), mm, false,
       [](const StepInputs& s) { return gaussianSmoothed(s.own, s.amount, s.cancel); }},
      {"unite", tr("Unite"), tr("Takes all voxels of the other segment, which is empty then."), tr("Uniting"),
       none, true, [](const StepInputs& s) { return united(s.own, s.other); }},
      {"subtract", tr("Subtract"), tr("Takes away what lies within so many mm of the other segment."),
       tr("Subtracting"), mm, true, [](const StepInputs& s) { return subtracted(s.own, nearOther(s)); }},
      {"intersect", tr("Intersect"), tr("Keeps what lies within so many mm of the other segment."),
       tr("Intersecting"), mm, true, [](const StepInputs& s) { return intersected(s.own, nearOther(s)); }},
  };
  return table;
}

}  // namespace volumen
