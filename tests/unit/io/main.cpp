#include <QCoreApplication>

#include "io/worker/sandbox.h"
#include "io/worker/worker.h"
#include "tests/unit/suite.h"

/// Files are read in workers as in the program. With sanitizers they are read in this process, which reports
/// what they find.
int main(int argc, char** argv) {
  if (!volumen::worker::sanitized && !volumen::worker::start()) return 1;
  const QCoreApplication app(argc, argv);
  return volumen::tests::runSuite(argc, argv);
}
