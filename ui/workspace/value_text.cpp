#include "ui/workspace/value_text.h"

#include <atomic>
#include <cmath>

#include "ui/workspace/text.h"

namespace volumen {

namespace {

std::atomic<PetUnit> petUnit = PetUnit::suvBodyWeight;

Window times(const Window& window, double factor) { return {window.centre * factor, window.width * factor}; }

}  // namespace

void showPetIn(PetUnit unit) { petUnit = unit; }

PetUnit shownPetUnit() { return petUnit; }

ValueScale shownScale(const Series& series) { return valueScale(series, petUnit); }

QString unitNote(const Series& series) {
  const QString why = shownText(shownScale(series).why);
  return why.isEmpty() ? why : QStringLiteral(" (%1)").arg(why);
}

QString valueText(const ShownSeries& shown, double value) {
  return QString::number(value * shownScale(shown.series).factor, 'f', valueDecimals(shown) - 1) +
         unitSuffix(shown.series) + unitNote(shown.series);
}

int valueDecimals(const ShownSeries& shown) {
  Histogram histogram;
  const double factor = shownScale(shown.series).factor;
  histogram.low = shown.histogram.low * factor, histogram.high = shown.histogram.high * factor;
  return valueDecimals(histogram);
}

Window shownWindow(const Window& window, const Series& series) {
  return times(window, shownScale(series).factor);
}

Window storedWindow(const Window& shown, const Series& series) {
  return times(shown, 1 / shownScale(series).factor);
}

QString windowText(const Window& window, const Series& series) {
  const Window shown = shownWindow(window, series);
  const QString text = tr("W %1 L %2").arg(std::abs(shown.width), 0, 'g', 4).arg(shown.centre, 0, 'g', 4);
  return series.modality == "PT" ? text + unitSuffix(series) : text;
}

}  // namespace volumen
