#include <QCoreApplication>

#include "io/worker/worker.h"
#include "tests/unit/suite.h"

int main(int argc, char** argv) {
  if (!volumen::worker::start()) return 1;
  const QCoreApplication app(argc, argv);
  return volumen::tests::runSuite(argc, argv);
}
