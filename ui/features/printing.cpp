#include <QBoxLayout>
#include <QCheckBox>
#include <QMessageBox>
#include <QPrintDialog>
#include <QPrinter>
#include <QPushButton>
#include <algorithm>

#include "ui/features/feature.h"
#include "ui/features/once_drawn.h"
#include "ui/overlays/picture_pages.h"
#include "ui/views/picture_run.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

constexpr int factor = 3;  // pixels of a slice on paper per screen pixel

using PrinterPtr = std::shared_ptr<QPrinter>;

// The view to print, as it was at the time of the request.
struct Seen {
  QStringList head;
  QString caption;
  bool namesHidden = false;
  std::shared_ptr<QImage> picture;    // of a 3D view; a null image until drawn as requested
  std::optional<PictureStop> stop{};  // set for slices and frames
  QSize size{};                       // of the view, in logical pixels
  QSize pixels{};
  std::optional<QSizeF> mm{};  // size of the visible part, if calibrated
  QString lengthsWord{};
};

// Prints the view in focus on one page below patient and study. Slices and frames are finer than on screen
// and can be in true size.
class Printing : public Feature {
 public:
  explicit Printing(Workbench& bench);

  QString unsavedText() const override;

 private:
  Seen seenIn(View& view);
  void ask();
  void askHow(const Seen& seen);
  void print(const PrinterPtr& printer, const Seen& seen, bool inTrueSize);
  void askBeforeCropping(const PrinterPtr& printer, const Seen& seen, QSizeF mm);
  void printInTrueSize(const PrinterPtr& printer, Seen seen, QSizeF mm);
  void run(const PrinterPtr& printer, const Seen& seen, const PictureLook& look);

  JobLane painting_{&bench_.document.jobs};
};

PictureLook lookOf(const Seen& seen) {
  PictureLook look;
  look.size = PictureLook::Size::wide;
  look.edge = factor * seen.pixels.width();
  look.seen = seen.size;
  look.namesHidden = seen.namesHidden;
  return look;
}

Status paint(const PrinterPtr& printer, const Seen& seen, const PagePicture& picture, bool inTrueSize) {
  const PicturePage page{seen.head, {picture}};
  return paintPages(*printer, {1, [&](std::size_t) { return page; }}, {1, inTrueSize});
}

QString sizeText(QSizeF mm) {
  return QStringLiteral("%1 x %2 mm").arg(mm.width(), 0, 'f', 0).arg(mm.height(), 0, 'f', 0);
}

Printing::Printing(Workbench& bench) : Feature(bench) {
  painting_.keepToTheEnd();
  bench_.addAction({"printPicture",
                    tr("Print picture..."),
                    {QKeySequence::Print},
                    "",
                    false,
                    [this](bool) { ask(); },
                    {{"fileMenu", 50, 20}}});
}

QString Printing::unsavedText() const {
  const bool any = std::ranges::any_of(findChildren<PictureRun*>(),
                                       [](const PictureRun* run) { return !run->hasEnded(); });
  return any ? tr("a page that is being printed") : QString();
}

Seen Printing::seenIn(View& view) {
  Seen seen;
  if (const Series* series = seriesIn(session_.workspace(), view.id())) {
    seen.head = pageHead(*series);
    seen.caption = seriesText(*series);
  }
  seen.namesHidden = namesHidden();
  const auto* flat = qobject_cast<FlatView*>(&view);
  if (!flat || !flat->shown()) {
    seen.picture = std::make_shared<QImage>();
    onceDrawn(
        {&view}, session_, this, [picture = seen.picture, &view] { *picture = view.capture(); }, [] {});
    return seen;
  }
  seen.stop = heldNow({session_.workspace(), flat->id()}, session_);
  seen.size = flat->size();
  seen.pixels = flat->pixels();
  seen.lengthsWord = flat->lengthsWord();
  const SlicePlane plane = *flat->plane();
  if (flat->overlays().mmPerPixel > 0) seen.mm = QSizeF(plane.size.x, plane.size.y) * plane.mmPerPixel;
  return seen;
}

void Printing::ask() {
  if (session_.workspace().series.empty()) return warn(tr("Open a series first."));
  askHow(seenIn(*grid_.viewShown()));
}

// Places the true size option beside the printer, not in the collapsed options.
void Printing::askHow(const Seen& seen) {
  const auto printer = std::make_shared<QPrinter>(QPrinter::HighResolution);
  auto* trueSize = new QCheckBox(seen.lengthsWord.isEmpty()
                                     ? tr("True size: 1 mm of the patient is 1 mm on paper")
                                     : tr("True size: 1 mm (%1) is 1 mm on paper").arg(seen.lengthsWord));
  trueSize->setObjectName(QStringLiteral("printTrueSize"));
  trueSize->setEnabled(seen.mm.has_value());
  auto* dialog = new QPrintDialog(printer.get(), bench_.dialogParent());
  dialog->setObjectName(QStringLiteral("printDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  qobject_cast<QBoxLayout*>(dialog->layout())->insertWidget(1, trueSize);
  connect(dialog, &QDialog::accepted, this,
          [this, printer, seen, trueSize] { print(printer, seen, trueSize->isChecked()); });
  connect(dialog, &QObject::destroyed, this, [printer] {});  // the dialog uses the printer until then
  dialog->open();
}

void Printing::print(const PrinterPtr& printer, const Seen& seen, bool inTrueSize) {
  if (inTrueSize) {
    const QSizeF paperMm = printer->pageLayout().paintRect(QPageLayout::Millimeter).size();
    const QSizeF mm = seen.mm->boundedTo(roomOfPage(seen.head, paperMm));
    return mm == *seen.mm ? printInTrueSize(printer, seen, mm) : askBeforeCropping(printer, seen, mm);
  }
  if (seen.stop) return run(printer, seen, lookOf(seen));
  if (seen.picture->isNull()) return warn(tr("The view changed before it was drawn: print it again."));
  painting_.run(
      tr("Printing"),
      [printer, seen](const Job&) {
        return paint(printer, seen, {*seen.picture, {}, seen.caption}, false);
      },
      [this](const Status& painted) {
        painted ? tell(tr("Printed")) : warnUntilDone(QString::fromStdString(painted.message()));
      });
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
          [this, printer, seen, mm] { printInTrueSize(printer, seen, mm); });
  box->open();
}

// Lays the picture out for the page, so that letters, texts and scale are inside the printed part.
void Printing::printInTrueSize(const PrinterPtr& printer, Seen seen, QSizeF mm) {
  if (mm != *seen.mm)
    seen.caption = tr("%1, the middle: %2 of %3").arg(seen.caption, sizeText(mm), sizeText(*seen.mm));
  PictureLook look = lookOf(seen);
  look.size = PictureLook::Size::paper;
  look.mm = mm;
  run(printer, seen, look);
}

void Printing::run(const PrinterPtr& printer, const Seen& seen, const PictureLook& look) {
  auto* run = new PictureRun(grid_, session_, bench_.document.jobs, tr("Printing"), {*seen.stop}, look, this);
  connect(run, &PictureRun::ended, this, [this](const QString& failure) {
    failure.isEmpty() ? tell(tr("Printed")) : warnUntilDone(failure);
  });
  const auto picture = std::make_shared<PagePicture>();
  run->start(
      [picture, caption = seen.caption](std::size_t, const MadePicture& made) {
        *picture = {made.image, made.mmPerPixel, caption, made.lengthsWord};
        return Status();
      },
      [printer, seen, picture, inTrueSize = look.size == PictureLook::Size::paper] {
        return paint(printer, seen, *picture, inTrueSize);
      });
}

}  // namespace

std::unique_ptr<Feature> makePrinting(Workbench& bench) { return std::make_unique<Printing>(bench); }

}  // namespace volumen
