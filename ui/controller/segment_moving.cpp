#include "ui/controller/segment_moving.h"

#include <QLocale>
#include <memory>
#include <utility>

#include "ui/controller/segment_target.h"
#include "ui/workspace/segment_maps.h"
#include "ui/workspace/text.h"

namespace volumen {

SegmentWork moveOf(const Session& session, std::optional<int> map,
                   std::function<void(const QString& sentence)> told) {
  const SegmentMap& from = *segmentsShown(session);
  const Segment& segment = *segmentShown(session);
  const QString name = shownText(segment.label), where = map ? mapName(*map) : tr("a new map");
  const auto taken = std::make_shared<std::int64_t>(0);  // set on another thread when the work is done
  SegmentWork work;
  work.series = from.series;
  work.volume = wholeVolume(session);
  work.text = tr("Move %1 to %2").arg(name, where);
  work.doing = tr("Moving a segment");
  work.makeMaps = [source = from.number, number = segment.number, map, taken](
                      const std::vector<SegmentMap>& maps,
                      const CancelToken&) -> Result<std::vector<SegmentMap>> {
    Result<MovedSegment> moved = withSegmentMoved(maps, source, number, map);
    if (!moved) return moved.error();
    *taken = moved->taken;
    return std::move(moved->maps);
  };
  work.done = [name, where, taken, told = std::move(told)] {
    if (*taken > 0)
      told(tr("%1 took %2 voxels from other segments of %3.")
               .arg(name, QLocale().toString(qlonglong(*taken)), where));
  };
  return work;
}

}  // namespace volumen
