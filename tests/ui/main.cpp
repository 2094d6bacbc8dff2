#include <QApplication>
#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>

#include "tests/unit/suite.h"
#include "ui/british.h"

int main(int argc, char** argv) {
  // Settings and caches of the tests stay away from the user's own.
  const QTemporaryDir home;
  qputenv("XDG_CONFIG_HOME", home.path().toLocal8Bit());
  QApplication app(argc, argv);
  volumen::speakBritish(app);
  QStandardPaths::setTestModeEnabled(true);
  return volumen::tests::runSuite(argc, argv);
}
