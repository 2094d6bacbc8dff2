#include "ui/workspace/frame_look.h"

#include <algorithm>
#include <cmath>

#include "ui/workspace/text.h"
#include "ui/workspace/value_text.h"

namespace volumen {

namespace {

const NamedGrey& chosenOf(const SeriesState& state, const ShownFrame& frame) {
  return frame.greys[std::min(std::size_t(std::max(0, state.namedGrey)), frame.greys.size() - 1)];
}

// Whether LINEAR of DICOM is right for these values.
bool areIntegers(const ShownFrame& frame) {
  const NamedGrey& first = frame.greys.front();
  return first.ofValues || first.mapping.function != WindowFunction::linearExact;
}

QString nameOf(const NamedGrey& grey, std::size_t number, std::size_t count, const Series& series) {
  QString name = shownText(grey.name);
  const bool isTable = !grey.mapping.table.grey.empty();
  if (name.isEmpty()) name = count == 1 ? tr("From file") : tr("From file, %1").arg(number + 1);
  if (isTable) return tr("%1, LUT").arg(name);
  const Window w = shownWindow(grey.mapping.window, series);
  const QString numbers =
      QStringLiteral("%1 (%2 / %3)").arg(name).arg(w.width, 0, 'g', 4).arg(w.centre, 0, 'g', 4);
  return grey.mapping.function == WindowFunction::sigmoid ? tr("%1, sigmoid").arg(numbers) : numbers;
}

}  // namespace

GreyMapping frameGrey(const SeriesState& state, const FlatLook& look, const ShownFrame& frame) {
  if (frame.greys.empty()) return {};
  GreyMapping grey = chosenOf(state, frame).mapping;
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

std::vector<GreyChoice> greyChoices(const ShownFrame& frame) {
  if (frame.greys.empty()) return {};
  std::vector<GreyChoice> all{{tr("Automatic"), 0, {}}};
  const std::size_t count = frame.greys.size();
  for (std::size_t n = 0; n < count; ++n)
    if (!frame.greys[n].ofValues)
      all.push_back({nameOf(frame.greys[n], n, count, frame.slice->series), int(n), {}});
  for (const NamedWindow& tissue : tissueWindows(frame.slice->series))
    all.push_back({tissue.name, 0, tissue.window});
  return all;
}

SeriesState withGrey(SeriesState state, const GreyChoice& choice) {
  state.namedGrey = choice.namedGrey;
  state.window = choice.window;
  return state;
}

QString greyText(const SeriesState& state, const FlatLook& look, const ShownFrame& frame) {
  if (frame.greys.empty()) return {};
  const GreyMapping grey = frameGrey(state, look, frame);
  if (!grey.table.grey.empty()) return tr("LUT %1").arg(shownText(chosenOf(state, frame).name)).trimmed();
  const QString text = windowText(grey.window, frame.slice->series);
  return grey.function == WindowFunction::sigmoid ? tr("%1, sigmoid").arg(text) : text;
}

}  // namespace volumen
