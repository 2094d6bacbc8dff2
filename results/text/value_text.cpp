#include "results/text/value_text.h"

#include <atomic>
#include <cmath>

#include "results/text/text.h"

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

QString valueText(const LoadedSeries& shown, double value) {
  return QString::number(value * shownScale(shown.series).factor, 'f', valueDecimals(shown) - 1) +
         unitSuffix(shown.series) + unitNote(shown.series);
}

int valueDecimals(const LoadedSeries& shown) {
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

QString digitsText(double number, int digits) {
  const double size = std::abs(number);
  const bool isLong = size >= std::pow(10, digits) - 0.5 && size < 1e15;
  return isLong ? QString::number(number, 'f', 0) : QString::number(number, 'g', digits);
}

std::pair<QString, QString> windowNumbers(const Window& window) {
  constexpr double most = 1e9, least = 1e-4;  // beyond these only an exponent is readable
  const double width = std::abs(window.width);
  if (width < least || width >= most || std::abs(window.centre) >= most)
    return {QString::number(window.width, 'g', 4), QString::number(window.centre, 'g', 4)};
  int decimals = std::max(0, 3 - int(std::floor(std::log10(width))));
  const auto isExact = [&](double value, int places) {
    return QString::number(value, 'f', places).toDouble() == QString::number(value, 'f', decimals).toDouble();
  };
  while (decimals > 0 && isExact(window.width, decimals - 1) && isExact(window.centre, decimals - 1))
    --decimals;
  return {QString::number(window.width, 'f', decimals), QString::number(window.centre, 'f', decimals)};
}

QString namedWindowText(const QString& name, const Window& stored, const Series& series) {
  const auto [width, centre] = windowNumbers(shownWindow(stored, series));
  return QStringLiteral("%1 (%2 / %3)").arg(name, width, centre);
}

QString windowText(const Window& window, const Series& series) {
  const Window shown = shownWindow(window, series);
  const auto [width, centre] = windowNumbers({shown.centre, std::abs(shown.width)});
  const QString text = tr("W %1 L %2").arg(width, centre);
  return series.modality == "PT" ? text + unitSuffix(series) : text;
}

}  // namespace volumen
