#pragma once

#include <QImage>
#include <QString>
#include <vector>

namespace volumen {

/// The estimated error of each pixel of a picture as a grey image, and the meaning of its greys.
struct ErrorImage {
  QImage image;  ///< null if the error is not known
  QString legend;
};

/// Returns the image of `map`, which has the error in 1/255 per pixel, top row first (Rendered::error). Black
/// is 0. White is the largest error, but at least 8/255, which 1 % of the pixels may reach at `standard`.
ErrorImage errorImage(const std::vector<float>& map, QSize size);

}  // namespace volumen
