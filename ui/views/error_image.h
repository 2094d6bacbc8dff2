#pragma once

#include <QImage>
#include <QString>
#include <vector>

namespace volumen {

/// How far the pixels of a picture may be off, as a picture in grey, and what its greys mean.
struct ErrorImage {
  QImage image;  ///< null where nothing is known
  QString legend;
};

/// `map`: in 1/255, one entry a pixel, first row on top (Rendered::error). 0 is black; white is the largest,
/// or 8/255 (what a hundredth of the pixels may be off by at `standard`) where that is less.
ErrorImage errorImage(const std::vector<float>& map, QSize size);

}  // namespace volumen
