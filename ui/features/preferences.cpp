#include <QApplication>
#include <QPointer>

#include "ui/features/feature.h"
#include "ui/features/theme.h"
#include "ui/panels/preferences_dialog.h"
#include "ui/widgets/banner.h"

namespace volumen {

namespace {

// Saves the preferences, shows them in a dialog and as actions, and applies the theme.
class PreferencesFeature : public Feature {
 public:
  explicit PreferencesFeature(Workbench& bench);
  ~PreferencesFeature() override { delete dialog_; }  // it uses the lane

 private:
  void makeActions();
  void apply(const Preferences& before, const Preferences& after);
  void showTheme();
  void showDialog();
  void offerArchives();

  QList<QAction*> actions_;  // first the theme, hidden names and the table
  JobLane tests_;            // of archives
  QPointer<PreferencesDialog> dialog_;
};

PreferencesFeature::PreferencesFeature(Workbench& bench) : Feature(bench) {
  makeActions();
  connect(&session_, &Session::preferencesChanged, this, &PreferencesFeature::apply);
  connect(&bench_, &Workbench::made, this, [this] {
    showTheme();
    session_.prefer(storedPreferences());
  });
}

void PreferencesFeature::makeActions() {
  const std::vector<Workbench::ActionEntry> table{
      {"lightTheme",
       tr("Light theme"),
       {},
       "",
       true,
       [this](bool on) {
         session_.prefer([on](Preferences& p) { p.theme = on ? Theme::light : Theme::dark; });
       },
       {{"viewMenu", 60, 30}}},
      {"hideNames",
       tr("Hide names"),
       {},
       "",
       true,
       [this](bool on) { session_.prefer([on](Preferences& p) { p.hideNames = on; }); },
       {{"viewMenu", 60, 40}}},
      {"tableIn3d",
       tr("Show the table in 3D"),
       {},
       "",
       true,
       [this](bool on) { session_.prefer([on](Preferences& p) { p.tableIn3d = on; }); },
       {{"sceneMenu", 30, -10}}},
      {"preferences",
       tr("Preferences..."),
       {tr("Ctrl+,")},
       "",
       false,
       [this](bool) { showDialog(); },
       {{"editMenu", 30}}}};
  for (const Workbench::ActionEntry& entry : table) actions_ << bench_.addAction(entry);
}

void PreferencesFeature::apply(const Preferences& before, const Preferences& after) {
  storePreferences(after);
  if (before.theme != after.theme || before.textPercent != after.textPercent) showTheme();
  const bool areOn[] = {after.theme == Theme::light, after.hideNames, after.tableIn3d};
  for (int n = 0; n < 3; ++n) actions_[n]->setChecked(areOn[n]);
  if (before.hideNames != after.hideNames) bench_.banner.refresh();
}

void PreferencesFeature::showTheme() {
  applyTheme(*qApp, session_.preferences().theme, session_.preferences().textPercent);
  for (const auto& [name, action] : bench_.actions) {
    const QString iconName = action->property("iconName").toString();
    if (!iconName.isEmpty()) action->setIcon(icon(iconName));
  }
}

void PreferencesFeature::showDialog() {
  if (!dialog_) {
    dialog_ = new PreferencesDialog(session_, tests_, bench_.dialogParent());
    dialog_->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog_, &PreferencesDialog::archivesSaved, this, &PreferencesFeature::offerArchives);
  }
  dialog_->show();
  dialog_->activateWindow();
}

void PreferencesFeature::offerArchives() {
  const Status offered = bench_.document.sources.offerArchives();
  if (!offered) warnUntilDone(QString::fromStdString(offered.message()));
}

}  // namespace

std::unique_ptr<Feature> makePreferences(Workbench& bench) {
  return std::make_unique<PreferencesFeature>(bench);
}

}  // namespace volumen
