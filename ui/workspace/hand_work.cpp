#include "ui/workspace/hand_work.h"

#include <QStringList>
#include <algorithm>

#include "results/text/text.h"

namespace volumen {

namespace {

template <class Made, class From>
void append(std::vector<Made>& to, const From& from) {
  to.insert(to.end(), from.begin(), from.end());
}

bool areOne(const Measurement& a, const Measurement& b) {
  return a.series == b.series && a.shape == b.shape && a.textOffset == b.textOffset;
}

// Choosing the current segment is no work.
bool areOne(const SegmentMap& a, const SegmentMap& b) {
  SegmentMap same = a;
  same.current = b.current;
  return same == b;
}

}  // namespace

HandWork workIn(const Workspace& workspace) {
  HandWork work;
  append(work.measurements, workspace.measurements);
  append(work.keyImages, workspace.keyImages);
  append(work.segmentMaps, workspace.segmentMaps);
  for (const ClosedSeries& closed : workspace.closed) {
    append(work.measurements, closed.measurements);
    append(work.keyImages, closed.keyImages);
    append(work.segmentMaps, closed.segmentMaps);
  }
  for (const auto& [key, state] : workspace.series)
    if (!state.mask.lassos.empty()) work.cuts.emplace_back(key, state.mask);
  return work;
}

HandWork without(HandWork work, const HandWork& saved) {
  std::erase_if(work.measurements, [&](const Measurement& m) {
    return std::ranges::any_of(saved.measurements, [&](const Measurement& s) { return areOne(m, s); });
  });
  const auto isIn = [](const auto& all) {
    return [&all](const auto& made) { return std::ranges::find(all, made) != all.end(); };
  };
  std::erase_if(work.keyImages, isIn(saved.keyImages));
  std::erase_if(work.cuts, isIn(saved.cuts));
  std::erase_if(work.segmentMaps, [&](const SegmentMap& m) {
    return std::ranges::any_of(saved.segmentMaps, [&](const SegmentMap& s) { return areOne(m, s); });
  });
  return work;
}

HandWork operator+(HandWork a, const HandWork& b) {
  append(a.measurements, b.measurements);
  append(a.keyImages, b.keyImages);
  append(a.cuts, b.cuts);
  append(a.segmentMaps, b.segmentMaps);
  return a;
}

QString workText(const HandWork& work) {
  QStringList parts;
  const std::size_t measurements = work.measurements.size(), marks = work.keyImages.size(),
                    cuts = work.cuts.size();
  if (measurements > 0)
    parts << (measurements == 1 ? tr("1 measurement") : tr("%1 measurements").arg(measurements));
  if (marks > 0) parts << (marks == 1 ? tr("1 key image") : tr("%1 key images").arg(marks));
  std::size_t segments = 0;
  for (const SegmentMap& map : work.segmentMaps) segments += map.segments.size();
  if (segments > 0) parts << (segments == 1 ? tr("1 segment") : tr("%1 segments").arg(segments));
  if (cuts > 0) parts << (cuts == 1 ? tr("the cuts in 1 series") : tr("the cuts in %1 series").arg(cuts));
  return parts.join(QStringLiteral(", "));
}

}  // namespace volumen
