#pragma once

#include <QClipboard>
#include <QDirIterator>
#include <QPrintDialog>
#include <vector>

#include "tests/ui/picture_window.h"
#include "ui/panels/pages_dialog.h"

namespace volumen::tests {

/// One way in which pictures leave a window: the request, and the last dialog that asks where to.
struct Leaving {
  const char* name;
  void (*ask)(Journey& w);
  const char* dialog = "";      ///< empty: they go to the clipboard
  const char* ending = ".png";  ///< of the file; empty: a folder
  QRectF part{0, 0, 1, 1};      ///< the part of a picture without the time that 3D took
};

/// Returns this file, or all files in and below this folder.
inline QStringList filesAt(const QString& path) {
  if (!QFileInfo(path).isDir()) return {path};
  QStringList files;
  for (QDirIterator each(path, QDir::Files, QDirIterator::Subdirectories); each.hasNext();)
    files << each.next();
  files.sort();
  return files;
}

inline void run(Journey& w, const char* action) { w.child<QAction>(action)->trigger(); }

inline void runIn3D(Journey& w, const char* action) {
  w.window.session().setFocus(sceneViewId);
  run(w, action);
}

/// Runs an action while the 3D picture is still being drawn.
inline void runInTurned3D(Journey& w, const char* action) {
  run(w, "viewLeft");
  runIn3D(w, action);
}

inline void askForKeyImages(Journey& w, const char* button) {
  run(w, "keyImagePages");
  for (auto* dialog : w.window.findChildren<PagesDialog*>())
    if (dialog->isVisible())
      QTest::mouseClick(dialog->findChild<QWidget*>(QLatin1String(button)), Qt::LeftButton);
}

/// Asks for pictures of a stack with these values of the dialog's fields.
inline void askForStack(Journey& w, const char* action,
                        const std::vector<std::pair<const char*, int>>& fields) {
  PictureDialog* dialog = ask(w, action);
  for (const auto& [field, value] : fields) set(dialog, field, value);
  accept(dialog);
}

/// Returns all ways.
inline const std::vector<Leaving>& waysOut() {
  constexpr QRectF upperHalf(0, 0, 1, 0.5), firstView(0, 0, 0.5, 0.5);
  static const std::vector<Leaving> ways{
      {"slice to a file", [](Journey& w) { run(w, "savePicture"); }, "pictureDialog"},
      {"slice to the clipboard", [](Journey& w) { run(w, "copyPicture"); }},
      {"slice to paper", [](Journey& w) { run(w, "printPicture"); }, "printDialog", ".pdf"},
      {"slice to paper in true size",
       [](Journey& w) {
         run(w, "printPicture");
         w.child<QCheckBox>("printTrueSize")->setChecked(true);
       },
       "printDialog", ".pdf"},
      {"slice of any size to a file", [](Journey& w) { accept(ask(w, "saveSizedPicture")); },
       "pictureFilesDialog"},
      {"stack to a folder",
       [](Journey& w) {
         askForStack(w, "saveStack", {{"pictureLast", 2}});
       },
       "pictureFilesDialog", ""},
      {"contact sheet to a file",
       [](Journey& w) {
         askForStack(w, "saveSheet", {{"sheetRows", 1}, {"sheetColumns", 1}});
       },
       "pictureFilesDialog"},
      {"key images to a PDF", [](Journey& w) { askForKeyImages(w, "pagesPdf"); }, "pagesFileDialog", ".pdf"},
      {"key images to paper", [](Journey& w) { askForKeyImages(w, "pagesPrint"); }, "pagesPrintDialog",
       ".pdf"},
      {"3D to a file", [](Journey& w) { runIn3D(w, "savePicture"); }, "pictureDialog", ".png", upperHalf},
      {"3D to the clipboard", [](Journey& w) { runIn3D(w, "copyPicture"); }, "", ".png", upperHalf},
      {"3D to paper", [](Journey& w) { runIn3D(w, "printPicture"); }, "printDialog", ".pdf", upperHalf},
      {"3D that is drawn to a file", [](Journey& w) { runInTurned3D(w, "savePicture"); }, "pictureDialog",
       ".png", upperHalf},
      {"3D that is drawn to the clipboard", [](Journey& w) { runInTurned3D(w, "copyPicture"); }, "", ".png",
       upperHalf},
      {"3D that is drawn to paper", [](Journey& w) { runInTurned3D(w, "printPicture"); }, "printDialog",
       ".pdf", upperHalf},
      {"all views to a file", [](Journey& w) { run(w, "saveAllPictures"); }, "pictureDialog", ".png",
       firstView},
      {"all views to the clipboard", [](Journey& w) { run(w, "copyAllPictures"); }, "", ".png", firstView},
      {"snapshot to a file", [](Journey& w) { run(w, "snapshot"); }, "snapshotDialog"},
      {"snapshot to the clipboard", [](Journey& w) { run(w, "copySnapshot"); }},
      {"turntable to a folder",
       [](Journey& w) {
         w.child<QSpinBox>("turntablePictures")->setValue(2);
         QTest::mouseClick(w.child<QWidget>("turntableSave"), Qt::LeftButton);
       },
       "turntableDialog", ""}};
  return ways;
}

inline const Leaving& wayOut(const QString& name) {
  return *std::ranges::find_if(waysOut(),
                               [&](const Leaving& way) { return name == QLatin1String(way.name); });
}

/// Answers the last dialog of a request. The folder of a way that needs one is made.
inline void answerWhere(Journey& w, const Leaving& way, const QString& path) {
  if (!*way.ending) QDir().mkdir(path);
  if (auto* dialog = w.window.findChild<QPrintDialog*>(QLatin1String(way.dialog))) {
    dialog->findChild<QLineEdit*>(QStringLiteral("filename"))->setText(path);
    dialog->accept();
  } else if (*way.dialog) {
    answer(w, way.dialog, path);
  }
}

}  // namespace volumen::tests
