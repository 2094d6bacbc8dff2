#include "tests/ui/segment_sequence.h"

#include <cstdlib>

namespace volumen::tests {

QString SegmentSequence::act() {
  const Act& chosen = anyAct(acts(), chance_);
  session().endGesture();
  const int before = steps() - first_;
  (this->*chosen.run)();
  const bool isNew = chosen.run != &SegmentSequence::redoes;
  QString wrong = idle() ? remember(before, isNew) : QStringLiteral("it never ends");
  if (wrong.isEmpty()) wrong = wrongLabels();
  return wrong.isEmpty() ? wrong : QStringLiteral("%1: %2").arg(QLatin1String(chosen.name), wrong);
}

// `isNew` is true if a new step must differ from all undone ones.
QString SegmentSequence::remember(int before, bool isNew) {
  const int after = steps() - first_;
  if (std::abs(after - before) > 1) return QStringLiteral("%1 steps").arg(after - before);
  if (after == before + 1 && isNew) {
    states_.resize(std::size_t(after));
    states_.push_back(workspace());
  }
  return isState(after) ? QString() : QStringLiteral("what is there is not that of its step");
}

// Checks a sample of voxels: each label of each map is 0 or that of an existing segment.
QString SegmentSequence::wrongLabels() {
  for (const SegmentMap* map : segmentMapsOf(workspace(), series()))
    for (int k = 0; k < 40; k += 3)
      for (int j = 0; j < 40; j += 2)
        for (int i = 0; i < 40; ++i)
          if (const int label = map->labels->at({i, j, k}); label != 0 && !findSegment(*map, label))
            return QStringLiteral("voxels of segment %1, which is none").arg(label);
  return {};
}

QString SegmentSequence::wrongUndone() {
  const auto wrongAt = [&](const char* what, int n) {
    if (steps() - first_ == n && isState(n)) return QString();
    return QStringLiteral("%1 to state %2 of %3").arg(QLatin1String(what)).arg(n).arg(states_.size());
  };
  const int last = int(states_.size()) - 1;
  for (int n = steps() - first_; n-- > 0;) {
    undo();
    if (const QString wrong = wrongAt("undone", n); !wrong.isEmpty()) return wrong;
  }
  for (int n = 1; n <= last; ++n) {
    redo();
    if (const QString wrong = wrongAt("done again", n); !wrong.isEmpty()) return wrong;
  }
  return idle() ? QString() : QStringLiteral("it never ends");
}

}  // namespace volumen::tests
