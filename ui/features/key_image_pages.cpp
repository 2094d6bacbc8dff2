#include <QStandardPaths>
#include <algorithm>

#include "results/text/text.h"
#include "ui/exports/flat_pictures.h"
#include "ui/features/exporting.h"
#include "ui/panels/pages_dialog.h"
#include "ui/workspace/key_image_list.h"

namespace volumen {

namespace {

constexpr int pageEdge = 1400;  // longer edge of a picture on a page, pixels

// A key image with the state that draws it.
struct MarkedImage {
  ListedKeyImage image;
  QString document;  // the document that marks it; empty if marked in this session
  PictureStop stop;  // PictureLabel::group is its study
};

// Puts all key images on pages, one study a page, as PDF or on paper.
class KeyImagePages : public ExportFeature {
 public:
  explicit KeyImagePages(Workbench& bench);

 private:
  void ask();
  std::vector<MarkedImage> marked() const;
  PictureMakerPtr pictures(const std::vector<MarkedImage>& marked, bool namesHidden) const;
  void askWhere(const PictureMakerPtr& pictures, const PageLook& look, bool isForPaper);
};

// Returns whether two series belong to one study and share a page head.
bool areOneStudy(const Series& a, const Series& b) {
  return a.patientId == b.patientId && a.patientName == b.patientName && a.studyUid == b.studyUid;
}

KeyImagePages::KeyImagePages(Workbench& bench) : ExportFeature(bench, tr("pages that are being made")) {
  bench_.addAction({"keyImagePages",
                    tr("Key images as pages..."),
                    {},
                    "",
                    false,
                    [this](bool) { ask(); },
                    {{"picturesMenu", 20}}});
}

// Asks for options for the present key images.
void KeyImagePages::ask() {
  const std::vector<MarkedImage> marked = this->marked();
  if (marked.empty()) return warn(tr("There are no key images: K marks the picture that is shown."));
  auto* dialog = new PagesDialog(int(marked.size()), bench_.dialogParent());
  connect(dialog, &QDialog::accepted, this, [this, dialog, marked] {
    askWhere(pictures(marked, dialog->namesHidden()), dialog->look(), dialog->isForPaper());
  });
  dialog->open();
}

// Sorts the key images by study, otherwise in the order of the list.
std::vector<MarkedImage> KeyImagePages::marked() const {
  const Workspace& workspace = session_.workspace();
  std::vector<MarkedImage> marked;
  for (const KeyImageGroup& group : listKeyImages(workspace, bench_.document.derived.all(), open_.pictures()))
    for (const ListedKeyImage& image : group.pictures) {
      const LoadedSeriesPtr held = session_.seriesNamed(keyOf(*image.series));
      PictureStop stop = heldNow(viewOfKeyImage(workspace, image, held), session_);
      const auto same = std::ranges::find_if(
          marked, [&](const MarkedImage& one) { return areOneStudy(*one.image.series, *image.series); });
      stop.label.group = same == marked.end() ? int(marked.size()) : same->stop.label.group;
      marked.push_back({image, group.isDocument ? group.name : QString(), std::move(stop)});
    }
  std::ranges::stable_sort(marked, {}, [](const MarkedImage& one) { return one.stop.label.group; });
  return marked;
}

PictureMakerPtr KeyImagePages::pictures(const std::vector<MarkedImage>& marked, bool namesHidden) const {
  const HidingNames hiding(namesHidden);
  PictureLook look;
  look.size = PictureLook::Size::whole;
  look.edge = pageEdge;
  look.namesHidden = namesHidden;
  std::vector<PictureStop> stops;
  for (const auto& [image, document, stop] : marked) {
    stops.push_back(stop);
    const QString name = keyImageName(image);
    stops.back().label.head = pageHead(*image.series);
    stops.back().label.caption = document.isEmpty() ? name : name + QStringLiteral(" - ") + document;
  }
  return flatPictures(grid_, std::move(stops), look);
}

void KeyImagePages::askWhere(const PictureMakerPtr& pictures, const PageLook& look, bool isForPaper) {
  const auto make = [this, pictures](const PictureSink& sink) { run({tr("Making pages"), pictures, sink}); };
  if (isForPaper)
    return askForPrinter("pagesPrintDialog", nullptr,
                         [=](const auto& printer) { make(printedPages(printer, look)); });
  askForPath({"pagesFileDialog", tr("Save the pages"), tr("PDF documents (*.pdf)"), tr("key images.pdf"),
              QFileDialog::AnyFile, QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation)},
             [=](const QString& path) { make(pdfPages(path, tr("Key images"), look)); });
}

}  // namespace

std::unique_ptr<Feature> makeKeyImagePages(Workbench& bench) {
  return std::make_unique<KeyImagePages>(bench);
}

}  // namespace volumen
