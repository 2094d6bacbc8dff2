#include "ui/workspace/frame_text.h"

#include <algorithm>
#include <cmath>

#include "results/text/text.h"
#include "results/text/value_text.h"

namespace volumen {

namespace {

constexpr int centimetres = 3;  // a unit code of UltrasoundRegion

QString withKind(const QString& text, PixelSizeKind kind) {
  const QString word = QLatin1String(pixelSizeWord(kind));
  return word.isEmpty() ? text : QStringLiteral("%1, %2").arg(text, word);
}

QString mmText(glm::dvec2 mm) { return tr("%1, %2 mm").arg(mm.x, 0, 'f', 1).arg(mm.y, 0, 'f', 1); }

bool measuresLengths(const UltrasoundRegion& r) {
  return r.unitX == centimetres && r.unitY == centimetres && r.delta.x > 0 && r.delta.y > 0;
}

const UltrasoundRegion* regionAt(const LoadedFrame& frame, glm::ivec2 pixel) {
  const auto holds = [&](const UltrasoundRegion& r) {
    return glm::all(glm::greaterThanEqual(pixel, r.from)) && glm::all(glm::lessThanEqual(pixel, r.to)) &&
           measuresLengths(r);
  };
  const auto found = std::ranges::find_if(frame.regions, holds);
  return found == frame.regions.end() ? nullptr : &*found;
}

}  // namespace

QString pixelSizeText(const LoadedFrame& frame) {
  if (!hasMm(frame))
    return std::ranges::any_of(frame.regions, measuresLengths) ? tr("mm in regions, else px")
                                                               : tr("not calibrated: px");
  const glm::dvec2 mm = frame.pixel.mm;
  const QString text = mm.x == mm.y ? tr("%1 mm a pixel").arg(mm.x, 0, 'g', 4)
                                    : tr("%1 x %2 mm a pixel").arg(mm.x, 0, 'g', 4).arg(mm.y, 0, 'g', 4);
  return withKind(text, frame.pixel.kind);
}

QString pixelPlaceText(const LoadedFrame& frame, glm::ivec2 pixel) {
  const QString place = tr("%1, %2 px").arg(pixel.x).arg(pixel.y);
  if (hasMm(frame))
    return QStringLiteral("%1 (%2)").arg(
        place, withKind(mmText(glm::dvec2(pixel) * frame.pixel.mm), frame.pixel.kind));
  const UltrasoundRegion* region = regionAt(frame, pixel);
  if (!region) return place;
  return tr("%1 (%2 in its region)")
      .arg(place, mmText(glm::dvec2(pixel - region->from) * region->delta * 10.0));
}

QString pixelValueText(const LoadedFrame& frame, glm::ivec2 pixel) {
  const auto value = [&](const VolumePtr& volume) { return double(volume->value(pixel.x, pixel.y, 0)); };
  if (frame.colour())
    return QStringLiteral("R %1 G %2 B %3")
        .arg(value(frame.slice->volume))
        .arg(value(frame.green))
        .arg(value(frame.blue));
  const double v = value(frame.slice->volume);
  const Series& series = frame.slice->series;
  const double scaled = v * shownScale(series).factor;
  const int decimals = scaled == std::round(scaled) ? 0 : valueDecimals(*frame.slice);
  return QString::number(scaled, 'f', decimals) + unitSuffix(series) + unitNote(series);
}

}  // namespace volumen
