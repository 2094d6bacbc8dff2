#include "ui/workspace/segment_change_text.h"

#include <QLocale>
#include <QStringList>
#include <glm/common.hpp>
#include <map>
#include <set>

#include "results/segments/segments.h"
#include "results/text/text.h"

namespace volumen {

namespace {

using Labels = std::pair<std::uint8_t, std::uint8_t>;  // before, after

// Counts the voxels that went from one label to another, in bricks that differ.
std::map<Labels, std::int64_t> voxelsMoved(const LabelMap& before, const LabelMap& after) {
  std::map<Labels, std::int64_t> moved;
  const glm::ivec3 bricks = after.bricks(), size = after.geometry().size;
  for (int n = 0; n < bricks.x * bricks.y * bricks.z; ++n) {
    const LabelMap::Brick &was = before.brick(std::size_t(n)), &is = after.brick(std::size_t(n));
    if (was.voxels == is.voxels && was.label == is.label) continue;
    const glm::ivec3 corner = LabelMap::edge *
                              glm::ivec3(n % bricks.x, n / bricks.x % bricks.y, n / bricks.x / bricks.y),
                     end = glm::min(glm::ivec3(LabelMap::edge), size - corner);
    for (int k = 0; k < end.z; ++k)
      for (int j = 0; j < end.y; ++j)
        for (int i = 0; i < end.x; ++i) {
          const auto place = std::size_t(i + LabelMap::edge * (j + LabelMap::edge * k));
          const std::uint8_t from = was.voxels ? (*was.voxels)[place] : was.label,
                             to = is.voxels ? (*is.voxels)[place] : is.label;
          if (from != to) ++moved[{from, to}];
        }
  }
  return moved;
}

// Returns "1,234 voxels (1.23 ml)".
QString amountText(std::int64_t voxels, const VoxelGeometry& grid) {
  const QString count =
      voxels == 1 ? tr("1 voxel") : tr("%1 voxels").arg(QLocale().toString(qlonglong(voxels)));
  if (!grid.calibrated) return count;
  const double ml = double(voxels) * grid.voxelVolume() / 1000;
  return tr("%1 (%2 ml)").arg(count, QString::number(ml, 'g', 3));
}

QString nameOf(const SegmentMap& map, int number) {
  const Segment* segment = findSegment(map, number);
  return segment ? shownText(segment->label) : tr("Segment %1").arg(number);
}

}  // namespace

QString changeText(const SegmentMap& before, const SegmentMap& after) {
  if (before.labels->geometry() != after.labels->geometry()) return {};
  std::map<int, QStringList> taken;  // by the number of the segment that took them
  std::set<int> hidden;
  for (const auto& [labels, voxels] : voxelsMoved(*before.labels, *after.labels)) {
    const auto [from, to] = labels;
    const Segment* segment = findSegment(after, to);
    if (!segment) continue;
    if (!segment->visible) hidden.insert(to);
    if (findSegment(before, from))
      taken[to] << tr("%1 of %2").arg(amountText(voxels, after.labels->geometry()), nameOf(before, from));
  }
  QStringList sentences;
  for (const auto& [number, parts] : taken)
    sentences << tr("%1 took %2.").arg(nameOf(after, number), parts.join(QStringLiteral(", ")));
  for (const int number : hidden)
    sentences << tr("%1 is hidden: tick it in the list of segments to see it.").arg(nameOf(after, number));
  return sentences.join(QLatin1Char(' '));
}

}  // namespace volumen
