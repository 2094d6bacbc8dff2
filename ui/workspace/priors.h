#pragma once

#include <QString>
#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen {

/// What is open of one patient, from one study's point of view.
struct PatientStudies {
  std::vector<const Series*> current;              ///< of that study
  std::vector<std::vector<const Series*>> priors;  ///< of earlier days, a study each, the latest first
};

/// `open`: all pictures that are open; the pointers are kept.
PatientStudies studiesAround(const std::vector<const Series*>& open, const Series& current);

/// How much two series are pictures of the same thing: 100 of plane (or side and view of projections) 30,
/// weighting or kernel 25, words of the description 20, contrast agent 15, thickness 10; 0 where modality or
/// body part differ, or one of them alone is a volume.
double likeness(const Series& a, const Series& b);
/// What likeness() calls the same.
inline constexpr double leastLikeness = 50;

/// The one of some most like a series, of those alike the one with the lowest number; null: none is like it.
const Series* mostLike(const Series& series, const std::vector<const Series*>& among);

/// The same series of the latest study before that holds one; null: none is open.
const Series* priorOf(const Series& series, const std::vector<const Series*>& open);

/// What is most likely wanted beside a series: of its study and plane another weighting or kernel, in the
/// same frame of reference; else its prior; null: nothing.
const Series* likelySecond(const Workspace& workspace, const Series& series,
                           const std::vector<const Series*>& open);

/// With likelySecond() in the first empty view to compare, beside what the first one shows.
Workspace withLikelySecond(Workspace workspace, const std::vector<const Series*>& open);

/// Side by side, the current one left and in focus, as they are read: frames, or slices as acquired that
/// scroll together.
Workspace comparedWithPrior(Workspace workspace, const Series& current, const Series& prior);

/// The date of the study in a view, where views on screen show studies of several days; else empty.
QString dateToTellApart(const Workspace& workspace, ViewId view);

}  // namespace volumen
