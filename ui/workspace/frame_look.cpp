#include "ui/workspace/frame_look.h"

#include <algorithm>
#include <cmath>

#include "io/study/frame_series.h"
#include "results/text/text.h"
#include "results/text/value_text.h"

namespace volumen {

namespace {

const std::vector<NamedGrey>& greysOf(const SeriesState& state, const LoadedFrame& frame) {
  const bool own = frame.seriesGreys.empty() || hasOwnWindows(state, frame.slice->series);
  return own ? frame.greys : frame.seriesGreys;
}

const NamedGrey& chosenOf(const SeriesState& state, const LoadedFrame& frame) {
  const std::vector<NamedGrey>& greys = greysOf(state, frame);
  return greys[std::min(std::size_t(std::max(0, state.namedGrey)), greys.size() - 1)];
}

// Returns whether DICOM's LINEAR function is right for these values.
bool areIntegers(const LoadedFrame& frame) {
  const NamedGrey& first = frame.greys.front();
  return first.ofValues || first.mapping.function != WindowFunction::linearExact;
}

QString nameOf(const NamedGrey& grey, std::size_t number, std::size_t count, const Series& series) {
  QString name = shownText(grey.name);
  const bool isTable = !grey.mapping.table.grey.empty();
  if (name.isEmpty()) name = count == 1 ? tr("From file") : tr("From file, %1").arg(number + 1);
  if (isTable) return tr("%1, LUT").arg(name);
  const QString numbers = namedWindowText(name, grey.mapping.window, series);
  return grey.mapping.function == WindowFunction::sigmoid ? tr("%1, sigmoid").arg(numbers) : numbers;
}

}  // namespace

// Frames made one by one may show different body parts: a window for a hand does not suit a chest.
bool hasOwnWindows(const SeriesState& state, const Series& series) {
  return state.frameWindow == FrameWindow::ofEach ||
         (state.frameWindow == FrameWindow::usual && areMadeOneByOne(series));
}

GreyMapping frameGrey(const SeriesState& state, const FlatLook& look, const LoadedFrame& frame) {
  if (frame.greys.empty()) return {};
  GreyMapping grey = chosenOf(state, frame).mapping;
  grey.inverted = frame.greys.front().mapping.inverted;  // a property of the pixels, not of the window
  if (const std::optional<Window>& window = state.window) {
    const double width = std::abs(window->width);
    const bool isLinear = areIntegers(frame) && width >= 1;
    grey.window = {window->centre, width};
    grey.function = isLinear ? WindowFunction::linear : WindowFunction::linearExact;
    grey.table = {};
    grey.inverted = grey.inverted != (window->width < 0);
  }
  grey.inverted = grey.inverted != look.inverted;
  return grey;
}

std::vector<GreyChoice> greyChoices(const LoadedFrame& frame, const SeriesState& state,
                                    const OwnWindows& own) {
  if (frame.greys.empty()) return {};
  std::vector<GreyChoice> all{{tr("Automatic"), 0, {}}};
  const std::vector<NamedGrey>& greys = greysOf(state, frame);
  for (std::size_t n = 0; n < greys.size(); ++n)
    if (!greys[n].ofValues)
      all.push_back({nameOf(greys[n], n, greys.size(), frame.slice->series), int(n), {}});
  WindowCounts counts{int(all.size()) - 1};
  for (const NamedWindow& tissue : tissueWindows(frame.slice->series)) {
    all.push_back({tissue.name, 0, tissue.window});
    ++counts.ofProgram;
  }
  for (const NamedWindow& each : ownWindowsFor(own, frame.slice->series)) {
    all.push_back({each.name, 0, each.window});
    ++counts.own;
  }
  const std::vector<WindowKey> keys = windowKeys(counts);
  for (std::size_t n = 0; n < all.size(); ++n) all[n].key = keys[n];
  return all;
}

SeriesState withGrey(SeriesState state, const GreyChoice& choice) {
  state.namedGrey = choice.namedGrey;
  state.window = choice.window;
  return state;
}

QString greyText(const SeriesState& state, const FlatLook& look, const LoadedFrame& frame,
                 const OwnWindows& own) {
  if (frame.greys.empty()) return {};
  const GreyMapping grey = frameGrey(state, look, frame);
  if (!grey.table.grey.empty()) return tr("LUT %1").arg(shownText(chosenOf(state, frame).name)).trimmed();
  const QString text = namedWindow(state.window.value_or(grey.window), frame.slice->series, own);
  return grey.function == WindowFunction::sigmoid ? tr("%1, sigmoid").arg(text) : text;
}

}  // namespace volumen
