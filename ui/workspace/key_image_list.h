#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "results/series/loaded_series.h"
#include "ui/data/derived_key.h"
#include "ui/workspace/picture_look.h"

namespace volumen {

/// A key image whose series is open.
struct ListedKeyImage {
  std::shared_ptr<const Series> series;
  int index = 0;                         ///< in the series, from 0
  std::optional<ChosenWindow> window{};  ///< KeyImage::window
};

/// Key images that were marked together.
struct KeyImageGroup {
  QString name;             ///< "Marked here", "Key objects: Of Interest (left lung)"
  bool isDocument = false;  ///< marked in a file, not here
  std::vector<ListedKeyImage> pictures;
  std::size_t notHere = 0;  ///< further pictures of the document that are not open
};

/// Returns all key images: the user's own, if any, then those of each key object document. `open` are all
/// open pictures.
std::vector<KeyImageGroup> listKeyImages(const Workspace& workspace,
                                         const std::vector<DerivedObjectPtr>& derived,
                                         const std::vector<const Series*>& open);

/// Returns "CT Head (3), slice 12".
QString keyImageName(const ListedKeyImage& image);

/// Returns a flat view of the key image alone, with the window it was marked with. Shows a slice with its
/// measurements if `shown` is its series in memory and draws that slice; else a frame.
PictureStop viewOfKeyImage(Workspace workspace, const ListedKeyImage& image, const LoadedSeriesPtr& shown);

}  // namespace volumen
