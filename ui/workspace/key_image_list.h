#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "ui/data/derived_key.h"
#include "ui/data/loaded_series.h"
#include "ui/workspace/picture_look.h"

namespace volumen {

/// A key image that is here.
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
  std::size_t notHere = 0;  ///< how many more the document names
};

/// All key images: those that the user marked, where there are any, then those of each key object document.
/// `open`: all pictures that are open.
std::vector<KeyImageGroup> listKeyImages(const Workspace& workspace,
                                         const std::vector<DerivedObjectPtr>& derived,
                                         const std::vector<const Series*>& open);

/// "CT Head (3), slice 12".
QString keyImageName(const ListedKeyImage& image);

/// A flat view that shows it and nothing else: where `shown` is its series in memory and the picture one of
/// the slices that are drawn, as a slice, with what is measured there; else as a frame. By the window that it
/// was marked by.
PictureStop viewOfKeyImage(Workspace workspace, const ListedKeyImage& image, const LoadedSeriesPtr& shown);

}  // namespace volumen
