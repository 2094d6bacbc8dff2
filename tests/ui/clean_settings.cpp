#include "tests/ui/clean_settings.h"

#include "tests/ui/journey.h"

namespace volumen::tests {

void CleanSettings::init() {
  QSettings().clear();
  openAlone();
}

void CleanSettings::cleanup() { init(); }

}  // namespace volumen::tests
