#include "app/overlay_options.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/plane_options.h"
#include "app/usage.h"
#include "results/series/usual_window.h"
#include "results/text/text.h"
#include "viewer/slice/first_window.h"

namespace volumen {

namespace {

Window overlaysWindow(const Opened& opened, const std::optional<Window>& asked) {
  if (asked) return *asked;
  const Window usual = usualWindow(opened.series, firstWindow(*opened.loaded.drawn, opened.series.unit));
  return {usual.centre, std::abs(usual.width)};
}

std::string wordsOf(const Opened& opened, const OverlayOptions& options, const Window& window,
                    const std::string& relation) {
  const auto number = [](double value) { return nlohmann::json(value).dump(); };
  std::string words = descriptionOf(opened.series) + " (" + opened.series.id + ") in " + options.colours +
                      ", opacity " + number(options.opacity) + ", window " + number(window.centre) + "," +
                      number(window.width);
  if (!relation.empty()) words += ", " + relation;
  return words;
}

}  // namespace

std::string descriptionOf(const Series& series) {
  return series.description.empty() ? seriesText(series).toStdString() : series.description;
}

void addOverlayOptions(CLI::App& app, OverlayOptions& options) {
  std::vector<std::string> colours;
  for (const ColourMap map : colourMaps()) colours.emplace_back(colourMapName(map));
  app.add_option("--overlay", options.path,
                 "A series to lay over the slices in colour, as View > Overlay does")
      ->type_name("OTHER");
  app.add_option("--overlay-series", options.series,
                 "Which series of OTHER, as --series; without --overlay, of PATH")
      ->type_name("SERIES");
  app.add_option(
         "--overlay-window", options.window,
         "Centre and width of its colours (default: 0 to 7 SUVbw of PET, else the file's, else nearly "
         "all)")
      ->type_name("C,W");
  oneOf(app.add_option("--overlay-colours", options.colours, "Its colours (default: hotIron)"), colours);
  number(app.add_option("--overlay-opacity", options.opacity, "Its opacity (default: 0.5)"), 0, 1);
}

Result<std::optional<Overlay>> openOverlay(const OverlayOptions& options, const RelationOptions& relation,
                                           const std::string& underPath, Opened& under,
                                           const CancelToken& cancel) {
  if (!options.isGiven()) return std::optional<Overlay>();
  const auto window = windowOf(options.window);
  if (!window) return window.error();
  auto opened = openVolume(options.path.empty() ? underPath : options.path, options.series, cancel);
  if (!opened) return opened.error();
  const auto found = relationOfSpaces(under, *opened, relation, cancel);
  if (!found) return found.error();
  addUnread(under.loaded.unread, opened->loaded.unread);
  for (const std::vector<std::string>& notes : {opened->notes, found->notes})
    under.notes.insert(under.notes.end(), notes.begin(), notes.end());
  const Window shown = overlaysWindow(*opened, *window);
  const GreyMapping grey = windowGrey(*opened->loaded.drawn, opened->series.format == "DICOM", shown);
  SliceLayer layer{opened->loaded.drawn, grey, *colourMapNamed(options.colours), options.opacity,
                   found->toFromFrom};
  std::string words = wordsOf(*opened, options, shown, found->words);
  return std::optional(Overlay{*std::move(opened), std::move(layer), std::move(words)});
}

}  // namespace volumen
