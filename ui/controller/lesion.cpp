#include "ui/controller/lesion.h"

#include <algorithm>
#include <array>
#include <utility>

#include "results/segments/segment_maps.h"
#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/controller/segment_target.h"
#include "ui/overlays/view_overlays.h"

namespace volumen {

namespace {

// Returns a free name: "Lesion 1", "Lesion 2".
std::string lesionName(std::vector<SegmentMap> maps, const SegmentMap& map) {
  maps.push_back(map);
  for (int n = 1;; ++n) {
    const std::string name = tr("Lesion %1").arg(n).toStdString();
    if (freeName(maps, name) == name) return name;
  }
}

// Adds the segment `lesion`, made by the step `found` in the sphere of the step `ball`. `beside` are other
// maps of the series, whose segments' names are taken.
Result<SegmentMap> withLesion(SegmentMap map, Segment lesion, const std::vector<SegmentMap>& beside,
                              const Step& ball, Step found, const Volume& volume, const Mask& mask,
                              const CancelToken& cancel) {
  const std::optional<int> number = freeNumber(map);
  if (!number) return Error{"There are 255 segments, and no more fit: remove one first."};
  lesion.number = *number;
  lesion.label = lesionName(beside, map);
  found.segment = stepNameOf(*number);
  StepsWanted steps = keptIn({{ball}, {*number}}, {ball.segment}, volume, mask, cancel);
  steps.steps.push_back(std::move(found));
  Result<SegmentMap> made =
      withStepsDone(withSegment(std::move(map), std::move(lesion)), steps, volume, cancel);
  if (made || cancel.cancelled()) return made;
  return Error{"No lesion in the sphere: " + withoutStepName(made.message())};
}

// Another series in this frame of reference, such as the CT under a PET, shows the same places.
bool isInFrameOf(const Session& session, const SeriesKey& shown, const Series& series) {
  const auto found = session.workspace().series.find(shown);
  return found != session.workspace().series.end() &&
         frameOfReference(*found->second.series) == frameOfReference(series);
}

QString whyNoLesion(const Session& session, const LesionThreshold& threshold, const LesionBall& ball) {
  if (ball.onFrame) return tr("A lesion cannot be found on frames: show the series as slices.");
  const QString why = whyNoSegments(session);
  if (!why.isEmpty()) return why;
  const Series& series = session.series()->series;
  if (!isInFrameOf(session, ball.series, series))
    return tr("The panel Segments is about another series: draw in a view of that one.");
  if (!session.series()->volume->geometry().calibrated)
    return tr("The file does not say how large its voxels are: a sphere of so many mm cannot be drawn.");
  if (threshold.isShare) return {};
  const ValueScale scale = valueScale(series, PetUnit::suvBodyWeight);
  if (scale.unit.starts_with("SUV")) return {};
  return scale.why.empty()
             ? tr("The series has no SUV: choose a share of the maximum.")
             : tr("The series has %1. Choose a share of the maximum.").arg(shownText(scale.why));
}

}  // namespace

std::span<const LesionThreshold> lesionThresholds() {
  static constexpr std::array<LesionThreshold, 4> all{
      {{0.41, true}, {0.5, true}, {2.5, false}, {4.0, false}}};
  return all;
}

QString thresholdText(const LesionThreshold& threshold) {
  return threshold.isShare ? tr("%1 % of the maximum").arg(100 * threshold.amount)
                           : tr("SUV %1").arg(threshold.amount, 0, 'f', 1);
}

Result<SegmentWork> lesionOf(const Session& session, const LesionThreshold& threshold,
                             const LesionBall& ball) {
  if (const QString why = whyNoLesion(session, threshold, ball); !why.isEmpty())
    return Error{why.toStdString()};
  const Series& series = session.series()->series;
  Segment lesion;
  lesion.description = tr("From %1 on, within %2 mm of %3")
                           .arg(thresholdText(threshold))
                           .arg(ball.radiusMm, 0, 'f', 1)
                           .arg(placeText(series, ball.pPatient))
                           .toStdString();
  constexpr double mostMm = 1000;  // limit of the step; larger than a patient
  const Step sphere{
      "ball", "Sphere", {{"at", std::vector{ball.pPatient}}, {"radiusMm", std::min(ball.radiusMm, mostMm)}}};
  const std::string by = threshold.isShare ? "share" : "value";
  const double factor = threshold.isShare ? 1 : valueScale(series, PetUnit::suvBodyWeight).factor;
  const Step found{"lesion", {}, {{"in", sphere.segment}, {"by", by}, {by, threshold.amount / factor}}};
  SegmentWork work = workShown(session, tr("Add lesion"), tr("Finding the lesion"));
  work.makeAll = [=, volume = work.volume, mask = session.maskOf(work.series),
                  beside = copiesOf(allSegmentsShown(session))](const SegmentMap& map,
                                                                const CancelToken& cancel) {
    return withLesion(map, lesion, beside, sphere, found, *volume, mask, cancel);
  };
  return work;
}

}  // namespace volumen
