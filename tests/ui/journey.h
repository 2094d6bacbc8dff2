#pragma once

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QDir>
#include <QFileDialog>
#include <QLineEdit>
#include <QListView>
#include <QMessageBox>
#include <QSettings>
#include <QSignalSpy>
#include <QTest>
#include <functional>

#include "ui/main_window.h"
#include "ui/views/frame_view.h"
#include "ui/views/view_grid.h"
#include "ui/views/volume_view.h"

namespace volumen::tests {

inline constexpr int longest = 60000;  // ms, for a loaded machine

/// Lets studies open in the 3D view alone, which most tests need. Tests of layouts turn it off.
inline void openAlone(bool alone = true) {
  for (const char* modality : {"CT", "MR", "PT", "other"})
    QSettings().setValue(QStringLiteral("layouts/") + QLatin1String(modality),
                         alone ? QStringLiteral("one") : QString());
}

/// Returns the frame that a view shows; null if there is none.
inline LoadedFramePtr frameIn(const View* view) {
  const auto* frames = qobject_cast<const FrameView*>(view);
  return frames ? frames->frame() : nullptr;
}

/// A window whose pictures are waited for, and saved if $VOLUMEN_SHOTS names a folder.
struct Journey {
  MainWindow window;
  QSignalSpy settled{&window, &MainWindow::settled};

  explicit Journey(const QStringList& paths = {}, const Services& services = realServices())
      : window(services) {
    window.resize(1040, 680);
    window.show();
    // Without a window manager nothing else activates the window, and shortcuts need an active window.
    window.activateWindow();
    QApplication::setActiveWindow(&window);
    if (!paths.isEmpty()) window.open(paths);
  }

  template <class Child>
  Child* child(const char* name) {
    return window.findChild<Child*>(QLatin1String(name));
  }

  bool settle() {
    return QTest::qWaitFor([this] { return settled.count() > 0; }, longest);
  }

  // Does `act` and returns the next picture at rest.
  QImage after(const std::function<void()>& act) {
    settled.clear();
    act();
    return settle() ? window.view()->picture() : QImage();
  }

  QImage after(const char* action) {
    return after([&] { child<QAction>(action)->trigger(); });
  }

  void shot(const char* name) {
    const QString folder = qEnvironmentVariable("VOLUMEN_SHOTS");
    if (!folder.isEmpty())
      window.grab().save(QDir(folder).filePath(QLatin1String(name)) + QStringLiteral(".png"));
  }
};

/// Replaces the suggested path in a file dialog and accepts.
inline void acceptFile(QFileDialog& dialog, const QString& path) {
  // Without the keyboard focus, as in test windows, the suggested file stays selected and would be taken.
  dialog.findChild<QListView*>(QStringLiteral("listView"))->clearSelection();
  auto* name = dialog.findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
  name->setText(path);
  QTest::keyClick(name, Qt::Key_Return);
}

/// Does the same in the open dialog of this name.
inline void answer(Journey& w, const char* dialog, const QString& path) {
  const QLatin1String named(dialog);
  for (QFileDialog* open : w.window.findChildren<QFileDialog*>(named) +
                               w.window.views()->secondWindow().findChildren<QFileDialog*>(named)) {
    if (!open->isVisible()) continue;  // answered before, but not yet deleted
    return acceptFile(*open, path);
  }
  QFAIL("there is no such dialog");
}

/// Confirms that unsaved work is discarded.
inline void discard(Journey& w) {
  auto* box = w.child<QMessageBox>("discardBox");
  QVERIFY(box);
  for (QAbstractButton* button : box->buttons())
    if (button->text() == QStringLiteral("Discard")) return QTest::mouseClick(button, Qt::LeftButton);
  QFAIL("there is no such button");
}

}  // namespace volumen::tests
