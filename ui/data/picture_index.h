#pragma once

#include <optional>
#include <vector>

namespace volumen {

struct ReferencedPicture;
struct Series;

/// A picture of an open series, by its index there from 0.
struct PicturePlace {
  const Series* series = nullptr;
  int index = 0;
};

/// Returns the referenced picture in these series, the first of several frames; empty if none holds it.
std::optional<PicturePlace> findPicture(const std::vector<const Series*>& all,
                                        const ReferencedPicture& picture);

/// Returns whether one of `pictures` refers to picture `index` of a series.
bool namesPicture(const std::vector<ReferencedPicture>& pictures, const Series& series, int index);

/// Returns the indices (from 0) of the pictures of a series that are referred to.
std::vector<int> picturesNamed(const std::vector<ReferencedPicture>& pictures, const Series& series);

}  // namespace volumen
