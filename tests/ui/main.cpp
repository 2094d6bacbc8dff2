#include <QApplication>
#include <QDir>
#include <QTemporaryDir>

#include "tests/ui/journey.h"
#include "tests/ui/watchdog.h"
#include "tests/unit/suite.h"
#include "ui/british.h"
#include "ui/controller/autosave.h"

int main(int argc, char** argv) {
  // Keeps settings and caches apart from the user's own and from those of tests running in parallel. A test
  // that starts this program again shares its own.
  const QTemporaryDir own;
  const QByteArray shared = qgetenv("VOLUMEN_TEST_HOME");
  for (const char* folder : {"XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME"})
    qputenv(folder, shared.isEmpty() ? own.path().toLocal8Bit() : shared);
  volumen::tests::WatchedApplication app(argc, argv);
  volumen::tests::openAlone();
  volumen::speakBritish(app);
  return volumen::tests::runSuite(argc, argv, [&] {
    if (shared.isEmpty()) QDir(volumen::Autosave::folder()).removeRecursively();
  });
}
