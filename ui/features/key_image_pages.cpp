#include <QBuffer>
#include <QFileDialog>
#include <QPdfWriter>
#include <QPrintDialog>
#include <QPrinter>
#include <QSaveFile>
#include <QStandardPaths>
#include <algorithm>

#include "ui/features/feature.h"
#include "ui/overlays/picture_pages.h"
#include "ui/panels/pages_dialog.h"
#include "ui/views/picture_run.h"
#include "ui/workspace/key_image_list.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

constexpr int pageEdge = 1400;   // longer edge of a picture on a page, pixels
constexpr double marginMm = 12;  // page margin of a PDF

// A picture compressed until its page is painted, which saves memory.
struct KeptPicture {
  QByteArray png;
  PagePicture rest;  // all except the image
};

struct KeptPage {
  QStringList head;
  std::vector<KeptPicture> pictures;
};

// A key image with the state that draws it.
struct MarkedImage {
  ListedKeyImage image;
  QString document;  // the document that marks it; empty if marked in this session
  PictureStop stop;
};

// Key images grouped by study.
using Studies = std::vector<std::vector<MarkedImage>>;

// Puts all key images on pages, one study a page, as PDF or on paper.
class KeyImagePages : public Feature {
 public:
  explicit KeyImagePages(Workbench& bench);

  QString unsavedText() const override;

 private:
  // The chosen options and the key images at that moment.
  struct Wanted {
    PageLook look;
    bool namesHidden;
    std::vector<KeptPage> pages;      // pages, still without pictures
    std::vector<std::size_t> pageOf;  // page of each picture
    QStringList captions;             // caption of each picture
    std::vector<PictureStop> stops;
  };
  using WantedPtr = std::shared_ptr<Wanted>;
  using Paint = std::function<Status(const PageSource& pages, const PageLook& look)>;

  void ask();
  static WantedPtr wantedOf(const PagesDialog& dialog, const Studies& studies);
  Studies studies() const;
  void askForPdf(const WantedPtr& wanted);
  void askForPrinter(const WantedPtr& wanted);
  void make(const WantedPtr& wanted, const Paint& paint, const QString& done);
};

// Returns whether two series belong to one study and share a page head.
bool areOneStudy(const Series& a, const Series& b) {
  return a.patientId == b.patientId && a.patientName == b.patientName && a.studyUid == b.studyUid;
}

KeptPicture keptOf(const MadePicture& made, const QString& caption) {
  KeptPicture kept{{}, {{}, made.mmPerPixel, caption, made.lengthsWord}};
  QBuffer buffer(&kept.png);
  made.image.save(&buffer, "PNG");
  return kept;
}

PicturePage pageOf(const KeptPage& kept) {
  PicturePage page{kept.head, {}};
  for (const KeptPicture& picture : kept.pictures) {
    page.pictures.push_back(picture.rest);
    page.pictures.back().image = QImage::fromData(picture.png, "PNG");
  }
  return page;
}

Status writePdf(const QString& path, const PageSource& pages, const PageLook& look) {
  const Error cannot{tr("Cannot write %1: choose another place.").arg(path).toStdString()};
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly)) return cannot;
  {
    QPdfWriter writer(&file);
    writer.setCreator(QStringLiteral("volumen " VOLUMEN_VERSION));
    writer.setTitle(tr("Key images"));
    writer.setResolution(600);
    writer.setPageSize(QPageSize(QPageSize::A4));
    writer.setPageMargins(QMarginsF(marginMm, marginMm, marginMm, marginMm), QPageLayout::Millimeter);
    if (Status painted = paintPages(writer, pages, look); !painted) return painted;
  }
  return file.commit() ? Status() : Status(cannot);
}

KeyImagePages::KeyImagePages(Workbench& bench) : Feature(bench) {
  bench_.addAction({"keyImagePages",
                    tr("Key images as pages..."),
                    {},
                    "",
                    false,
                    [this](bool) { ask(); },
                    {{"picturesMenu", 20}}});
}

QString KeyImagePages::unsavedText() const {
  const bool any = std::ranges::any_of(findChildren<PictureRun*>(),
                                       [](const PictureRun* run) { return !run->hasEnded(); });
  return any ? tr("pages that are being made") : QString();
}

// Asks for options for the present key images.
void KeyImagePages::ask() {
  const auto studies = std::make_shared<const Studies>(this->studies());
  std::size_t pictures = 0;
  for (const auto& study : *studies) pictures += study.size();
  if (pictures == 0) return warn(tr("There are no key images: K marks the picture that is shown."));
  auto* dialog = new PagesDialog(int(pictures), bench_.dialogParent());
  connect(dialog, &PagesDialog::pdfWanted, this,
          [this, dialog, studies] { askForPdf(wantedOf(*dialog, *studies)); });
  connect(dialog, &PagesDialog::paperWanted, this,
          [this, dialog, studies] { askForPrinter(wantedOf(*dialog, *studies)); });
  dialog->open();
}

// Groups the key images by study, in the order of the list.
Studies KeyImagePages::studies() const {
  const Workspace& workspace = session_.workspace();
  Studies studies;
  for (const KeyImageGroup& group : listKeyImages(workspace, bench_.document.derived.all(), open_.pictures()))
    for (const ListedKeyImage& image : group.pictures) {
      const auto same = std::ranges::find_if(studies, [&](const std::vector<MarkedImage>& study) {
        return areOneStudy(*study.front().image.series, *image.series);
      });
      auto& study = same == studies.end() ? studies.emplace_back() : *same;
      const LoadedSeriesPtr held = session_.seriesNamed(keyOf(*image.series));
      study.push_back({image, group.isDocument ? group.name : QString(),
                       heldNow(viewOfKeyImage(workspace, image, held), session_)});
    }
  return studies;
}

KeyImagePages::WantedPtr KeyImagePages::wantedOf(const PagesDialog& dialog, const Studies& studies) {
  const auto wanted = std::make_shared<Wanted>();
  wanted->look = {dialog.perPage(), dialog.inTrueSize()};
  wanted->namesHidden = dialog.namesHidden();
  const HidingNames hiding(wanted->namesHidden);
  for (const std::vector<MarkedImage>& study : studies)
    for (std::size_t n = 0; n < study.size(); ++n) {
      const auto& [image, document, stop] = study[n];
      if (n % std::size_t(dialog.perPage()) == 0) wanted->pages.push_back({pageHead(*image.series), {}});
      wanted->pageOf.push_back(wanted->pages.size() - 1);
      const QString name = keyImageName(image);
      wanted->captions << (document.isEmpty() ? name : name + QStringLiteral(" - ") + document);
      wanted->stops.push_back(stop);
    }
  return wanted;
}

void KeyImagePages::askForPdf(const WantedPtr& wanted) {
  auto* dialog = new QFileDialog(bench_.dialogParent(), tr("Save the pages"),
                                 QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation),
                                 tr("PDF documents (*.pdf)"));
  dialog->setObjectName(QStringLiteral("pagesFileDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QStringLiteral("pdf"));
  dialog->selectFile(tr("key images.pdf"));
  connect(dialog, &QFileDialog::fileSelected, this, [this, wanted](const QString& path) {
    make(
        wanted, [path](const auto& pages, const PageLook& look) { return writePdf(path, pages, look); },
        tr("Saved %1").arg(path));
  });
  dialog->open();
}

void KeyImagePages::askForPrinter(const WantedPtr& wanted) {
  const auto printer = std::make_shared<QPrinter>(QPrinter::HighResolution);
  auto* dialog = new QPrintDialog(printer.get(), bench_.dialogParent());
  dialog->setObjectName(QStringLiteral("pagesPrintDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this, [this, printer, wanted] {
    make(
        wanted,
        [printer](const auto& pages, const PageLook& look) { return paintPages(*printer, pages, look); },
        tr("Printed"));
  });
  connect(dialog, &QObject::destroyed, this, [printer] {});  // the dialog uses the printer until then
  dialog->open();
}

void KeyImagePages::make(const WantedPtr& wanted, const Paint& paint, const QString& done) {
  PictureLook look;
  look.size = PictureLook::Size::whole;
  look.edge = pageEdge;
  look.namesHidden = wanted->namesHidden;
  auto* run =
      new PictureRun(grid_, session_, bench_.document.jobs, tr("Making pages"), wanted->stops, look, this);
  connect(run, &PictureRun::ended, this, [this, done](const QString& failure) {
    if (failure.isEmpty())
      tell(done);
    else
      warnUntilDone(failure);
  });
  run->start(
      [wanted](std::size_t n, const MadePicture& made) {
        wanted->pages[wanted->pageOf[n]].pictures.push_back(keptOf(made, wanted->captions[qsizetype(n)]));
        return Status();
      },
      [wanted, paint] {
        const auto page = [&](std::size_t n) { return pageOf(wanted->pages[n]); };
        return paint({wanted->pages.size(), page}, wanted->look);
      });
}

}  // namespace

std::unique_ptr<Feature> makeKeyImagePages(Workbench& bench) {
  return std::make_unique<KeyImagePages>(bench);
}

}  // namespace volumen
