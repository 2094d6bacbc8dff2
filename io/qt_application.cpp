#include "io/qt_application.h"

#include <QCoreApplication>

namespace volumen {

void needQtApplication() {
  if (QCoreApplication::instance()) return;
  static int argc = 1;
  static char name[] = "volumen";
  static char* argv[] = {name, nullptr};
  static const QCoreApplication application(argc, argv);
}

}  // namespace volumen
