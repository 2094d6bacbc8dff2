#include <QCoreApplication>

#include "tests/unit/suite.h"

int main(int argc, char** argv) {
  const QCoreApplication app(argc, argv);
  return volumen::tests::runSuite(argc, argv);
}
