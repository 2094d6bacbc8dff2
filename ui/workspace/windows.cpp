#include "ui/workspace/windows.h"

#include <algorithm>
#include <cmath>

#include "results/series/usual_window.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "viewer/scene/modes.h"
#include "viewer/slice/first_window.h"

namespace volumen {

namespace {

bool isHounsfield(const Series& series) { return series.unit == "HU"; }

// Smallest width that a drag makes, as a share of the spread of values.
constexpr double finest = 1.0 / 4000;

}  // namespace

Window windowInUse(const Scene& scene, const LoadedSeries& series) {
  return scene.window.value_or(series.window);
}

Window flatWindow(const SeriesState& state, const LoadedSeries& series) {
  return state.window.value_or(usualWindow(series.series, series.flatWindow.value_or(series.window)));
}

std::optional<Window> windowToCome(const Series& series, const std::optional<Window>& ofFile) {
  std::optional<Window> first = uptakeWindow(series);
  if (!first) first = ofFile;
  if (!first && isHounsfield(series)) first = softTissueWindow;
  return first ? std::optional(inUsualSense(series, *first)) : std::nullopt;
}

Window overlayWindow(const SeriesState& state, const LoadedSeries& series) {
  const Window window = flatWindow(state, series);
  return {window.centre, std::abs(window.width)};
}

Window windowOfOverlay(const Window& over, const SeriesState& state, const LoadedSeries& series) {
  const double width = std::abs(over.width);
  return {over.centre, flatWindow(state, series).width < 0 ? -width : width};
}

GreyMapping greyMapping(const Window& window, const LoadedSeries& series) {
  GreyMapping grey =
      windowGrey(*series.volume, series.series.format == "DICOM", {window.centre, std::abs(window.width)});
  grey.inverted = window.width < 0;
  return grey;
}

std::vector<NamedWindow> tissueWindows(const Series& series) {
  std::vector<NamedWindow> all;
  if (const ValueScale scale = shownScale(series); scale.unit.starts_with("SUV"))
    for (const double most : {5, 7, 10, 15})
      all.push_back(
          {tr("%1 0 to %2").arg(shownText(scale.unit)).arg(most), storedWindow({most / 2, -most}, series)});
  if (!isHounsfield(series)) return all;
  const std::pair<QString, Window> tissues[] = {{tr("Brain"), {40, 80}},           {tr("Abdomen"), {40, 400}},
                                                {tr("Mediastinum"), {50, 350}},    {tr("Liver"), {90, 150}},
                                                {tr("Bone"), {400, 2000}},         {tr("Lung"), {-600, 1500}},
                                                {tr("CT angiography"), {170, 600}}};
  for (const auto& [name, window] : tissues)
    all.push_back({namedWindowText(name, window, series), window, name});
  // Has no word: nothing in a corner says whether the picture is a maximum.
  const Window boneMip{700, 1800};
  all.push_back({namedWindowText(tr("Bone MIP"), boneMip, series), boneMip});
  const Window stroke{35, 40};
  all.push_back({namedWindowText(tr("Stroke"), stroke, series), stroke, tr("Stroke")});
  return all;
}

std::vector<NamedWindow> ownWindowsFor(const OwnWindows& own, const Series& series) {
  std::vector<NamedWindow> all;
  for (const OwnWindow& each : own) {
    if (!isFor(each, series)) continue;
    const double sign = series.modality == "PT" ? -1 : 1;
    const Window stored = storedWindow({each.window.centre, sign * each.window.width}, series);
    all.push_back(
        {namedWindowText(each.name, {stored.centre, std::abs(stored.width)}, series), stored, each.name});
  }
  return all;
}

QString namedWindow(const Window& window, const Series& series, const OwnWindows& own) {
  std::vector<NamedWindow> named = ownWindowsFor(own, series);
  for (const NamedWindow& tissue : tissueWindows(series)) named.push_back(tissue);
  const auto found = std::ranges::find(named, window, &NamedWindow::window);
  const QString numbers = windowText(window, series);
  if (found == named.end() || found->word.isEmpty()) return numbers;
  return QStringLiteral("%1  %2").arg(found->word, numbers);
}

std::vector<NamedWindow> windowChoices(const LoadedSeries& series, const OwnWindows& own) {
  std::vector<NamedWindow> all{{tr("Automatic"), {}}};
  std::vector<Window> files;
  for (const Window& window : series.volume->attributes().windows)
    if (std::ranges::find(files, window) == files.end()) files.push_back(window);
  for (std::size_t n = 0; n < files.size(); ++n) {
    const QString name = files.size() == 1 ? tr("From file") : tr("From file, %1").arg(n + 1);
    all.push_back({namedWindowText(name, files[n], series.series), files[n]});
  }
  const std::vector<NamedWindow> tissues = tissueWindows(series.series),
                                 owned = ownWindowsFor(own, series.series);
  all.insert(all.end(), tissues.begin(), tissues.end());
  all.insert(all.end(), owned.begin(), owned.end());
  const std::vector<WindowKey> keys = windowKeys({int(files.size()), int(tissues.size()), int(owned.size())});
  for (std::size_t n = 0; n < all.size(); ++n) all[n].key = keys[n];
  return all;
}

Scene withMode(Scene scene, Mode mode, const LoadedSeries& series) {
  scene.mode = mode;
  if (scene.window || mode == Mode::composite || !isHounsfield(series.series)) return scene;
  // A file's window is made for one slice and leaves a projection all white or all black.
  scene.window = rowOf(mode).hounsfield;
  return scene;
}

Scene withUptakeWindow(Scene scene, const Series& series) {
  const std::optional<Window> uptake = uptakeWindow(series);
  if (scene.window && uptake)
    scene.window = Window{uptake->centre, std::copysign(uptake->width, scene.window->width)};
  return scene;
}

WindowEnds endsOf(const Window& window) {
  return {window.centre - window.width / 2, window.centre + window.width / 2};
}

Window windowBetween(WindowEnds ends) { return {(ends.dark + ends.bright) / 2, ends.bright - ends.dark}; }

double narrowestWindow(const LoadedSeries& series) { return finest * series.valueSpread; }

std::optional<Window> windowOfValues(std::vector<float> values, const Window& before,
                                     const LoadedSeries& series) {
  std::erase_if(values, [](float value) { return std::isnan(value); });
  if (values.empty()) return {};
  const auto percentile = [&](double percent) {
    const double rank = std::ceil(percent * double(values.size()) / 100);
    const auto at = values.begin() + std::ptrdiff_t(std::max(1.0, rank)) - 1;
    std::ranges::nth_element(values, at);
    return double(*at);
  };
  const double low = percentile(1), high = percentile(99);
  const double width = std::max(high - low, narrowestWindow(series));
  return Window{(low + high) / 2, before.width < 0 ? -width : width};
}

Window draggedWindow(const Window& atPress, glm::dvec2 pixels, const LoadedSeries& series) {
  const double least = narrowestWindow(series), sign = atPress.width < 0 ? -1 : 1;
  const double width = std::abs(atPress.width), step = std::max(width / 80, least);
  if (series.series.modality == "PT") {
    const double low = atPress.centre - width / 2;
    const double wide = std::max(least, width + (pixels.x + pixels.y) * step);
    return {low + wide / 2, sign * wide};
  }
  return {atPress.centre + pixels.y * step, sign * std::max(least, width + pixels.x * step)};
}

}  // namespace volumen
