#pragma once

#include <memory>
#include <vector>

#include "ui/features/workbench.h"

namespace volumen {

/// A function of the window. Owns its actions, docks and connections and adds them to the window when
/// created.
class Feature : public QObject {
  Q_OBJECT
 public:
  explicit Feature(Workbench& bench);

  /// Describes the work that closing the window would lose. Empty if there is none.
  virtual QString unsavedText() const { return {}; }
  /// Returns whether the window may close now and lose `lost` (empty: nothing). If false, the feature asks
  /// the user and closes the window on consent.
  virtual bool mayClose(const QString& lost);
  /// Called before the window closes without asking. The next start offers to restore unsaved work.
  virtual void closeUnasked() {}
  /// Saves settings for the next start as the window closes.
  virtual void keep() {}

 protected:
  /// Reports success in the status line and removes the feature's message above the views.
  void tell(const QString& sentence);
  /// Shows above the views why something cannot be done now. The message remains until the feature succeeds,
  /// other series are open or another view is in focus.
  void warn(const QString& sentence, const QStringList& details = {});
  /// Shows a result above the views until the feature succeeds.
  void warnUntilDone(const QString& sentence, const QStringList& details = {});
  /// Removes the feature's message above the views.
  void takeBack();

  Workbench& bench_;
  Session& session_;
  OpenStudies& open_;
  ViewGrid& grid_;
};

struct FeatureEntry {
  const char* name;
  std::unique_ptr<Feature> (*make)(Workbench& bench);
};

/// Returns all features, one per file of this folder, in order of creation.
const std::vector<FeatureEntry>& features();

std::unique_ptr<Feature> makeAccuracy(Workbench& bench);
std::unique_ptr<Feature> makeCommands(Workbench& bench);
std::unique_ptr<Feature> makeCurvedPlanes(Workbench& bench);
std::unique_ptr<Feature> makeDockLayout(Workbench& bench);
std::unique_ptr<Feature> makeDrawing(Workbench& bench);
std::unique_ptr<Feature> makeFileExports(Workbench& bench);
std::unique_ptr<Feature> makeFirstImages(Workbench& bench);
std::unique_ptr<Feature> makeFlatTools(Workbench& bench);
std::unique_ptr<Feature> makeFocusKeys(Workbench& bench);
std::unique_ptr<Feature> makeFrameActions(Workbench& bench);
std::unique_ptr<Feature> makeHangingProtocols(Workbench& bench);
std::unique_ptr<Feature> makeHelp(Workbench& bench);
std::unique_ptr<Feature> makeKeyImages(Workbench& bench);
std::unique_ptr<Feature> makeKeyImagePages(Workbench& bench);
std::unique_ptr<Feature> makeKeys(Workbench& bench);
std::unique_ptr<Feature> makeKeysAhead(Workbench& bench);
std::unique_ptr<Feature> makeMeasuring(Workbench& bench);
std::unique_ptr<Feature> makeMeasurementCharts(Workbench& bench);
std::unique_ptr<Feature> makeOpening(Workbench& bench);
std::unique_ptr<Feature> makePages(Workbench& bench);
std::unique_ptr<Feature> makePanels(Workbench& bench);
std::unique_ptr<Feature> makePictureFiles(Workbench& bench);
std::unique_ptr<Feature> makeFilms(Workbench& bench);
std::unique_ptr<Feature> makePictureTurns(Workbench& bench);
std::unique_ptr<Feature> makePlaneLines(Workbench& bench);
std::unique_ptr<Feature> makePreferences(Workbench& bench);
std::unique_ptr<Feature> makePresets(Workbench& bench);
std::unique_ptr<Feature> makePrinting(Workbench& bench);
std::unique_ptr<Feature> makePriors(Workbench& bench);
std::unique_ptr<Feature> makeDerivedObjects(Workbench& bench);
std::unique_ptr<Feature> makeRegistration(Workbench& bench);
std::unique_ptr<Feature> makeScenes(Workbench& bench);
std::unique_ptr<Feature> makeSecondWindow(Workbench& bench);
std::unique_ptr<Feature> makeSegmenting(Workbench& bench);
std::unique_ptr<Feature> makeSegmentRecipes(Workbench& bench);
std::unique_ptr<Feature> makeReceiving(Workbench& bench);
std::unique_ptr<Feature> makeSessions(Workbench& bench);
std::unique_ptr<Feature> makeSnapshots(Workbench& bench);
std::unique_ptr<Feature> makeStatus(Workbench& bench);
std::unique_ptr<Feature> makeStudies(Workbench& bench);
std::unique_ptr<Feature> makeStudyListing(Workbench& bench);
std::unique_ptr<Feature> makeToolsInFocus(Workbench& bench);
std::unique_ptr<Feature> makeUndo(Workbench& bench);
std::unique_ptr<Feature> makeViewActions(Workbench& bench);
std::unique_ptr<Feature> makeViewPictures(Workbench& bench);
std::unique_ptr<Feature> makeWindowChoices(Workbench& bench);
std::unique_ptr<Feature> makeWindowAlone(Workbench& bench);

}  // namespace volumen
