#include <algorithm>

#include "results/text/text.h"
#include "ui/exports/flat_pictures.h"
#include "ui/features/exporting.h"
#include "ui/panels/picture_dialog.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/frame_look.h"
#include "ui/workspace/view_window.h"

namespace volumen {

namespace {

// Exports pictures of the slice or frame in focus: one of any size, its whole stack, or a contact sheet.
class PictureFiles : public ExportFeature {
 public:
  explicit PictureFiles(Workbench& bench);

 private:
  void ask(PicturesOf of);
  void askWhere(PicturesOf of, const PictureMakerPtr& pictures, const SheetLook& sheet, const QString& name);
};

// Returns whether all pictures of the view share one window.
bool sharesWindow(const PictureStop& stop) {
  const ViewState& view = stop.workspace.view(stop.view);
  const SeriesState state = seriesStateIn(stop.workspace, stop.view);
  return !showsFrames(view.kind) || state.window || !hasOwnWindows(state, *state.series);
}

// Returns the sheet with room for `count` pictures.
SheetLook sheetLook(const PictureDialog& dialog, int count, const PictureStop& now) {
  const int columns = std::clamp(count, 1, dialog.columns());
  return {columns, (count + columns - 1) / columns, dialog.withTexts(), sharesWindow(now)};
}

PictureFiles::PictureFiles(Workbench& bench) : ExportFeature(bench) {
  bench_.addMenu("picturesMenu", tr("More pictures"), {{"fileMenu", 50, 30}});
  const auto add = [this](const char* name, const QString& text, PicturesOf of) {
    bench_.addAction({name, text, {}, "", false, [this, of](bool) { ask(of); }, {{"picturesMenu", 10}}});
  };
  add("saveSizedPicture", tr("Picture of any size..."), PicturesOf::view);
  add("saveStack", tr("Stack as pictures..."), PicturesOf::stack);
  add("saveSheet", tr("Contact sheet..."), PicturesOf::sheet);
}

// Uses the view as it is now, whatever happens while dialogs are open.
void PictureFiles::ask(PicturesOf of) {
  if (session_.workspace().series.empty()) return warn(tr("Open a series first."));
  auto* flat = qobject_cast<FlatView*>(grid_.viewShown());
  if (!flat || !flat->shown())
    return warn(tr("Click a slice or a frame first. 3D pictures of any size: File > Save 3D snapshot."));
  auto* dialog = new PictureDialog(of, flat->stack(), flat->size(), bench_.dialogParent());
  const auto accept = [this, of, dialog, shown = flat->shown(),
                       now = heldNow({session_.workspace(), flat->id()}, session_)] {
    std::vector<PictureStop> stops;
    for (const auto& [number, place] : dialog->places()) {
      stops.push_back(now);
      stops.back().workspace = withPlace(now.workspace, now.view, shown, place);
      stops.back().label.number = number;
    }
    if (of == PicturesOf::view) stops = {now};
    const SheetLook sheet = sheetLook(*dialog, int(stops.size()), now);
    const HidingNames hiding(dialog->look().namesHidden);
    askWhere(of, flatPictures(grid_, std::move(stops), dialog->look()), sheet,
             fileName(*seriesIn(now.workspace, now.view)));
  };
  connect(dialog, &QDialog::accepted, this, accept);
  dialog->open();
}

void PictureFiles::askWhere(PicturesOf of, const PictureMakerPtr& pictures, const SheetLook& sheet,
                            const QString& name) {
  PathQuestion question{"pictureFilesDialog", tr("Save the picture"), pictureFilters(),
                        name + QStringLiteral(".png")};
  if (of == PicturesOf::stack)
    question = {"pictureFilesDialog", tr("Put a folder of pictures into"), {}, {}, QFileDialog::Directory};
  askForPath(question, [this, of, pictures, sheet, name](const QString& path) {
    PictureSink sink = of == PicturesOf::stack ? newFolder(path, name) : pictureFile(path);
    if (of == PicturesOf::sheet) sink = contactSheet(sheet, sink);
    run({tr("Saving pictures"), pictures, sink});
  });
}

}  // namespace

std::unique_ptr<Feature> makePictureFiles(Workbench& bench) { return std::make_unique<PictureFiles>(bench); }

}  // namespace volumen
