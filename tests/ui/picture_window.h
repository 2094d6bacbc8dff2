#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>
#include <QSpinBox>

#include "tests/ui/journey.h"
#include "ui/panels/picture_dialog.h"
#include "ui/views/view_grid.h"

namespace volumen::tests {

/// Entries of the size box, in its order.
enum Size { asSeen, own, wide };

inline QImage rgb(const QImage& image) { return image.convertToFormat(QImage::Format_RGB32); }

/// Opens the dialog of an action.
inline PictureDialog* ask(Journey& w, const char* action) {
  w.child<QAction>(action)->trigger();
  for (auto* dialog : w.window.findChildren<PictureDialog*>())
    if (dialog->isVisible()) return dialog;
  return nullptr;
}

inline void set(QDialog* dialog, const char* spin, int value) {
  dialog->findChild<QSpinBox*>(QLatin1String(spin))->setValue(value);
}

inline void tick(QDialog* dialog, const char* box, bool on) {
  dialog->findChild<QCheckBox*>(QLatin1String(box))->setChecked(on);
}

inline void accept(QDialog* dialog) {
  QTest::mouseClick(dialog->findChild<QPushButton*>(QStringLiteral("pictureSave")), Qt::LeftButton);
}

/// Returns the image in a file once the file exists.
inline QImage written(const QString& path) {
  return QTest::qWaitFor([&] { return QFile::exists(path); }, longest) ? rgb(QImage(path)) : QImage();
}

inline QImage saved(Journey& w, const QString& path, Size size, int width, bool texts, bool hidden = false) {
  PictureDialog* dialog = ask(w, "saveSizedPicture");
  dialog->findChild<QComboBox*>(QStringLiteral("pictureSize"))->setCurrentIndex(size);
  if (size == wide) set(dialog, "pictureWidth", width);
  tick(dialog, "pictureTexts", texts);
  tick(dialog, "pictureHideNames", hidden);
  accept(dialog);
  answer(w, "pictureFilesDialog", path);
  const QImage image = written(path);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  return image;
}

/// Returns the slice without texts, which replaces the picture on screen if texts are left out.
inline QImage plain(const FlatView& view, QSize pixels) {
  const auto drawn = drawSlice(*view.requestFor(pixels));
  return drawn ? rgb(*drawn) : QImage();
}

inline void goTo(FlatView* view, int place) { view->scroll(place - view->stack().place.index); }

/// Scrolls to the slice with this number, as the corner text shows it.
inline bool showNumber(FlatView* view, int number) {
  for (int place = 0; place < view->stack().place.count; ++place) {
    goTo(view, place);
    const QStringList lines = view->overlays().topRight;
    if (lines.contains(QStringLiteral("%1 / %2").arg(number).arg(view->stack().place.count))) return true;
  }
  return false;
}

}  // namespace volumen::tests
