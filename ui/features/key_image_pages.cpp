#include <QStandardPaths>
#include <algorithm>

#include "results/text/text.h"
#include "ui/exports/flat_pictures.h"
#include "ui/exports/report_maker.h"
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

// All that a report may state, as it was when it was requested.
struct Report {
  std::vector<MarkedImage> marked;  // study after study
  std::vector<ReportedStudy> studies;
};

// Puts all key images, measurements and segments on pages, one study after another, as PDF or on paper.
class KeyImagePages : public ExportFeature {
 public:
  explicit KeyImagePages(Workbench& bench);

 private:
  void ask();
  Report reportNow() const;
  PictureMakerPtr pictures(const std::vector<MarkedImage>& marked, bool namesHidden) const;
  PictureMakerPtr chosen(Report report, const PagesDialog& dialog) const;
  void askWhere(const PictureMakerPtr& pages, const PageLook& look, bool isForPaper);
};

KeyImagePages::KeyImagePages(Workbench& bench) : ExportFeature(bench, tr("pages that are being made")) {
  bench_.addAction({"keyImagePages",
                    tr("Report of key images and measurements..."),
                    {},
                    "",
                    false,
                    [this](bool) { ask(); },
                    {{"picturesMenu", 20}}});
}

void KeyImagePages::ask() {
  const Report report = reportNow();
  if (report.studies.empty())
    return warn(
        tr("There are no key images, measurements or segments: mark a picture with K, measure with D, or "
           "make a segment."));
  auto* dialog = new PagesDialog(
      {int(report.marked.size()), measurementCount(report.studies), segmentCount(report.studies)},
      bench_.dialogParent());
  connect(dialog, &QDialog::accepted, this, [this, dialog, report] {
    askWhere(chosen(report, *dialog), dialog->look(), dialog->isForPaper());
  });
  dialog->open();
}

// Sorts the key images by study, otherwise in the order of the list.
Report KeyImagePages::reportNow() const {
  const Workspace& workspace = session_.workspace();
  Report report;
  for (const KeyImageGroup& group : listKeyImages(workspace, bench_.document.derived.all(), open_.pictures()))
    for (const ListedKeyImage& image : group.pictures) {
      const LoadedSeriesPtr held = session_.seriesNamed(keyOf(*image.series));
      PictureStop stop = heldNow(viewOfKeyImage(workspace, image, held), session_);
      const std::size_t study = studyOf(report.studies, image.series);
      ++report.studies[study].pictures;
      stop.label.group = int(study);
      report.marked.push_back({image, group.isDocument ? group.name : QString(), std::move(stop)});
    }
  std::ranges::stable_sort(report.marked, {}, [](const MarkedImage& one) { return one.stop.label.group; });
  addNumbers(report.studies, session_, bench_.document.measurer);
  return report;
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

// Returns the pages with what the dialog leaves in.
PictureMakerPtr KeyImagePages::chosen(Report report, const PagesDialog& dialog) const {
  for (ReportedStudy& study : report.studies) {
    if (!dialog.withMeasurements()) study.measurements.clear();
    if (!dialog.withSegments()) study.segments.clear();
  }
  return reportPages(pictures(report.marked, dialog.namesHidden()), report.studies, session_,
                     dialog.namesHidden());
}

void KeyImagePages::askWhere(const PictureMakerPtr& pages, const PageLook& look, bool isForPaper) {
  const auto make = [this, pages](const PictureSink& sink) { run({tr("Making pages"), pages, sink}); };
  if (isForPaper)
    return askForPrinter("pagesPrintDialog", nullptr,
                         [=](const auto& printer) { make(printedPages(printer, look)); });
  askForPath({"pagesFileDialog", tr("Save the report"), tr("PDF documents (*.pdf)"), tr("report.pdf"),
              QFileDialog::AnyFile, QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation)},
             [=](const QString& path) { make(pdfPages(path, tr("Report"), look)); });
}

}  // namespace

std::unique_ptr<Feature> makeKeyImagePages(Workbench& bench) {
  return std::make_unique<KeyImagePages>(bench);
}

}  // namespace volumen
