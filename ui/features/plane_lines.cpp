#include "ui/features/feature.h"

namespace volumen {

namespace {

// Preferences for the lines of other planes in flat views.
class PlaneLines : public Feature {
 public:
  explicit PlaneLines(Workbench& bench);

 private:
  void add(const char* name, const QString& text, const QList<QKeySequence>& keys, int order,
           bool Preferences::*member);
};

PlaneLines::PlaneLines(Workbench& bench) : Feature(bench) {
  add("crosshairLines", tr("Crosshair lines"), {tr("H")}, 92, &Preferences::crosshairLines);
  add("referenceLines", tr("Reference lines"), {tr("Shift+H")}, 94, &Preferences::referenceLines);
  add("referenceEnds", tr("Reference lines of first and last slices"), {}, 96, &Preferences::referenceEnds);
}

void PlaneLines::add(const char* name, const QString& text, const QList<QKeySequence>& keys, int order,
                     bool Preferences::*member) {
  QAction* action = bench_.addAction({name, text, keys, "", true, {}, {{"viewMenu", 60, order}}});
  action->setChecked(session_.preferences().*member);
  connect(action, &QAction::triggered, this,
          [this, member](bool on) { session_.prefer([&](Preferences& p) { p.*member = on; }); });
  connect(
      &session_, &Session::preferencesChanged, action,
      [action, member](const Preferences&, const Preferences& after) { action->setChecked(after.*member); });
}

}  // namespace

std::unique_ptr<Feature> makePlaneLines(Workbench& bench) { return std::make_unique<PlaneLines>(bench); }

}  // namespace volumen
