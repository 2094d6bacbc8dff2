#include <QCheckBox>
#include <QPainter>
#include <QPointer>
#include <QPrintDialog>
#include <QPrinter>
#include <QVBoxLayout>

#include "ui/features/feature.h"
#include "ui/overlays/printed_page.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

constexpr int factor = 3;  // pixels of a slice on paper for each on screen

// The view in focus on paper, as it is seen: slices and frames finer than on screen, and in true size where
// wanted.
class Printing : public Feature {
 public:
  explicit Printing(Workbench& bench);

 private:
  void ask();
  void print(const std::shared_ptr<QPrinter>& printer, bool inTrueSize);
  void printOn(const std::shared_ptr<QPrinter>& printer, const PrintedPicture& printed);

  JobLane drawing_{&bench_.document.jobs};
};

Printing::Printing(Workbench& bench) : Feature(bench) {
  bench_.addAction({"printPicture",
                    tr("Print picture..."),
                    {QKeySequence::Print},
                    "",
                    false,
                    [this](bool) { ask(); },
                    {{"fileMenu", 50, 20}}});
}

void Printing::ask() {
  if (session_.workspace().series.empty()) return warn(tr("Open a series first."));
  const auto printer = std::make_shared<QPrinter>(QPrinter::HighResolution);
  const auto* flat = qobject_cast<FlatView*>(grid_.viewShown());
  const QString word = flat ? flat->lengthsWord() : QString();
  auto* trueSize = new QCheckBox(word.isEmpty() ? tr("True size: 1 mm of the patient is 1 mm on paper")
                                                : tr("True size: 1 mm (%1) is 1 mm on paper").arg(word));
  trueSize->setObjectName(QStringLiteral("printTrueSize"));
  trueSize->setEnabled(flat && flat->shown() && flat->overlays().mmPerPixel > 0);
  auto* page = new QWidget;
  page->setWindowTitle(tr("Picture"));
  (new QVBoxLayout(page))->addWidget(trueSize);
  auto* dialog = new QPrintDialog(printer.get(), bench_.dialogParent());
  dialog->setObjectName(QStringLiteral("printDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setOptionTabs({page});
  connect(dialog, &QDialog::accepted, this,
          [this, printer, trueSize] { print(printer, trueSize->isChecked()); });
  connect(dialog, &QObject::destroyed, this, [printer] {});  // which it uses until then
  dialog->open();
}

void Printing::print(const std::shared_ptr<QPrinter>& printer, bool inTrueSize) {
  View* view = grid_.viewShown();
  const QPointer<FlatView> flat = qobject_cast<FlatView*>(view);
  const auto request = flat ? flat->requestFor(factor * flat->pixels()) : std::nullopt;
  if (!request) return printOn(printer, {view->capture(), {}});
  drawing_.run(
      tr("Printing"), [request](const Job&) { return drawSlice(*request); },
      [this, flat, printer, inTrueSize, request](Result<QImage> drawn) {
        if (!drawn) return warn(QString::fromStdString(drawn.message()));
        if (!flat) return;
        const auto mm = inTrueSize ? std::optional(request->plane.mmPerPixel) : std::nullopt;
        printOn(printer, {flat->captureWith(*std::move(drawn)), mm});
      });
}

void Printing::printOn(const std::shared_ptr<QPrinter>& printer, const PrintedPicture& printed) {
  const QSizeF paperMm = printer->pageRect(QPrinter::Millimeter).size();
  QPainter painter;
  if (!painter.begin(printer.get())) return warn(tr("The printer or its file cannot be written to."));
  paintPage(painter, printed, paperMm, printer->resolution() / 25.4);
  if (!painter.end()) return warn(tr("The printer or its file cannot be written to."));
  const QRectF paper(QPointF(0, 0), paperMm);
  tell(paper.contains(placeOnPaper(printed, paperMm))
           ? tr("Printed")
           : tr("Printed: in true size only the middle fits on the paper"));
}

}  // namespace

std::unique_ptr<Feature> makePrinting(Workbench& bench) { return std::make_unique<Printing>(bench); }

}  // namespace volumen
