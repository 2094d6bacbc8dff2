// Tasks of tasks.md: showing images to a colleague, and a teaching file.
#include <QCheckBox>
#include <QClipboard>
#include <QPrintDialog>
#include <QPushButton>
#include <QTemporaryDir>
#include <QUrl>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/hand.h"
#include "tests/ui/measure_window.h"

namespace volumen::tests {

namespace {

// A drawn slice that has the keyboard focus.
struct Showing {
  QTemporaryDir folder;
  MeasureWindow w;
  Hand hand{w.window};

  Showing() { w.view()->setFocus(); }
  bool isDrawn() {
    return QTest::qWaitFor([this] { return !w.view()->picture().isNull(); }, longest);
  }
  QString path(const char* name) { return folder.filePath(QLatin1String(name)); }
};

int copyPicture() {
  Showing s;
  DONE(s.isDrawn());
  QGuiApplication::clipboard()->clear();
  s.hand.key(Qt::Key_C, Qt::ControlModifier);
  DONE(s.hand.steps() == 1 && QGuiApplication::clipboard()->image().size() == s.w.view()->pixels());
  return s.hand.steps();
}

int savePictureWithoutNames() {
  Showing s;
  DONE(s.isDrawn());
  s.hand.menu({"viewMenu"}, "hideNames");
  s.hand.key(Qt::Key_E, Qt::ControlModifier);
  s.hand.answer(s.path("slice.png"));
  SOON(QFile::exists(s.path("slice.png")));
  DONE(s.w.session().preferences().hideNames);
  s.w.session().prefer([](Preferences& p) { p.hideNames = false; });
  return s.hand.steps();
}

int keyImagePages() {
  Showing s;
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  for (int n = 0; n < 32; ++n) {
    series->series.sopInstanceUids.push_back(series->series.id + "." + std::to_string(n));
    series->series.frames.push_back(0);
  }
  s.w.session().show(series);
  s.w.session().setFocus(axialViewId);
  s.w.view()->setFocus();
  s.hand.key(Qt::Key_K);
  DONE(s.w.session().workspace().keyImages.size() == 1);
  s.hand.menu({"fileMenu", "picturesMenu"}, "keyImagePages");
  auto* pdf = s.w.child<QPushButton>("pagesPdf");
  DONE(pdf);
  s.hand.click(pdf);
  s.hand.answer(s.path("keys.pdf"));
  SOON(QFileInfo(s.path("keys.pdf")).size() > 0);
  return s.hand.steps();
}

int saveAndRestore() {
  Journey w({QStringLiteral("phantom:sphere:32")});
  DONE(w.settle());
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("state.volumen"));
  const Scene before = w.window.session().scene();
  Hand hand(w.window);
  hand.key(Qt::Key_S, Qt::ControlModifier);
  hand.answer(path);
  SOON(QFile::exists(path));
  w.after("viewRight");
  DONE(!(w.window.session().scene() == before));
  QMimeData files;
  files.setUrls({QUrl::fromLocalFile(path)});
  hand.drop(files, &w.window);
  SOON(w.window.session().scene() == before);
  return hand.steps();
}

int printTrueSize() {
  Showing s;
  DONE(s.isDrawn());
  s.hand.key(Qt::Key_P, Qt::ControlModifier);
  auto* dialog = s.w.child<QPrintDialog>("printDialog");
  DONE(dialog);
  // The file stands for the printer.
  dialog->findChild<QLineEdit*>(QStringLiteral("filename"))->setText(s.path("slice.pdf"));
  auto* box = dialog->findChild<QCheckBox*>(QStringLiteral("printTrueSize"));
  QCoreApplication::processEvents();
  s.hand.click(box, {8, box->height() / 2.0});
  DONE(dialog->findChild<QCheckBox*>(QStringLiteral("printTrueSize"))->isChecked());
  s.hand.keyOn(dialog, Qt::Key_Return);
  SOON(QFileInfo(s.path("slice.pdf")).size() > 0);
  return s.hand.steps();
}

int undoAStep() {
  Showing s;
  s.w.draw(ShapeKind::length, {{60, 60}, {120, 90}});
  s.hand.key(Qt::Key_Z, Qt::ControlModifier);
  DONE(s.w.all().empty());
  return s.hand.steps();
}

}  // namespace

std::vector<Task> showingTasks() {
  return {{38, copyPicture},    {39, savePictureWithoutNames}, {40, keyImagePages},
          {41, saveAndRestore}, {42, printTrueSize},           {43, undoAStep}};
}

}  // namespace volumen::tests
