#pragma once

#include <QTemporaryDir>

#include "io/files/write_volume.h"
#include "tests/fixtures/ct_with_table.h"
#include "tests/ui/journey.h"

namespace volumen::tests {

/// A folder with a CT, ct.nrrd, in which windows save and open sessions.
class SessionFolder {
 public:
  SessionFolder() { (void)writeVolume(*CtWithTable::volume(true), ct().toStdString()); }

  QString at(const char* name) const { return dir_.filePath(QLatin1String(name)); }
  QString ct() const { return at("ct.nrrd"); }

  /// Returns true once the file is written.
  bool save(Journey& w, const char* name = "s.volumen") const {
    w.child<QAction>("saveSessionAs")->trigger();
    answer(w, "saveSessionDialog", at(name));
    return QTest::qWaitFor([&] { return w.window.windowTitle().contains(QLatin1String(name)); }, longest);
  }
  /// Returns true once the picture at rest of the session is on screen.
  bool open(Journey& w, const char* name = "s.volumen") const {
    // Pictures of the previous contents may arrive until then.
    bool drawn = false;
    QObject context;
    QObject::connect(&w.window, &MainWindow::settled, &context,
                     [&] { drawn |= w.window.windowTitle().contains(QLatin1String(name)); });
    w.child<QAction>("openSession")->trigger();
    answer(w, "openSessionDialog", at(name));
    return QTest::qWaitFor([&] { return drawn; }, longest);
  }

 private:
  QTemporaryDir dir_;
};

/// Returns whether a picture at rest follows `act`.
inline bool settles(Journey& w, const std::function<void()>& act) { return !w.after(act).isNull(); }

}  // namespace volumen::tests
