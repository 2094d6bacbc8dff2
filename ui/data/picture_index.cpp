#include "ui/data/picture_index.h"

#include <algorithm>

#include "io/presentation.h"
#include "io/study/series.h"

namespace volumen {

std::optional<PicturePlace> findPicture(const std::vector<const Series*>& all,
                                        const ReferencedPicture& picture) {
  for (const Series* series : all) {
    const bool isAnother = !picture.seriesUid.empty() && picture.seriesUid != series->seriesUid;
    if (isAnother) continue;
    const std::vector<int> named = picturesNamed({picture}, *series);
    if (!named.empty()) return PicturePlace{series, named.front()};
  }
  return {};
}

bool namesPicture(const std::vector<ReferencedPicture>& pictures, const Series& series, int index) {
  const auto n = std::size_t(index);
  return index >= 0 && n < series.sopInstanceUids.size() && n < series.frames.size() &&
         namesFrame(pictures, series.sopInstanceUids[n], series.frames[n]);
}

std::vector<int> picturesNamed(const std::vector<ReferencedPicture>& pictures, const Series& series) {
  std::vector<int> named;
  for (int n = 0; n < int(series.sopInstanceUids.size()); ++n)
    if (namesPicture(pictures, series, n)) named.push_back(n);
  return named;
}

}  // namespace volumen
