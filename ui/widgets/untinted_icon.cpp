#include "ui/widgets/untinted_icon.h"

#include <QPixmap>

namespace volumen {

QIcon untintedIcon(const QImage& image) {
  QIcon icon;
  for (const QIcon::Mode mode : {QIcon::Normal, QIcon::Selected})
    icon.addPixmap(QPixmap::fromImage(image), mode);
  return icon;
}

}  // namespace volumen
