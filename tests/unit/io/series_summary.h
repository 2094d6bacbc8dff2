#pragma once

#include <QStringList>

#include "io/load.h"
#include "tests/unit/io/dicom_folder.h"

namespace volumen::tests {

/// Returns "8x8x5 1,1,2 @0,0,1: 0,2,4,6,8": size, spacing, origin and the first value of each slice of a
/// volume. What separated the volume follows: "; TE 2 ms".
inline QString summaryOf(const Series& s) {
  const auto number = [](double v) { return QString::number(v, 'g', 6); };
  const glm::dvec3 mm = s.acquired.spacing(), o = s.acquired.origin;
  QString text =
      QStringLiteral("%1x%2x%3 ").arg(s.acquired.size.x).arg(s.acquired.size.y).arg(s.acquired.size.z);
  text += QStringLiteral("%1,%2,%3 @%4,%5,%6: ")
              .arg(number(mm.x), number(mm.y), number(mm.z), number(o.x), number(o.y), number(o.z));
  const auto loaded = loadSeries(s);
  if (!loaded) return text + QString::fromStdString(loaded.message());
  QStringList values;
  for (const float v : firstOfEachSlice(*loaded->acquired)) values << number(v);
  text += values.join(QStringLiteral(","));
  for (const SplitBy& by : s.splitBy) text += QStringLiteral("; ") + QString::fromStdString(by.words);
  return text;
}

}  // namespace volumen::tests
