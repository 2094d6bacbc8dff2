#include <QCheckBox>
#include <QMessageBox>
#include <QPrinter>
#include <QPushButton>

#include "results/text/series_text.h"
#include "results/text/text.h"
#include "ui/exports/flat_pictures.h"
#include "ui/exports/views_picture.h"
#include "ui/features/exporting.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

constexpr int factor = 3;  // pixels of a slice on paper per screen pixel

using PrinterPtr = std::shared_ptr<QPrinter>;

// The view to print, as it was at the time of the request.
struct Seen {
  PictureLabel label;
  PictureMakerPtr screen;             // set for 3D views
  std::optional<PictureStop> stop{};  // set for slices and frames
  PictureLook look{};                 // of `stop`
  std::optional<QSizeF> mm{};         // size of the visible part, if calibrated
  QString lengthsWord{};
};

// Prints the view in focus on one page below patient and study. Slices and frames are finer than on screen
// and can be in true size.
class Printing : public ExportFeature {
 public:
  explicit Printing(Workbench& bench);

 private:
  Seen seenIn(View& view) const;
  void ask();
  void print(const PrinterPtr& printer, Seen seen, const std::optional<QSizeF>& trueMm);
  void askBeforeCropping(const PrinterPtr& printer, const Seen& seen, QSizeF mm);
};

QString sizeText(QSizeF mm) {
  return QStringLiteral("%1 x %2 mm").arg(mm.width(), 0, 'f', 0).arg(mm.height(), 0, 'f', 0);
}

Printing::Printing(Workbench& bench) : ExportFeature(bench, tr("a page that is being printed")) {
  bench_.addAction({"printPicture",
                    tr("Print picture..."),
                    {QKeySequence::Print},
                    "",
                    false,
                    [this](bool) { ask(); },
                    {{"fileMenu", 50, 20}}});
}

Seen Printing::seenIn(View& view) const {
  Seen seen;
  if (const Series* series = seriesIn(session_.workspace(), view.id()))
    seen.label = {pageHead(*series), seriesText(*series)};
  const auto* flat = qobject_cast<FlatView*>(&view);
  if (!flat || !flat->shown()) {
    seen.screen = viewsPicture({&view}, session_, [&view, label = seen.label] {
      return MadePicture{view.capture(), {}, label};
    });
    return seen;
  }
  seen.stop = heldNow({session_.workspace(), flat->id()}, session_);
  seen.look.size = PictureLook::Size::wide;
  seen.look.edge = factor * flat->pixels().width();
  seen.look.seen = flat->size();
  seen.look.namesHidden = namesHidden();
  const Overlays overlays = flat->overlays();
  seen.lengthsWord = overlays.lengthsWord;
  const SlicePlane plane = *flat->plane();
  if (overlays.mmPerPixel > 0) seen.mm = QSizeF(plane.size.x, plane.size.y) * plane.mmPerPixel;
  return seen;
}

void Printing::ask() {
  if (session_.workspace().series.empty()) return warn(tr("Open a series first."));
  const Seen seen = seenIn(*grid_.viewShown());
  auto* trueSize = new QCheckBox(seen.lengthsWord.isEmpty()
                                     ? tr("True size: 1 mm of the patient is 1 mm on paper")
                                     : tr("True size: 1 mm (%1) is 1 mm on paper").arg(seen.lengthsWord));
  trueSize->setObjectName(QStringLiteral("printTrueSize"));
  trueSize->setEnabled(seen.mm.has_value());
  askForPrinter("printDialog", trueSize, [this, seen, trueSize](const PrinterPtr& printer) {
    if (!trueSize->isChecked()) return print(printer, seen, {});
    const QSizeF paperMm = printer->pageLayout().paintRect(QPageLayout::Millimeter).size();
    const QSizeF mm = seen.mm->boundedTo(roomOfPage(seen.label.head, paperMm));
    mm == *seen.mm ? print(printer, seen, mm) : askBeforeCropping(printer, seen, mm);
  });
}

// In true size, lays the picture out for the page, so that letters, texts and scale are inside the printed
// part.
void Printing::print(const PrinterPtr& printer, Seen seen, const std::optional<QSizeF>& trueMm) {
  if (trueMm && trueMm != seen.mm)
    seen.label.caption =
        tr("%1, the middle: %2 of %3").arg(seen.label.caption, sizeText(*trueMm), sizeText(*seen.mm));
  if (trueMm) seen.look.size = PictureLook::Size::paper, seen.look.mm = *trueMm;
  if (seen.stop) seen.stop->label = seen.label;
  run({tr("Printing"), seen.stop ? flatPictures(grid_, {*seen.stop}, seen.look) : seen.screen,
       printedPages(printer, {1, trueMm.has_value()})});
}

void Printing::askBeforeCropping(const PrinterPtr& printer, const Seen& seen, QSizeF mm) {
  auto* box = new QMessageBox(QMessageBox::Question, QStringLiteral("volumen"),
                              tr("Print only the middle of the picture?"), QMessageBox::Cancel,
                              bench_.dialogParent());
  box->setObjectName(QStringLiteral("cropBox"));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextFormat(Qt::PlainText);
  box->setInformativeText(tr("In true size %1 of %2 fit on the paper: the edges are left out.")
                              .arg(sizeText(mm), sizeText(*seen.mm)));
  connect(box->addButton(tr("Print the middle"), QMessageBox::AcceptRole), &QPushButton::clicked, this,
          [this, printer, seen, mm] { print(printer, seen, mm); });
  box->open();
}

}  // namespace

std::unique_ptr<Feature> makePrinting(Workbench& bench) { return std::make_unique<Printing>(bench); }

}  // namespace volumen
