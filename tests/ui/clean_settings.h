#pragma once

#include <QObject>

namespace volumen::tests {

/// A test class whose functions each begin and end without settings, except for layouts (openAlone).
class CleanSettings : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void cleanup();
};

}  // namespace volumen::tests
