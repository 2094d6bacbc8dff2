// An addition: a feature with its own action.
#include "ui/features/feature.h"

namespace volumen {

namespace {

class Greeting : public Feature {
 public:
  explicit Greeting(Workbench& bench) : Feature(bench) {
    bench_.addAction({"greet",
                      tr("Greet"),
                      {tr("Ctrl+G")},
                      "",
                      false,
                      [this](bool) { tell(tr("Good morning")); },
                      {{"helpMenu", 0, -1}}});
  }
};

}  // namespace

std::unique_ptr<Feature> makeGreeting(Workbench& bench) { return std::make_unique<Greeting>(bench); }

}  // namespace volumen
