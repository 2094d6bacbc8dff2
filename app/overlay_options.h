#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "app/space_relation.h"
#include "results/pictures/slice_image.h"

namespace volumen {

/// The options of a series over slices (View > Overlay of the window), as typed.
struct OverlayOptions {
  std::string path, series, window, colours = "hotIron";
  double opacity = 0.5;
  bool isGiven() const { return !path.empty() || !series.empty(); }
};

/// A series over slices of another one.
struct Overlay {
  Opened opened;
  SliceLayer layer;
  std::string words;  ///< what lies over the slices, and how: series, colours, opacity, window, relation
};

/// Returns the description of a series; if it has none, modality and number (seriesText()).
std::string descriptionOf(const Series& series);

/// Adds --overlay, --overlay-series, --overlay-window, --overlay-colours and --overlay-opacity.
void addOverlayOptions(CLI::App& app, OverlayOptions& options);

/// Opens the overlay that the options name, or returns nothing if they name none. Without a path it is a
/// series of `underPath`. Notes are added to `under`, the series below. The window is that of overlays in the
/// desktop program. The Error: it cannot be read, or is that of relationOfSpaces().
Result<std::optional<Overlay>> openOverlay(const OverlayOptions& options, const RelationOptions& relation,
                                           const std::string& underPath, Opened& under,
                                           const CancelToken& cancel);

}  // namespace volumen
