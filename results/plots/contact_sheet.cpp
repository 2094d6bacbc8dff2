#include <algorithm>
#include <cmath>

#include "results/plots/picture_image.h"
#include "results/plots/study_charts.h"

namespace volumen {

namespace {

// Factor of displayed differences: 8/255 becomes full brightness.
constexpr int magnification = 32;
constexpr int edge = 168, caption = 44, gap = 10, columns = 10, head = 76;

class Sheet {
 public:
  explicit Sheet(std::size_t tiles)
      : rows_(int(tiles + columns - 1) / columns),
        image_(columns * (edge + gap) + gap, head + rows_ * (edge + caption + gap), QImage::Format_RGB32),
        painter_(&image_) {
    image_.fill(Qt::white);
  }

  void title(const QString& large, const QString& small) {
    write({gap, 8, image_.width() - 2. * gap, 34}, large, 22, true);
    write({gap, 42, image_.width() - 2. * gap, 24}, small, 14, false);
  }

  void add(const QImage& picture, const QString& name, const QString& errors, bool front) {
    const int x = gap + next_ % columns * (edge + gap), y = head + next_ / columns * (edge + caption + gap);
    ++next_;
    const QImage fitted = picture.scaled(edge, edge, Qt::KeepAspectRatio, Qt::FastTransformation);
    painter_.fillRect(x, y, edge, edge, QColor(240, 242, 245));
    painter_.drawImage(x + (edge - fitted.width()) / 2, y + (edge - fitted.height()) / 2, fitted);
    if (front) {
      painter_.setPen(QPen(QColor(230, 159, 0), 3));
      painter_.drawRect(x, y, edge - 1, edge - 1);
    }
    write({double(x), double(y + edge + 2), edge, 20}, name, 11, true);
    write({double(x), double(y + edge + 21), edge, 19}, errors, 11, false);
  }

  QImage image() {
    painter_.end();
    return image_;
  }

 private:
  void write(const QRectF& where, const QString& what, int px, bool bold) {
    QFont font;
    font.setPixelSize(px);
    font.setBold(bold);
    painter_.setFont(font);
    painter_.setPen(Qt::black);
    const QString fitting = QFontMetricsF(font).elidedText(what, Qt::ElideRight, where.width());
    painter_.drawText(where, Qt::AlignLeft | Qt::AlignVCenter, fitting);
  }

  int rows_, next_ = 0;
  QImage image_;
  QPainter painter_;
};

}  // namespace

QImage contactSheet(const AccuracyStudy& study, const StudyTitle& title) {
  std::vector<const StudyRow*> shown;
  for (const StudyRow& row : study.rows)
    if (row.setting.knob != "grid") shown.push_back(&row);
  Sheet sheet(shown.size() + 1);
  sheet.title(
      QStringLiteral("Differences from the reference, %1 x as large (white: 8/255 and more); framed: on the "
                     "front")
          .arg(magnification),
      QStringLiteral("%1  |  %2  |  %3  |  %4")
          .arg(QString::fromStdString(title.volume), QString::fromStdString(title.scene),
               QString::fromStdString(referenceText(study.truth)), QString::fromStdString(title.date)));
  sheet.add(imageOf(study.truth.picture), QStringLiteral("the reference"),
            QStringLiteral("%1 s").arg(study.truth.ms / 1000, 0, 'f', 1), false);
  for (const StudyRow* row : shown)
    sheet.add(differenceImage(row->pixels, study.truth, magnification),
              QString::fromStdString(settingName(row->setting)),
              QStringLiteral("max %1, P99 %2, %3 ms")
                  .arg(row->error.maximum, 0, 'g', 3)
                  .arg(row->error.percentile99, 0, 'g', 2)
                  .arg(row->medianMs, 0, 'f', 0),
              row->front);
  return sheet.image();
}

}  // namespace volumen
