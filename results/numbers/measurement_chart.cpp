#include "results/numbers/measurement_chart.h"

#include <QStringList>
#include <algorithm>
#include <cmath>

#include "results/numbers/csv.h"
#include "results/text/text.h"
#include "viewer/measure/profile.h"

namespace volumen {

namespace {

QString valueTitle(const std::string& unit) {
  return unit.empty() ? tr("Value") : tr("Value (%1)").arg(shownText(unit));
}

QString quoted(const QString& text) {
  QString inside = text;
  return QLatin1Char('"') + inside.replace(QLatin1Char('"'), QStringLiteral("\"\"")) + QLatin1Char('"');
}

}  // namespace

QString chartText(ChartKind kind) {
  return kind == ChartKind::profile     ? tr("Profile")
         : kind == ChartKind::histogram ? tr("Histogram")
                                        : tr("Over time");
}

MeasuredChart profileChart(std::span<const glm::dvec3> line, const Volume& volume, const ValueScale& scale,
                           Interpolation interpolation, const Measured& length) {
  MeasuredChart chart;
  chart.xTitle = tr("Distance (%1)").arg(shownText(length.unit));
  chart.yTitle = valueTitle(scale.unit);
  bool inside = false;
  for (const ProfilePoint& point : profileAlong(line, volume, interpolation)) {
    const bool isValue = !std::isnan(point.value);
    if (isValue && !inside) chart.lines.emplace_back();
    if (isValue) chart.lines.back().emplace_back(point.share * length.number, point.value * scale.factor);
    inside = isValue;
  }
  if (chart.lines.empty()) chart.problem = tr("The line has no length, or lies outside.");
  return chart;
}

MeasuredChart histogramChart(const ValueCounts& counts, const ValueScale& scale, const QString& counted) {
  MeasuredChart chart;
  chart.xTitle = valueTitle(scale.unit);
  chart.yTitle = counted;
  if (counts.counts.empty()) return chart;
  std::vector<QPointF>& stairs = chart.lines.emplace_back();
  const auto edge = [&](std::size_t bin) { return (counts.low + counts.width * double(bin)) * scale.factor; };
  stairs.emplace_back(edge(0), 0);
  for (std::size_t bin = 0; bin < counts.counts.size(); ++bin) {
    stairs.emplace_back(edge(bin), double(counts.counts[bin]));
    stairs.emplace_back(edge(bin + 1), double(counts.counts[bin]));
  }
  stairs.emplace_back(edge(counts.counts.size()), 0);
  return chart;
}

MeasuredChart histogramChart(const Shape& region, const Volume& volume, const ValueScale& scale,
                             const QString& counted) {
  MeasuredChart chart = histogramChart(countsOf(region, volume), scale, counted);
  if (chart.lines.empty()) chart.problem = tr("The region holds no values.");
  return chart;
}

MeasuredChart timeChart(const StepAxis& axis, const std::vector<std::optional<double>>& means,
                        const std::string& unit) {
  MeasuredChart chart;
  chart.xTitle = axis.title;
  chart.yTitle = unit.empty() ? tr("Mean") : tr("Mean (%1)").arg(shownText(unit));
  chart.marked = true;
  std::vector<QPointF> line;
  for (std::size_t n = 0; n < means.size(); ++n)
    if (means[n]) line.emplace_back(axis.at[n], *means[n]);
  const auto missing = means.size() - line.size();
  if (missing > 0) chart.problem = tr("%1 of %2 volumes have no value here.").arg(missing).arg(means.size());
  if (!line.empty()) chart.lines.push_back(std::move(line));
  return chart;
}

QString chartAsCsv(const MeasuredChart& chart) {
  const bool isNamed = !chart.looks.empty();
  QStringList heads{quoted(chart.xTitle), quoted(chart.yTitle)};
  if (isNamed) heads.prepend(quoted(tr("Name")));
  if (!chart.sds.empty()) heads << quoted(tr("SD"));
  QStringList rows{heads.join(QLatin1Char(','))};
  for (std::size_t n = 0; n < chart.lines.size(); ++n) {
    if (n > 0) rows << QString(heads.size() - 1, QLatin1Char(','));
    for (std::size_t k = 0; k < chart.lines[n].size(); ++k) {
      const QPointF p = chart.lines[n][k];
      QStringList fields{csvNumber(p.x()), csvNumber(p.y())};
      if (!chart.sds.empty()) fields << csvNumber(chart.sds[n][k]);
      if (isNamed) fields.prepend(csvField(harmlessName(chart.looks[n].name)));
      rows << fields.join(QLatin1Char(','));
    }
  }
  return rows.join(QStringLiteral("\r\n")) + QStringLiteral("\r\n");
}

}  // namespace volumen
