#include "ui/derivations/segment_numbers.h"

#include "results/text/text.h"
#include "ui/controller/segment_painter.h"
#include "ui/controller/segment_target.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

namespace {

std::vector<SegmentNumbersKey> wantedOf(const Session& session) {
  if (!segmentShown(session)) return {};
  const SegmentNumbersKey values = currentValuesKey(session);
  std::vector<SegmentNumbersKey> wanted{{values.labels}, values};
  for (const SegmentMap* map : allSegmentsShown(session))
    if (map->labels != values.labels) wanted.push_back({map->labels});
  return wanted;
}

}  // namespace

SegmentNumbersKey currentValuesKey(const Session& session) {
  return {segmentsShown(session)->labels, segmentShown(session)->number, wholeVolume(session)};
}

SegmentNumbers::Rule segmentNumbersRule(const Session& session, const SegmentPainter& painter) {
  return {.wanted = [&session] { return wantedOf(session); },
          .work = [](const SegmentNumbersKey& key, std::size_t) -> SegmentNumbers::Work {
            return [key](const Job&) -> Result<SegmentNumbers::ValuePtr> {
              SegmentNumbersMade made;
              if (key.number == 0)
                made.voxels = labelCounts(*key.labels);
              else
                made.values = valuesIn(maskOf(*key.labels, std::uint8_t(key.number)), *key.volume);
              return std::make_shared<const SegmentNumbersMade>(made);
            };
          },
          .name = [](const SegmentNumbersKey&) { return JobName(tr("Measuring segments")); },
          .bytes = [](const SegmentNumbersMade&) { return sizeof(SegmentNumbersMade); },
          .isPaused = [&painter] { return painter.isPainting(); },
          .lacksMemory = outOfMemory};
}

}  // namespace volumen
