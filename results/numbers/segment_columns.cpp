#include "results/numbers/segment_columns.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "results/numbers/csv.h"
#include "results/numbers/series_columns.h"
#include "results/text/text.h"
#include "results/text/value_text.h"

namespace volumen {

namespace {

using Unit = SegmentColumn::Unit;
using Numbers = std::vector<double>;

template <double SegmentValues::*number>
Numbers ofValues(const SegmentReport& report) {
  return report.values.voxels > 0 ? Numbers{report.values.*number} : Numbers();
}

template <double SegmentForm::*number>
Numbers ofForm(const SegmentReport& report) {
  return report.form ? Numbers{(*report.form).*number} : Numbers();
}

// Returns the same for a number that needs the surface.
template <double SegmentForm::*number>
Numbers ofSurface(const SegmentReport& report) {
  return report.form && !report.form->ofVoxelsAlone ? ofForm<number>(report) : Numbers();
}

template <class Place>
Numbers placeOfForm(const SegmentReport& report, const Place& place) {
  if (!report.form) return {};
  const glm::dvec3 p(place(*report.form));
  return {p.x, p.y, p.z};
}

template <std::size_t n>
Numbers formAxis(const SegmentReport& report) {
  return placeOfForm(report, [](const SegmentForm& f) { return f.axes[n]; });
}

template <std::size_t n>
Numbers longestEnd(const SegmentReport& report) {
  if (report.form && report.form->ofVoxelsAlone) return {};
  return placeOfForm(report, [](const SegmentForm& f) { return f.longestAt[n]; });
}

using InPlaneLine = InPlaneDiameters::Line InPlaneDiameters::*;

template <InPlaneLine line>
Numbers inPlaneMm(const SegmentReport& report) {
  return report.form ? Numbers{(report.form->inPlane.*line).mm} : Numbers();
}

template <InPlaneLine line, std::size_t n>
Numbers inPlaneEnd(const SegmentReport& report) {
  return placeOfForm(report, [](const SegmentForm& f) { return (f.inPlane.*line).at[n]; });
}

Numbers inPlaneSlice(const SegmentReport& report) {
  return report.form ? Numbers{double(report.form->inPlane.slice)} : Numbers();
}

Numbers numbersIf(const std::optional<double>& number) { return number ? Numbers{*number} : Numbers(); }

// Padding has volume but no value.
Numbers timesMl(const SegmentReport& r) {
  if (!r.millilitres || r.values.voxels == 0) return {};
  return {r.values.mean * (*r.millilitres * (double(r.values.voxels) / double(r.voxels)))};
}

std::vector<SegmentColumn> allColumns() {
  const std::vector<const char*> xyz{"x", "y", "z"}, ijk{"i", "j", "k"}, ordered{"1", "2", "3"};
  constexpr InPlaneLine longest = &InPlaneDiameters::longest,
                        perpendicular = &InPlaneDiameters::perpendicular;
  return {
      {"voxels",
       "Voxels",
       nullptr,
       Unit::voxels,
       {},
       [](const SegmentReport& r) { return Numbers{double(r.voxels)}; }},
      {"millilitres",
       "Volume",
       nullptr,
       Unit::ml,
       {},
       [](const SegmentReport& r) { return numbersIf(r.millilitres); }},
      {"surfaceMillilitres",
       "Volume inside surface",
       nullptr,
       Unit::ml,
       {},
       ofSurface<&SegmentForm::surfaceMl>},
      {"difference",
       "Difference",
       nullptr,
       Unit::ml,
       {},
       [](const SegmentReport& r) {
         return r.form && !r.form->ofVoxelsAlone ? Numbers{r.form->surfaceMl - r.form->voxelMl} : Numbers();
       }},
      {"areaMm2", "Surface area", nullptr, Unit::mm2, {}, ofSurface<&SegmentForm::areaMm2>},
      {"mean", "Mean", "SUVmean", Unit::value, {}, ofValues<&SegmentValues::mean>},
      {"sd", "SD", nullptr, Unit::value, {}, ofValues<&SegmentValues::sd>},
      {"min", "Minimum", nullptr, Unit::value, {}, ofValues<&SegmentValues::min>},
      {"max", "Maximum", "SUVmax", Unit::value, {}, ofValues<&SegmentValues::max>},
      {"median", "Median", nullptr, Unit::value, {}, ofValues<&SegmentValues::median>},
      {"p10", "P10", nullptr, Unit::value, {}, ofValues<&SegmentValues::p10>},
      {"p90", "P90", nullptr, Unit::value, {}, ofValues<&SegmentValues::p90>},
      {"peak",
       "Peak of 1 ml",
       "SUVpeak",
       Unit::value,
       {},
       [](const SegmentReport& r) { return numbersIf(r.peak); }},
      {"valueTimesMillilitres", "Mean x volume", "TLG", Unit::valueMl, {}, timesMl},
      {"centroid", "Centroid", nullptr, Unit::mm, xyz,
       [](const SegmentReport& r) {
         return placeOfForm(r, [](const SegmentForm& f) { return f.centroid; });
       }},
      {"boxFirst", "First voxel", nullptr, Unit::voxels, ijk,
       [](const SegmentReport& r) { return placeOfForm(r, [](const SegmentForm& f) { return f.box.low; }); }},
      {"boxLast", "Last voxel", nullptr, Unit::voxels, ijk,
       [](const SegmentReport& r) {
         return placeOfForm(r, [](const SegmentForm& f) { return f.box.high; });
       }},
      {"axisMm", "Axes by moments", nullptr, Unit::mm, ordered,
       [](const SegmentReport& r) { return placeOfForm(r, [](const SegmentForm& f) { return f.axisMm; }); }},
      {"axis1", "Direction of axis 1", nullptr, Unit::none, xyz, formAxis<0>},
      {"axis2", "Direction of axis 2", nullptr, Unit::none, xyz, formAxis<1>},
      {"axis3", "Direction of axis 3", nullptr, Unit::none, xyz, formAxis<2>},
      {"longestMm", "Longest diameter", nullptr, Unit::mm, {}, ofSurface<&SegmentForm::longestMm>},
      {"longestFrom", "Longest diameter from", nullptr, Unit::mm, xyz, longestEnd<0>},
      {"longestTo", "Longest diameter to", nullptr, Unit::mm, xyz, longestEnd<1>},
      {"inPlaneMm", "Longest in-plane diameter", nullptr, Unit::mm, {}, inPlaneMm<longest>},
      {"perpendicularMm", "Perpendicular diameter", nullptr, Unit::mm, {}, inPlaneMm<perpendicular>},
      {"inPlaneSlice", "Slice of in-plane diameters", nullptr, Unit::voxels, {}, inPlaneSlice},
      {"inPlaneFrom", "In-plane diameter from", nullptr, Unit::mm, xyz, inPlaneEnd<longest, 0>},
      {"inPlaneTo", "In-plane diameter to", nullptr, Unit::mm, xyz, inPlaneEnd<longest, 1>},
      {"perpendicularFrom", "Perpendicular from", nullptr, Unit::mm, xyz, inPlaneEnd<perpendicular, 0>},
      {"perpendicularTo", "Perpendicular to", nullptr, Unit::mm, xyz, inPlaneEnd<perpendicular, 1>},
  };
}

QString columnUnit(const SegmentColumn& column, const ValueScale& scale) {
  switch (column.unit) {
    case Unit::ml:
      return QStringLiteral("ml");
    case Unit::mm2:
      return QStringLiteral("mm^2");
    case Unit::mm:
      return QStringLiteral("mm");
    case Unit::value:
      return shownText(scale.unit);
    case Unit::valueMl:
      return (shownText(scale.unit) + QStringLiteral(" ml")).trimmed();
    case Unit::none:
    case Unit::voxels:
      return {};
  }
  return {};
}

QString columnName(const SegmentColumn& column, const ValueScale& scale) {
  return tr(column.suvHead && std::string_view(scale.unit).starts_with("SUV") ? column.suvHead : column.head);
}

QString headWithUnit(const QString& name, const QString& unit) {
  return unit.isEmpty() ? name : QStringLiteral("%1 (%2)").arg(name, unit);
}

// Writes integers in full.
QString readableNumber(double number) {
  return number == std::round(number) && std::abs(number) < 1e15 ? QString::number(qint64(number))
                                                                 : digitsText(number, 5);
}

}  // namespace

const std::vector<SegmentColumn>& segmentColumns() {
  static const std::vector<SegmentColumn> columns = allColumns();
  return columns;
}

std::vector<double> segmentNumbers(const SegmentColumn& column, const SegmentReport& report, double factor) {
  Numbers numbers = column.of(report);
  if (column.unit == Unit::value || column.unit == Unit::valueMl)
    for (double& number : numbers) number *= factor;
  return numbers;
}

QString columnHead(const SegmentColumn& column, const ValueScale& scale) {
  return headWithUnit(columnName(column, scale), columnUnit(column, scale));
}

QString columnText(const SegmentColumn& column, const SegmentReport& report, double factor) {
  QStringList texts;
  for (const double number : segmentNumbers(column, report, factor)) texts << readableNumber(number);
  return texts.isEmpty() ? QStringLiteral("-") : texts.join(QStringLiteral(", "));
}

QString segmentsAsCsv(std::span<const SegmentReport> all, const ValueScale& scale,
                      const QStringList& ofSeries) {
  QStringList heads{tr("Name"), tr("Map")};
  for (const SegmentColumn& column : segmentColumns()) {
    const QString name = columnName(column, scale), unit = columnUnit(column, scale);
    if (column.parts.empty()) heads << csvField(headWithUnit(name, unit));
    for (const char* part : column.parts)
      heads << csvField(headWithUnit(QStringLiteral("%1 %2").arg(name, QLatin1String(part)), unit));
  }
  for (const SeriesColumn& column : seriesColumns()) heads << tr(column.head);
  heads << tr("Made by");
  QString text = heads.join(QLatin1Char(',')) + QStringLiteral("\r\n");
  for (const SegmentReport& report : all) {
    QStringList fields{csvField(harmlessName(QString::fromStdString(report.segment.label))),
                       QString::number(report.map + 1)};
    for (const SegmentColumn& column : segmentColumns()) {
      const Numbers numbers = segmentNumbers(column, report, scale.factor);
      for (std::size_t n = 0; n < std::max<std::size_t>(1, column.parts.size()); ++n)
        fields << (n < numbers.size() ? csvNumber(numbers[n]) : QString());
    }
    for (std::size_t n = 0; n < seriesColumns().size(); ++n) fields << csvField(ofSeries.value(qsizetype(n)));
    fields << csvField(harmlessName(QString::fromStdString(report.made)));
    text += fields.join(QLatin1Char(',')) + QStringLiteral("\r\n");
  }
  return text;
}

}  // namespace volumen
