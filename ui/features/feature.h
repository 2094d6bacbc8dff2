#pragma once

#include <memory>
#include <vector>

#include "ui/features/workbench.h"

namespace volumen {

/// Something that the window can do: it owns its actions, docks and connections, and adds them to the window
/// as it is made.
class Feature : public QObject {
  Q_OBJECT
 public:
  explicit Feature(Workbench& bench);

  /// What closing the window would lose of it, in words; empty: nothing.
  virtual QString unsavedText() const { return {}; }
  /// Whether the window may close now, which would lose this (empty: nothing); false: it asks, and closes the
  /// window where that is wanted.
  virtual bool mayClose(const QString& lost);
  /// The window is about to close without being asked for; what is not saved is offered at the next start.
  virtual void closeUnasked() {}
  /// The window closes: keeps what the next start is to find.
  virtual void keep() {}

 protected:
  /// Tells of success in the status line, and says no more over the views what it said before.
  void tell(const QString& sentence);
  /// Says over the views why something cannot be done as things stand: until the feature succeeds, other
  /// series are open or another view is in focus.
  void warn(const QString& sentence, const QStringList& details = {});
  /// Says over the views what came of something, until the feature succeeds.
  void warnUntilDone(const QString& sentence, const QStringList& details = {});
  /// What it said over the views holds no more.
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

/// All of them, each a file of this folder, in the order in which they are made.
const std::vector<FeatureEntry>& features();

std::unique_ptr<Feature> makeAccuracy(Workbench& bench);
std::unique_ptr<Feature> makeCommands(Workbench& bench);
std::unique_ptr<Feature> makeCurvedPlanes(Workbench& bench);
std::unique_ptr<Feature> makeDockLayout(Workbench& bench);
std::unique_ptr<Feature> makeDrawing(Workbench& bench);
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
std::unique_ptr<Feature> makeLoading(Workbench& bench);
std::unique_ptr<Feature> makeMeasuring(Workbench& bench);
std::unique_ptr<Feature> makeMeasurementCharts(Workbench& bench);
std::unique_ptr<Feature> makeOpening(Workbench& bench);
std::unique_ptr<Feature> makePages(Workbench& bench);
std::unique_ptr<Feature> makePanels(Workbench& bench);
std::unique_ptr<Feature> makePictureFiles(Workbench& bench);
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
