#include "ui/exports/picture_maker.h"

#include "results/text/text.h"

namespace volumen {

void PictureMaker::tellProgress(const Job& job, std::size_t made) const {
  const QString text = tr("%1: %2 of %3").arg(job.name().doing).arg(made).arg(count());
  job.tell(made > 0 ? text : QString(), double(made) / double(count()));
}

QString PictureMaker::cancelledText() const { return tr("Interrupted; nothing was written."); }

PictureText plainPictureText(const QStringList& warnings) {
  PictureText text{{"Software", "volumen " VOLUMEN_VERSION}, {"Comment", "Not for clinical use"}};
  if (!warnings.isEmpty())
    text.emplace_back("volumen-warnings", warnings.join(QLatin1Char('\n')).toStdString());
  return text;
}

}  // namespace volumen
