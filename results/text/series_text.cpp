#include "results/text/series_text.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "io/study/frame_series.h"
#include "io/study/series.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "viewer/slice/plane.h"

namespace volumen {

namespace {

QString sideText(const std::string& laterality) { return tr("side %1").arg(shownText(laterality)); }
QString projectionText(const std::string& view) { return tr("view %1").arg(shownText(view)); }

// Attributes that may distinguish series, the clearest first, and their texts.
struct Attribute {
  std::string Series::*value;
  QString (*text)(const std::string& value);
};
const Attribute attributes[] = {
    {&Series::laterality, sideText},
    {&Series::viewPosition, projectionText},
    {&Series::echoTime, [](const std::string& v) { return tr("TE %1 ms").arg(shownText(v)); }},
    {&Series::bValue, [](const std::string& v) { return tr("b %1").arg(shownText(v)); }},
    {&Series::timePoint, [](const std::string& v) { return tr("time point %1").arg(shownText(v)); }},
    {&Series::label, [](const std::string& v) { return shownText(v); }},
    {&Series::time, timeText},
};

bool saysProjection(const Attribute& attribute) {
  return attribute.value == &Series::laterality || attribute.value == &Series::viewPosition;
}

QString sizeText(const VoxelGeometry& g) {
  QString text = QStringLiteral("%1 x %2 x %3").arg(g.size.x).arg(g.size.y).arg(g.size.z);
  const glm::dvec3 mm = g.spacing();
  if (g.calibrated)
    text += tr(", %1 x %2 x %3 mm").arg(mm.x, 0, 'g', 4).arg(mm.y, 0, 'g', 4).arg(mm.z, 0, 'g', 4);
  return text;
}

QString mmText(double mm) { return tr("%1 mm").arg(mm, 0, 'g', 3); }

}  // namespace

bool knowsSides(const Series& series) {
  const auto isUnknown = [](const Warning& w) { return w.kind == WarningKind::noDirections; };
  return series.acquired.calibrated && !series.curved && std::ranges::none_of(series.warnings, isUnknown);
}

QString planeText(const VoxelGeometry& geometry) {
  if (!geometry.calibrated) return {};
  constexpr double nearEnough = 0.8;
  const glm::dvec3 normal = glm::abs(sliceNormal(geometry));
  if (normal.z >= nearEnough) return tr("axial");
  if (normal.y >= nearEnough) return tr("coronal");
  return normal.x >= nearEnough ? tr("sagittal") : tr("oblique");
}

QString slicesText(const Series& series) {
  const int count = series.acquired.size.z;
  if (opensAsFrames(series)) return count == 1 ? tr("1 frame") : tr("%1 frames").arg(count);
  QStringList parts{count == 1 ? tr("1 slice") : tr("%1 slices").arg(count),
                    knowsSides(series) ? planeText(series.acquired) : QString()};
  parts.removeAll(QString());
  return parts.join(QStringLiteral(", "));
}

QString thicknessText(const Series& series) {
  if (!series.acquired.calibrated || series.acquired.size.z < 2)
    return series.sliceThickness > 0 ? tr("%1 thick").arg(mmText(series.sliceThickness)) : QString();
  const double apart = sliceDistance(series.acquired), thick = series.sliceThickness;
  const QString distance = series.regular ? tr("unevenly apart") : tr("%1 apart").arg(mmText(apart));
  if (thick <= 0) return distance;
  const QString thickness = tr("%1 thick").arg(mmText(thick));
  return !series.regular && std::abs(apart - thick) <= 0.01 * thick ? thickness
                                                                    : thickness + tr(", ") + distance;
}

bool areNamesakes(const Series& a, const Series& b) {
  return a.studyUid == b.studyUid && a.modality == b.modality && a.description == b.description &&
         (a.format == "DICOM" || a.path == b.path);
}

QStringList tellingApart(const Series& series, const std::vector<const Series*>& others) {
  QStringList found;
  std::vector<const Series*> alike = others;
  for (const Attribute& attribute : attributes) {
    const std::string& value = series.*attribute.value;
    const auto differs = [&](const Series* other) { return other->*attribute.value != value; };
    const bool isAlwaysSaid = opensAsFrames(series) && saysProjection(attribute);
    if (!isAlwaysSaid && std::none_of(alike.begin(), alike.end(), differs)) continue;
    std::erase_if(alike, differs);
    if (!value.empty()) found << attribute.text(value);
  }
  // Films are marked with both: "L MLO".
  if (found.mid(0, 2) == QStringList{sideText(series.laterality), projectionText(series.viewPosition)})
    found = QStringList{shownText(series.laterality) + QLatin1Char(' ') + shownText(series.viewPosition)} +
            found.mid(2);
  return found;
}

QStringList everythingOf(const Series& series) {
  QStringList lines{patientText(series), studyText(series), seriesText(series), slicesText(series),
                    sizeText(series.acquired)};
  if (series.format != "DICOM" && !seriesText(series).contains(shownText(series.description)))
    lines.insert(3, shownText(series.description));
  if (series.regular)
    lines << tr("in 3D %1 even slices, %2 of them interpolated")
                 .arg(series.regular->geometry.size.z)
                 .arg(series.regular->interpolatedSlices);
  for (const Attribute& attribute : attributes)
    if (const std::string& value = series.*attribute.value; !value.empty()) lines << attribute.text(value);
  lines << shownText(series.notVolume)
        << QStringLiteral("%1, %2").arg(QString::fromStdString(series.format), shownText(series.valueType))
        << pathText(series.path);
  for (const Warning& w : series.warnings) lines << QStringLiteral("! ") + shownText(w.sentence);
  lines.removeAll(QString());
  return lines;
}

QStringList factsOf(const Series& series, const std::vector<Warning>& warnings) {
  const VoxelGeometry& g = series.acquired;
  const glm::dvec3 mm = g.spacing();
  QStringList lines{seriesText(series), slicesText(series),
                    tr("%1 rows x %2 columns").arg(g.size.y).arg(g.size.x)};
  if (g.calibrated) lines << tr("Pixels of %1 x %2 mm").arg(mm.y, 0, 'g', 4).arg(mm.x, 0, 'g', 4);
  if (const QString thickness = thicknessText(series); !thickness.isEmpty() && !opensAsFrames(series))
    lines << tr("Slices %1").arg(thickness);
  if (const QString unit = unitSuffix(series); !unit.isEmpty())
    lines << tr("Values in%1%2").arg(unit, unitNote(series));
  // Concerns only the volume: frames are measured in pixels of their own.
  const auto isOfVolume = [](const Warning& w) { return w.kind == WarningKind::notCalibrated; };
  for (const Warning& w : warnings)
    if (!opensAsFrames(series) || !isOfVolume(w)) lines << QStringLiteral("! ") + shownText(w.sentence);
  lines.removeAll(QString());
  return lines;
}

QStringList warningSentences(const std::vector<Warning>& warnings) {
  QStringList sentences;
  for (const Warning& warning : warnings)
    if (warning.kind == WarningKind::other) sentences << shownText(warning.sentence);
  return sentences;
}

QStringList maskTexts(const Mask& mask) {
  QStringList texts;
  if (mask.tableRemoved) texts << tr("table removed");
  if (!mask.lassos.empty()) texts << tr("parts cut away");
  return texts;
}

QString tissueText(const TissueShown& tissue) {
  using enum TissueShown::Where;
  if (tissue.where == everywhere) return {};
  const QString where = tissue.where == inside ? tr("only inside segments") : tr("without segments");
  return tissue.marginMm > 0 ? tr("%1, margin %2 mm").arg(where).arg(tissue.marginMm) : where;
}

}  // namespace volumen
