#include <QClipboard>
#include <QDir>
#include <QGuiApplication>
#include <optional>

#include "io/export/captured_pictures.h"
#include "io/export/film_file.h"
#include "io/files/aside.h"
#include "results/text/text.h"
#include "ui/exports/picture_sink.h"
#include "ui/overlays/slice_sheet.h"
#include "viewer/volume/free_name.h"

namespace volumen {

namespace {

Status writePicture(const MadePicture& made, const QString& path) {
  const QImage image =
      made.image.hasAlphaChannel() ? made.image : made.image.convertToFormat(QImage::Format_RGB888);
  return writeImage(image, path.toStdString(), made.text);
}

// Returns the name, or one with a further number if it is taken.
QString freeFor(const QString& name, const std::function<bool(const QString& name)>& isTaken) {
  return QString::fromStdString(freeName(
      name.toStdString(), [&](const std::string& one) { return isTaken(QString::fromStdString(one)); }));
}

QString numberedName(const QString& name, std::size_t number, int digits) {
  return QStringLiteral("%1-%2").arg(name).arg(number, digits, 10, QLatin1Char('0'));
}

// Returns the position in the stack, such as "12 / 31" or "Frame 3 / 10".
QString numberText(const Overlays& overlays) {
  for (const QString& line : overlays.topRight)
    if (line.contains(QStringLiteral(" / "))) return line;
  return {};
}

}  // namespace

PictureSink pictureFile(const QString& path) {
  const auto last = std::make_shared<MadePicture>();
  const auto take = [last](std::size_t, const MadePicture& picture) {
    *last = picture;
    return Status();
  };
  return {take, [last, path](std::size_t) -> Result<QString> {
            if (Status written = writePicture(*last, path); !written) return written.error();
            return tr("Saved %1").arg(path);
          }};
}

PictureSink captureFile(const QString& path, const Series& series, const CaptureTags& tags, int count) {
  const auto capture = std::make_shared<CapturedPictures>(path.toStdString(), series, tags, count);
  const auto take = [capture](std::size_t, const MadePicture& picture) {
    return capture->take(picture.image, picture.text, {});
  };
  return {take, [capture, path](std::size_t) -> Result<QString> {
            if (Status written = capture->finish(); !written) return written.error();
            return tr("Saved %1").arg(path);
          }};
}

PictureSink filmFile(const QString& path, int count, int perSecond) {
  const auto film = std::make_shared<std::unique_ptr<FilmFile>>();
  PictureSink sink;
  sink.begin = [=]() -> Status {
    auto begun = FilmFile::create(path.toStdString(), count, perSecond);
    if (!begun) return begun.error();
    *film = *std::move(begun);
    return {};
  };
  sink.take = [film](std::size_t, const MadePicture& picture) {
    return (*film)->add(picture.image, picture.text, {});
  };
  sink.finish = [film, path](std::size_t) -> Result<QString> {
    if (Status written = (*film)->finish({}); !written) return written.error();
    return tr("Saved %1").arg(path);
  };
  return sink;
}

PictureSink clipboard() {
  const auto last = std::make_shared<QImage>();
  PictureSink sink;
  sink.take = [last](std::size_t, const MadePicture& picture) {
    *last = picture.image;
    return Status();
  };
  sink.finish = [last](std::size_t) -> Result<QString> {
    QGuiApplication::clipboard()->setImage(*last);
    return tr("Copied to the clipboard");
  };
  sink.isInWindow = true;
  return sink;
}

PictureSink numberedFiles(const QString& path, int count) {
  const QString suffix = path.mid(path.lastIndexOf(QLatin1Char('.')));
  const auto name = std::make_shared<QString>(path.chopped(suffix.size()));
  const auto pathOf = [suffix](const QString& one, int n) {
    return numberedName(one, std::size_t(n), 3) + suffix;
  };
  PictureSink sink;
  sink.begin = [=] {
    *name = freeFor(*name, [&](const QString& one) {
      for (int n = 0; n < count; ++n)
        if (QFileInfo::exists(pathOf(one, n))) return true;
      return false;
    });
    return Status();
  };
  sink.take = [=](std::size_t n, const MadePicture& picture) {
    return writePicture(picture, pathOf(*name, int(n)));
  };
  sink.finish = [=](std::size_t made) -> Result<QString> {
    return tr("Saved %1 pictures, the last as %2").arg(made).arg(pathOf(*name, int(made) - 1));
  };
  return sink;
}

PictureSink newFolder(const QString& parent, const QString& name) {
  const auto aside = std::make_shared<std::optional<FolderAside>>();
  PictureSink sink;
  sink.begin = [=] {
    auto made = FolderAside::in(parent.toStdString());
    if (!made)
      return Status(Error{tr("Cannot write into %1: choose another folder.").arg(parent).toStdString()});
    aside->emplace(std::move(*made));
    return Status();
  };
  sink.take = [=](std::size_t, const MadePicture& picture) {
    const QString file = numberedName(name, std::size_t(picture.label.number), 4);
    const QString folder = QString::fromStdString((*aside)->path());
    return writePicture(picture, folder + QLatin1Char('/') + file + QStringLiteral(".png"));
  };
  sink.finish = [=](std::size_t made) -> Result<QString> {
    const QString target =
        freeFor(parent + QLatin1Char('/') + name, [](const QString& one) { return QFileInfo::exists(one); });
    if (Status s = (*aside)->become(target.toStdString()); !s)
      return Error{tr("Cannot write %1: choose another folder.").arg(target).toStdString()};
    return made == 1 ? tr("Saved 1 picture in %1").arg(target)
                     : tr("Saved %1 pictures in %2").arg(made).arg(target);
  };
  return sink;
}

PictureSink contactSheet(const SheetLook& look, const PictureSink& into) {
  struct Made {
    std::unique_ptr<SliceSheet> sheet;
    MadePicture first;
  };
  const auto made = std::make_shared<Made>();
  const auto take = [look, made](std::size_t n, const MadePicture& picture) {
    const Overlays& over = picture.overlays;
    if (n == 0) {
      QStringList head = over.topLeft;
      if (look.sharesWindow && !over.bottomRight.isEmpty()) head << over.bottomRight;
      made->sheet = std::make_unique<SliceSheet>(look.rows, look.columns, picture.image.size(),
                                                 look.withTexts ? head : QStringList());
      made->first = picture;
    }
    if (look.withTexts)
      made->sheet->add(picture.image, numberText(over), over.left, picture.mmPerPixel.value_or(0));
    else
      made->sheet->add(picture.image, {});
    return Status();
  };
  const auto finish = [made, into](std::size_t) -> Result<QString> {
    made->first.image = made->sheet->image();
    if (Status taken = into.take(0, made->first); !taken) return taken.error();
    return into.finish(1);
  };
  return {take, finish, into.begin, into.isInWindow};
}

}  // namespace volumen
