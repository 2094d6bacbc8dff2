#include <QCoreApplication>

#include "io/worker/worker.h"
#include "tests/unit/suite.h"

/// With VOLUMEN_WORKERS set, files are read in workers as in the program, else in this process.
int main(int argc, char** argv) {
  if (qEnvironmentVariableIsSet("VOLUMEN_WORKERS") && !volumen::worker::start()) return 1;
  const QCoreApplication app(argc, argv);
  return volumen::tests::runSuite(argc, argv);
}
