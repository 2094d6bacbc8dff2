#include "ui/workspace/corner_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>

#include "io/curved.h"
#include "results/series/time_points.h"
#include "results/text/measured_text.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/curved_text.h"
#include "ui/workspace/key_images.h"
#include "ui/workspace/link_text.h"
#include "ui/workspace/time_points.h"
#include "viewer/slice/plane.h"

namespace volumen {

namespace {

// In reading order. Lines with the lowest rank stay longest.
struct CornerRow {
  CornerItem item;
  bool right;
  int rank;
};
constexpr CornerRow cornerTable[] = {
    {CornerItem::patient, false, 1},   {CornerItem::study, false, 2},   {CornerItem::sexAge, false, 6},
    {CornerItem::series, false, 3},    {CornerItem::overlay, false, 5}, {CornerItem::projection, false, 4},
    {CornerItem::thickness, false, 7}, {CornerItem::plane, true, 1},    {CornerItem::number, true, 2},
    {CornerItem::step, true, 3},       {CornerItem::position, true, 8}, {CornerItem::slab, true, 5},
    {CornerItem::pixelSize, true, 9},  {CornerItem::mask, true, 6},     {CornerItem::link, true, 4},
    {CornerItem::mark, true, 7},       {CornerItem::turn, true, 1}};

// Names planes by the file's axes if the patient's sides are unknown.
QString kindText(ViewKind kind, bool knownSides) {
  const KindRow& row = rowOf(kind);
  return tr(knownSides ? row.text : row.plane->axesText);
}

QString slabText(const FlatLook& look) {
  const char* mode = look.slabMode == SlabMode::max   ? "MIP"
                     : look.slabMode == SlabMode::min ? "MinIP"
                                                      : "Mean";
  return QStringLiteral("%1 %2 mm").arg(QLatin1String(mode)).arg(look.slabMm, 0, 'f', 1);
}

// Returns a plane's position along its patient axis, "S 12.5 mm" or "z 12.5 mm"; "oblique" if it is turned.
QString positionText(ViewKind kind, const SlicePlane& plane, bool knownSides) {
  constexpr double parallel = 1e-3;
  const glm::dvec3 along = glm::abs(Crosshair().plane(kind).normal());  // a patient axis
  if (glm::length(glm::cross(plane.normal(), along)) > parallel) return tr("oblique");
  const int axis = along.x > 0 ? 0 : along.y > 0 ? 1 : 2;
  const double shown = std::round(10 * plane.centre[axis]) / 10 + 0.0;  // no -0.0
  if (!knownSides) return QStringLiteral("%1 %2 mm").arg(QLatin1Char("xyz"[axis])).arg(shown, 0, 'f', 1);
  if (shown == 0) return QStringLiteral("0 mm");
  return QStringLiteral("%1 %2 mm")
      .arg(QString::fromStdString(sideLetters(shown < 0 ? -along : along)))
      .arg(std::abs(shown), 0, 'f', 1);
}

int numberIn(const std::string& text, std::size_t from, std::size_t count) {
  int number = 0;
  if (text.size() >= from + count) std::from_chars(text.data() + from, text.data() + from + count, number);
  return number;
}

// Returns "45 y" from "045Y", else the age from birth and study dates. De-identification leaves zero years,
// or the study date as birth date; both count as unknown.
QString ageText(const Series& series) {
  const std::string& age = series.patientAge;
  if (age.size() == 4 && numberIn(age, 0, 3) + (age[3] == 'D') > 0 &&
      std::string("YMWD").find(age[3]) != std::string::npos)
    return QStringLiteral("%1 %2").arg(numberIn(age, 0, 3)).arg(QChar::fromLatin1(age[3]).toLower());
  const std::string &born = series.patientBirthDate, &studied = series.studyDate;
  if (born.size() != 8 || studied.size() != 8 || born == studied) return {};
  const int years = numberIn(studied, 0, 4) - numberIn(born, 0, 4);
  const int whole = years - (numberIn(studied, 4, 4) < numberIn(born, 4, 4) ? 1 : 0);
  return whole < 0 || whole > 150 ? QString() : tr("%1 y").arg(whole);
}

QString joined(QStringList parts, const QString& with) {
  parts.removeAll(QString());
  return parts.join(with);
}

// Returns the acquired slices (from 1) on both sides of position `k` on the drawn grid.
std::pair<int, int> neighbours(const Series& series, double k) {
  const int below = int(std::floor(k + 1e-3)), last = series.acquired.size.z;
  if (!series.regular) return {std::clamp(below + 1, 1, last), std::clamp(below + 2, 1, last)};
  const std::vector<int>& copies = series.regular->copies;
  int from = 1, to = last;
  for (int n = 0; n < int(copies.size()); ++n) {
    if (copies[std::size_t(n)] < 0) continue;
    if (n <= k + 1e-3) from = copies[std::size_t(n)] + 1;
    if (n > k + 1e-3) return {from, copies[std::size_t(n)] + 1};
  }
  return {from, to};
}

}  // namespace

void CornerTexts::add(CornerItem item, const QString& text) {
  if (!text.isEmpty()) items_.emplace_back(item, text);
}

void CornerTexts::add(CornerItem item, const QStringList& texts) {
  for (const QString& text : texts) add(item, text);
}

QString CornerTexts::text(CornerItem item) const {
  const auto found = std::ranges::find(items_, item, &std::pair<CornerItem, QString>::first);
  return found == items_.end() ? QString() : found->second;
}

QStringList CornerTexts::corner(bool right, int lines) const {
  std::vector<std::pair<int, int>> kept;  // rank and index in `texts`
  std::vector<QString> texts;
  for (const CornerRow& row : cornerTable)
    for (const auto& [item, text] : items_)
      if (row.right == right && row.item == item) {
        kept.emplace_back(row.rank, int(texts.size()));
        texts.push_back(text);
      }
  std::ranges::sort(kept);
  kept.resize(std::min(kept.size(), std::size_t(std::max(0, lines))));
  std::ranges::sort(kept, {}, &std::pair<int, int>::second);
  QStringList corner;
  for (const auto& [rank, place] : kept) corner << texts[std::size_t(place)];
  return corner;
}

QString turnText(PictureTurn turn) {
  const QString turned = turn.quarters ? tr("Turned %1\u00b0").arg(90 * turn.quarters) : QString();
  if (!turn.mirrored) return turned;
  return turned.isEmpty() ? tr("Mirrored") : tr("%1, mirrored").arg(turned);
}

QString studyTimeText(const Series& series) {
  const QString date = dateText(series.studyDate);
  if (date.isEmpty()) return series.format == "DICOM" ? tr("(no date)") : QString();
  return namesHidden() ? date : joined({date, timeText(series.studyTime)}, QStringLiteral(" "));
}

QString sexAgeText(const Series& series) {
  return joined({shownText(series.patientSex), ageText(series)}, QStringLiteral(", "));
}

QString projectionText(const Series& series, int frame) {
  const ProjectionView projection = projectionOf(series, frame);
  return joined({shownText(projection.laterality), shownText(projection.viewPosition)}, QStringLiteral(" "));
}

QString lossyText(const Series& series) {
  if (!series.lossyRatio) return {};
  QStringList ratios;  // one for each compression
  for (const QString& text : shownText(*series.lossyRatio).split(QLatin1Char('\\')))
    if (const double ratio = text.toDouble(); ratio > 0) ratios << tr("%1:1").arg(shortNumberText(ratio));
  return joined({tr("Lossy"), ratios.join(tr(", "))}, QStringLiteral(" "));
}

QString stepText(const Workspace& workspace, const SeriesKey& series) {
  const QString step = timePointText(workspace, series);
  const auto state = workspace.series.find(series);
  if (!step.isEmpty() || state == workspace.series.end()) return step;
  QStringList words;
  for (const SplitBy& by : state->second.series->splitBy) words << shownText(by.words);
  if (const std::string& b = state->second.series->bValue; words.isEmpty() && !b.empty() && b != "0")
    words << tr("b %1").arg(shownText(b));
  return joined(words, tr(", "));
}

CornerTexts seriesCorner(const Series& series, int frame) {
  CornerTexts texts;
  texts.add(CornerItem::patient, patientText(series));
  texts.add(CornerItem::study, studyTimeText(series));
  texts.add(CornerItem::sexAge, sexAgeText(series));
  texts.add(CornerItem::series, seriesText(series));
  texts.add(CornerItem::projection, projectionText(series, frame));
  return texts;
}

PlaneNumber planeNumber(const Series& series, const VoxelGeometry& drawn, ViewKind kind,
                        const Crosshair& crosshair, const SlicePlane& plane) {
  SlicePlane thin = plane;
  thin.slabMm = 0;
  const PictureSeen seen = pictureSeen(series, drawn, thin);
  const int count = series.acquired.size.z;
  if (seen.index) return {false, QStringLiteral("%1 / %2").arg(*seen.index + 1).arg(count)};
  const double k = drawn.voxelFromPatient(plane.centre).z;
  if (onSlice(thin, drawn, 0) && k > -0.5 && k < drawn.size.z - 0.5) {
    const auto [from, to] = neighbours(series, k);
    return {true, from == to ? tr("beside %1 / %2").arg(from).arg(count)
                             : tr("between %1 and %2 / %3").arg(from).arg(to).arg(count)};
  }
  const StackPlace place = stackPlace(drawn, kind, crosshair);
  return {true, QStringLiteral("%1 / %2").arg(place.index + 1).arg(place.count)};
}

namespace {

// Returns the lines of a curved reformat.
CornerTexts curvedCorner(const Workspace& workspace, const ViewState& state, const LoadedSeries& shown,
                         const SlicePlane& plane, const PlaneNumber& number, CornerTexts texts) {
  const FlatLook look = flatLookOf(state);
  texts.add(CornerItem::plane, curvedPlaneText(shown.series, plane));
  texts.add(CornerItem::number, number.text);
  if (isOfEarlierCurve(workspace, shown.series)) texts.add(CornerItem::mask, tr("of an earlier curve"));
  const auto source = workspace.series.find(keyOf(sourceOf(shown.series)));
  if (source != workspace.series.end() && !source->second.mask.empty())
    texts.add(CornerItem::mask, tr("with what was taken away"));
  texts.add(CornerItem::mask, maskTexts(workspace.series.at(state.series).mask));
  texts.add(CornerItem::turn, turnText(look.turn));
  texts.add(CornerItem::position, curvedPlaceText(shown.series, plane));
  if (look.slabMm > 0) texts.add(CornerItem::slab, slabText(look));
  return texts;
}

}  // namespace

CornerTexts slicesCorner(const Workspace& workspace, ViewId view, const LoadedSeries& shown,
                         const SlicePlane& plane) {
  const ViewState& state = workspace.view(view);
  const FlatLook look = flatLookOf(state);
  const VoxelGeometry& geometry = shown.volume->geometry();
  const SeriesState& series = workspace.series.at(keyOf(shown.series));
  const PlaneNumber number =
      planeNumber(shown.series, geometry, state.kind, crosshairOf(workspace, view, shown), plane);
  CornerTexts texts = seriesCorner(shown.series);
  if (shown.series.curved) return curvedCorner(workspace, state, shown, plane, number, std::move(texts));
  const QString thickness = thicknessText(shown.series);
  const bool knownSides = knowsSides(shown.series);
  const QString acquired = number.reformatted && knownSides ? planeText(shown.series.acquired) : QString();
  texts.add(CornerItem::thickness, thickness.isEmpty() || !number.reformatted ? thickness
                                   : acquired.isEmpty() ? tr("of slices %1").arg(thickness)
                                                        : tr("of %1 slices, %2").arg(acquired, thickness));
  const QString kind = kindText(state.kind, knownSides);
  texts.add(CornerItem::plane, number.reformatted ? tr("%1, reformatted").arg(kind) : kind);
  texts.add(CornerItem::number, number.text);
  texts.add(CornerItem::step, stepText(workspace, keyOf(shown.series)));
  texts.add(CornerItem::mark, lossyText(shown.series));
  texts.add(CornerItem::mask, maskTexts(series.mask));
  texts.add(CornerItem::turn, turnText(look.turn));
  if (!geometry.calibrated) return texts;
  texts.add(CornerItem::position, positionText(state.kind, plane, knownSides));
  if (look.slabMm > 0) texts.add(CornerItem::slab, slabText(look));
  texts.add(CornerItem::link, linkText(workspace, view));
  return texts;
}

}  // namespace volumen
