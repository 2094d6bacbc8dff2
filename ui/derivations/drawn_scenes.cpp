#include "ui/derivations/drawn_scenes.h"

#include <algorithm>
#include <utility>

#include "results/segments/segments.h"
#include "ui/controller/segment_painter.h"

namespace volumen {

DrawnScenes::DrawnScenes(const Session& session, const SegmentPainter& painter, Jobs& jobs,
                         std::size_t mostBytes)
    : session_(session),
      kept_(keptVoxelsRule(session), session, &jobs),
      surfaces_(surfaceFieldsRule(session, painter, kept_, surfaces_, mostBytes), session, &jobs),
      tissues_(tissueLeftRule(session, painter, drawn_, tissues_), session, &jobs) {
  // From the event loop, because Esc undoes the steps since the press once the stroke has ended.
  connect(&painter, &SegmentPainter::ended, this, &DrawnScenes::update, Qt::QueuedConnection);
  connect(&kept_, &KeptVoxels::changed, this, [this] { surfaces_.update(); });
  connect(&kept_, &KeptVoxels::failed, this, &DrawnScenes::failed);
  connect(&surfaces_, &SurfaceFields::changed, this, &DrawnScenes::changed);
  connect(&surfaces_, &SurfaceFields::failed, this, &DrawnScenes::failed);
  connect(&surfaces_, &SurfaceFields::cancelled, this, [this] {
    Q_EMIT cancelled(
        tr("Segments are not drawn in 3D until one is changed, or In 3D is switched off and on."));
  });
  connect(&tissues_, &TissueLeft::changed, this, &DrawnScenes::changed);
  connect(&tissues_, &TissueLeft::failed, this, &DrawnScenes::failed);
  update();
}

void DrawnScenes::update() {
  kept_.update();
  surfaces_.update();
  tissues_.update();
}

void DrawnScenes::noteDrawn(const SeriesKey& series) {
  if (drawn_.insert(series).second) tissues_.update();
}

std::vector<SegmentInScene> DrawnScenes::segments(ViewId view) const {
  std::vector<SegmentInScene> drawn;
  const LoadedSeriesPtr series = session_.seriesOf(view);
  if (!series) return drawn;
  const VoxelGeometry& grid = series->volume->geometry();
  for (const SegmentMap* map : segmentMapsOf(session_.workspace(), session_.workspace().view(view).series)) {
    if (!isOn(*map, grid)) continue;
    for (const Segment* segment : segmentsIn3d(*map)) {
      const SurfaceKey key{map->series, map->number, segment->number, {}, {}};
      const auto made = std::ranges::find_if(
          surfaces_.entries(), [&](const SurfaceFields::Entry& entry) { return entry.key.isOfSame(key); });
      if (made != surfaces_.entries().end() && made->value && made->value->geometry == grid)
        drawn.push_back({segment, made->value});
    }
  }
  return drawn;
}

std::vector<SegmentNotDrawn> DrawnScenes::segmentsNotDrawn(ViewId view) const {
  std::vector<SegmentNotDrawn> notDrawn;
  const SeriesKey& series = session_.workspace().view(view).series;
  for (const SegmentMap* map : segmentMapsOf(session_.workspace(), series))
    for (const Segment* segment : segmentsIn3d(*map))
      if (const auto* made =
              surfaces_.find({series, map->number, segment->number, map->labels, session_.maskOf(series)});
          made && !made->value)
        notDrawn.push_back({segment, QString::fromStdString(made->whyNot)});
  return notDrawn;
}

Scene DrawnScenes::scene(ViewId view) const {
  Scene scene = session_.sceneOf(view);
  if (const TissueLeft::Entry* drawn = tissue(view)) {
    const LoadedSeries& whole = *drawn->key.of;
    scene = drawnAsTheWhole(std::move(scene), whole.window, whole.valueSpread, whole.volume->geometry());
  }
  for (const SegmentInScene& drawn : segments(view))
    scene.segments.push_back(surfaceOf(*drawn.segment, drawn.field));
  return scene;
}

const TissueLeft::Entry* DrawnScenes::tissue(ViewId view) const {
  const LoadedSeriesPtr series = session_.seriesOf(view);
  if (!series || !showsScene(session_.workspace().view(view).kind)) return nullptr;
  const auto made = std::ranges::find_if(
      tissues_.entries(), [&](const TissueLeft::Entry& entry) { return areOneSeries(entry.key.of, series); });
  if (made == tissues_.entries().end() || !made->value || made->value->left == made->key.of) return nullptr;
  if (made->key.segments.empty() && session_.preferences().tableIn3d) return nullptr;
  return made->value->left->volume->geometry() == series->volume->geometry() ? &*made : nullptr;
}

LoadedSeriesPtr DrawnScenes::series(ViewId view) const {
  const TissueLeft::Entry* drawn = tissue(view);
  return drawn ? drawn->value->left : session_.seriesOf(view);
}

}  // namespace volumen
