#pragma once

#include <optional>
#include <vector>

namespace volumen {

struct ReferencedPicture;
struct Series;

/// A picture of a series that is open: its number there, from 0.
struct PicturePlace {
  const Series* series = nullptr;
  int index = 0;
};

/// Which picture of these series is meant, of several frames the first; none where none of them holds it.
std::optional<PicturePlace> findPicture(const std::vector<const Series*>& all,
                                        const ReferencedPicture& picture);

/// Whether these name picture `index` of a series.
bool namesPicture(const std::vector<ReferencedPicture>& pictures, const Series& series, int index);

/// The pictures of a series that are named, from 0 on.
std::vector<int> picturesNamed(const std::vector<ReferencedPicture>& pictures, const Series& series);

}  // namespace volumen
