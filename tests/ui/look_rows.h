#pragma once

#include <memory>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/looks_window.h"
#include "tests/ui/window_flaws.h"
#include "tests/unit/suite.h"

namespace volumen::tests {

/// Acts in a window and takes screenshots.
using Look = void (*)(LooksWindow& w);

}  // namespace volumen::tests

Q_DECLARE_METATYPE(volumen::tests::Look)

namespace volumen::tests {

/// A test class whose rows look at real data, opened as the first row of those data opened them.
class LookRows : public CleanSettings {
 protected:
  /// Adds columns: the paths of a row, separated by ";", and its actions.
  static void addColumns() {
    QTest::addColumn<QString>("data");
    QTest::addColumn<Look>("look");
  }
  void lookAtRow();
  void closeWindow() { window_.reset(); }

 private:
  std::unique_ptr<LooksWindow> window_;
  QString opened_;
  int firstStep_ = 0;
};

inline void LookRows::lookAtRow() {
  QFETCH(QString, data);
  QFETCH(Look, look);
  if (opened_ != data) {
    QStringList paths;
    for (const QString& name : data.split(QLatin1Char(';'))) {
      const std::string path = dataPath(name.toStdString());
      NEED_DATA(path);
      paths << QString::fromStdString(path);
    }
    openAlone(false);
    window_.reset();
    window_ = std::make_unique<LooksWindow>(paths);
    QVERIFY(window_->open());
    opened_ = data;
    firstStep_ = window_->steps();
  }
  window_->begin();
  look(*window_);
  QCoreApplication::processEvents();
  const QStringList found = flaws(window_->window);
  window_->take("windowTool");
  window_->session().undoStack().setIndex(firstStep_);
  QVERIFY(window_->idle());
  QVERIFY2(found.isEmpty(), qPrintable(found.join(QLatin1Char('\n'))));
}

/// Paints a ball with the brush by one click.
inline void paintBall(LooksWindow& w, glm::dvec3 p, double mm) {
  w.session().prefer([mm](Preferences& preferences) { preferences.brush = {true, mm}; });
  w.take("paintTool");
  w.stroke({w.showPlace(p)});
  QVERIFY(w.idle());
}

}  // namespace volumen::tests
