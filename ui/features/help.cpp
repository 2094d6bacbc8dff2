#include <QMessageBox>

#include "io/worker/worker.h"
#include "ui/features/feature.h"
#include "ui/views/canvas.h"
#include "ui/views/volume_view.h"
#include "ui/widgets/documents_window.h"

namespace volumen {

namespace {

// Keys, documents, and what this program is.
class Help : public Feature {
 public:
  explicit Help(Workbench& bench);

 private:
  void showAbout();
  void showShortcuts();
};

Help::Help(Workbench& bench) : Feature(bench) {
  const std::vector<Workbench::ActionEntry> table{
      {"documentation",
       tr("Documentation"),
       {QKeySequence::HelpContents},
       "",
       false,
       [this](bool) { (new DocumentsWindow(&bench_.window))->show(); },
       {{"helpMenu"}}},
      {"shortcuts",
       tr("Mouse and keys"),
       {tr("?")},
       "help",
       false,
       [this](bool) { showShortcuts(); },
       {{"helpMenu"}, {"toolBar", 30, toolBarGap + 20}}},
      {"about", tr("About volumen"), {}, "", false, [this](bool) { showAbout(); }, {{"helpMenu"}}}};
  for (const Workbench::ActionEntry& entry : table) bench_.addAction(entry);
}

void Help::showAbout() {
  const QString reading =
      worker::isolating() ? tr("Files are read in separate processes: no network, no writing, memory and "
                               "time limited. Only samples "
                               "that are not compressed, scenes and sessions are read by the program itself.")
                          : tr("Files are read by the program itself: separate processes for that are not "
                               "possible here, or not "
                               "wanted (--in-process).");
  auto* box =
      new QMessageBox(QMessageBox::NoIcon, tr("About volumen"),
                      tr("<h3>volumen %1</h3><p>A DICOM workstation without a GPU.</p>"
                         "<p><b>Not for clinical use.</b></p>"
                         "<p>Free software under the GNU General Public License, version 3 or later.</p>"
                         "<p>Qt %2. Pictures are shown through: %3.</p><p>%4</p>")
                          .arg(QStringLiteral(VOLUMEN_VERSION), QLatin1String(qVersion()),
                               canvasKind(bench_.view()->canvas()), reading),
                      QMessageBox::Close, &bench_.window);
  box->setObjectName(QStringLiteral("aboutBox"));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setModal(false);
  box->show();
}

void Help::showShortcuts() {
  const QStringList rows{
      tr("Left drag"),
      tr("the chosen tool: rotate (Ctrl: roll), or adjust the curve: up and down shift it, left and right "
         "change its width (Ctrl: overall opacity)"),
      tr("Middle, right, Shift+left drag"),
      tr("pan, zoom, pan (Edit > Preferences changes them)"),
      tr("Wheel"),
      tr("zoom at the cursor"),
      tr("Double-click, F10"),
      tr("maximise the view and back (Esc: back)"),
      tr("Arrow keys"),
      tr("rotate by 5 degrees (Shift: 1)"),
      tr("A, P, L, R, S, I"),
      tr("anterior, posterior, left, right, superior, inferior view"),
      tr("Keypad 1, 3, 7"),
      tr("anterior, left, superior view (Ctrl: the opposite one)"),
      tr("F, keypad 0"),
      tr("reset the view"),
      tr("T, W"),
      tr("tools: rotate, adjust curve (W/L; in projections the window, Shift: fine, Ctrl: fast)"),
      tr("X"),
      tr("scissors: draw around what is cut away (Ctrl: around what stays), Esc gives up"),
      tr("Right click in a 3D view"),
      tr("tools, and in the layouts of two and four what the view shows"),
      tr("In the curve"),
      tr("double-click adds a point, right-click or Delete removes it, arrow keys nudge it, Tab goes to the "
         "next, the wheel zooms the value axis, Home shows all of it"),
      tr("In a slice"),
      tr("left drag changes the window (Shift: fine, Ctrl: fast), middle pans, right zooms, the wheel "
         "scrolls (Ctrl: zooms, "
         "Alt: slab), Shift moves the crosshair, 0 to 9 choose a window, I inverts, a right click opens a "
         "menu, Esc gives up a drag"),
      tr("On its lines"),
      tr("a drag moves that plane; the round handle turns the other planes; F puts them straight"),
      tr("Ctrl+R, Ctrl+Shift+R, Ctrl+H, Ctrl+Shift+H"),
      tr("turn the picture of the view in focus right, left; mirror it left to right, top to bottom"),
      tr("F, O, Shift+O"),
      tr("all of it in the view; a pixel of the picture a pixel of the screen; true size"),
      tr("C"),
      tr("plays the frames of the view in focus, and stops"),
      tr("K, comma, full stop"),
      tr("marks the picture shown as a key image, or takes the mark off; goes to the key image before, and "
         "to "
         "the next"),
      tr("D, A, E, P, T in a slice"),
      tr("measure: length, angle, ellipse, probe, arrow with text; the tool before comes back after one "
         "measurement (Shift keeps it), Enter or a double-click ends a polyline, Esc gives up, Delete "
         "removes what is selected, W changes the window again"),
      tr("Alt+1 to Alt+5"),
      tr("layouts: one view, planes and 3D, large 3D beside planes, two or four series"),
      tr("Ctrl+Z, Ctrl+Shift+Z"),
      tr("undo, redo"),
      tr("Ctrl+B, Ctrl+F, Ctrl+I"),
      tr("the studies on this computer: show or hide them, search them, import a folder (in the list: Enter "
         "opens, Ctrl+Enter opens beside, Delete removes from the list)"),
      tr("Ctrl+O, Ctrl+S"),
      tr("open a folder, save the session"),
      tr("Ctrl+E, Ctrl+C, Ctrl+P, Ctrl+Shift+C"),
      tr("save, copy, print the picture of the view in focus as it is seen; copy all views"),
      tr("Ctrl+Shift+E"),
      tr("save a snapshot of the 3D picture at any size and quality"),
  };
  QString html = QStringLiteral("<table cellpadding='3' width='640'>");
  for (int n = 0; n + 1 < rows.size(); n += 2)
    html += QStringLiteral("<tr><td><b>%1</b></td><td>%2</td></tr>").arg(rows[n], rows[n + 1]);
  auto* box = new QMessageBox(QMessageBox::NoIcon, tr("Mouse and keys"), html + QStringLiteral("</table>"),
                              QMessageBox::Close, &bench_.window);
  box->setObjectName(QStringLiteral("shortcutsBox"));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setModal(false);
  box->show();
}

}  // namespace

std::unique_ptr<Feature> makeHelp(Workbench& bench) { return std::make_unique<Help>(bench); }

}  // namespace volumen
