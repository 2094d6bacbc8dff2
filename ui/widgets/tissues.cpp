#include "ui/widgets/tissues.h"

#include <algorithm>
#include <iterator>

namespace volumen {

std::vector<TissueLabel> tissueLabels(const ValueAxis& axis, const std::function<double(QString)>& width) {
  constexpr double gap = 3;  // pixels from the tissue's line
  std::vector<TissueLabel> labels;
  for (const Tissue* tissue = std::begin(tissuesHu); tissue != std::end(tissuesHu); ++tissue) {
    const double x = axis.pixelOf(tissue->value);
    const Tissue* next = std::next(tissue);
    const double end = next == std::end(tissuesHu) ? axis.pixelHigh : axis.pixelOf(next->value);
    const QString name = QString::fromLatin1(tissue->name);
    if (x >= axis.pixelLow && x + 2 * gap + width(name) <= std::min(end, axis.pixelHigh))
      labels.push_back({name, x + gap});
  }
  return labels;
}

}  // namespace volumen
