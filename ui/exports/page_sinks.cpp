#include <QBuffer>
#include <QPdfWriter>
#include <QPrinter>
#include <QSaveFile>

#include "results/text/text.h"
#include "ui/exports/picture_sink.h"

namespace volumen {

namespace {

constexpr double marginMm = 12;  // page margin of a PDF

// Pages whose pictures are compressed until they are painted, which saves memory.
struct KeptPages {
  struct Picture {
    QByteArray png;
    PagePicture rest;  // all except the image
  };
  struct Page {
    PictureLabel label;  // of its first picture
    std::vector<Picture> pictures;
    std::vector<PageTable> tables = {};  // divided before they are painted
  };
  std::vector<Page> pages;

  void add(const MadePicture& picture, int perPage) {
    const PictureLabel& label = picture.label;
    if (!picture.tables.empty()) return pages.push_back({label, {}, picture.tables});
    if (pages.empty() || label.group != pages.back().label.group ||
        int(pages.back().pictures.size()) == perPage)
      pages.push_back({label, {}});
    QByteArray png;
    QBuffer buffer(&png);
    picture.image.save(&buffer, "PNG");
    pages.back().pictures.push_back(
        {png, {{}, picture.mmPerPixel, label.caption, picture.overlays.lengthsWord}});
  }

  // Returns the pages as they are on this device, where tables may take several.
  std::vector<Page> onDevice(QPagedPaintDevice& device) const {
    std::vector<Page> all;
    for (const Page& page : pages) {
      if (page.tables.empty()) all.push_back(page);
      for (std::vector<PageTable>& tables : tablesOnPages(page.tables, page.label.head, device))
        all.push_back({page.label, {}, std::move(tables)});
    }
    return all;
  }

  Status paint(QPagedPaintDevice& device, const PageLook& look) const {
    const std::vector<Page> all = onDevice(device);
    const auto pageAt = [&all](std::size_t n) {
      PicturePage page{all[n].label.head, {}, all[n].tables};
      for (const Picture& picture : all[n].pictures) {
        page.pictures.push_back(picture.rest);
        page.pictures.back().image = QImage::fromData(picture.png, "PNG");
      }
      return page;
    };
    return paintPages(device, {all.size(), pageAt}, look);
  }
};

// Returns a sink that writes all pages at once at the end, because each states their number.
PictureSink pagesFor(const PageLook& look, const std::function<Status(const KeptPages& pages)>& write,
                     const QString& done) {
  const auto kept = std::make_shared<KeptPages>();
  const auto take = [kept, look](std::size_t, const MadePicture& picture) {
    kept->add(picture, look.perPage);
    return Status();
  };
  return {take, [kept, write, done](std::size_t) -> Result<QString> {
            const Status written = write(*kept);
            return written ? Result(done) : written.error();
          }};
}

}  // namespace

PictureSink pdfPages(const QString& path, const QString& title, const PageLook& look) {
  const auto write = [=](const KeptPages& pages) {
    const Error cannot{tr("Cannot write %1: choose another place.").arg(path).toStdString()};
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly)) return Status(cannot);
    {
      QPdfWriter writer(&file);
      writer.setCreator(QStringLiteral("volumen " VOLUMEN_VERSION));
      writer.setTitle(title);
      writer.setResolution(600);
      writer.setPageSize(QPageSize(QPageSize::A4));
      writer.setPageMargins(QMarginsF(marginMm, marginMm, marginMm, marginMm), QPageLayout::Millimeter);
      if (Status painted = pages.paint(writer, look); !painted) return painted;
    }
    return file.commit() ? Status() : Status(cannot);
  };
  return pagesFor(look, write, tr("Saved %1").arg(path));
}

PictureSink printedPages(const std::shared_ptr<QPrinter>& printer, const PageLook& look) {
  const auto write = [=](const KeptPages& pages) { return pages.paint(*printer, look); };
  return pagesFor(look, write, tr("Printed"));
}

}  // namespace volumen
