#include "ui/workspace/curve_spans.h"

#include <algorithm>
#include <cmath>

#include "results/text/text.h"
#include "results/text/value_text.h"
#include "viewer/scene/visible_range.h"

namespace volumen {

std::optional<ValueRange> rangeOfSpan(const TransferFunction& curve, int number, const LoadedSeries& series) {
  const std::vector<ValueRange> spans = visibleSpans(curve);
  if (number < 0 || number >= int(spans.size())) return {};
  const ValueRange& span = spans[std::size_t(number)];
  const Histogram& histogram = series.histogram;
  const double factor = shownScale(series.series).factor, steps = std::pow(10.0, valueDecimals(series));
  const auto up = [&](double value) { return std::ceil(steps * factor * value) / steps / factor; };
  const auto down = [&](double value) { return std::floor(steps * factor * value) / steps / factor; };
  if (span.low > histogram.high) return ValueRange{up(span.low), up(span.low)};
  if (span.high < histogram.low) return ValueRange{down(span.high), down(span.high)};
  const ValueRange within{std::max(span.low, histogram.low), std::min(span.high, histogram.high)};
  const ValueRange rounded{up(within.low), down(within.high)};
  return rounded.low <= rounded.high ? rounded : within;
}

std::optional<ValueRange> rangeFollowed(const Segment& segment, const TransferFunction& curve,
                                        const LoadedSeries& series) {
  if (!segment.span || int(visibleSpans(curve).size()) != segment.span->of) return {};
  return rangeOfSpan(curve, segment.span->number, series);
}

std::string nameOfRange(const ValueRange& range, const Series& series) {
  const double factor = shownScale(series).factor;
  const QString name =
      tr("%1 to %2%3").arg(range.low * factor).arg(range.high * factor).arg(unitSuffix(series));
  return name.trimmed().toStdString();
}

}  // namespace volumen
