#include "ui/features/feature.h"

#include "ui/widgets/banner.h"
#include "ui/widgets/status_line.h"

namespace volumen {

const std::vector<FeatureEntry>& features() {
  static const std::vector<FeatureEntry> table{
      {"studies", makeStudies},
      {"panels", makePanels},
      {"opening", makeOpening},
      {"dock layout", makeDockLayout},
      {"undo", makeUndo},
      {"preferences", makePreferences},
      {"pages", makePages},
      {"status", makeStatus},
      {"first images", makeFirstImages},
      {"drawing", makeDrawing},
      {"keys", makeKeys},
      {"keys ahead", makeKeysAhead},
      {"sessions", makeSessions},
      {"presets", makePresets},
      {"scenes", makeScenes},
      {"accuracy", makeAccuracy},
      {"segmenting", makeSegmenting},
      {"segment recipes", makeSegmentRecipes},
      {"view pictures", makeViewPictures},
      {"picture files", makePictureFiles},
      {"films", makeFilms},
      {"printing", makePrinting},
      {"snapshots", makeSnapshots},
      {"file exports", makeFileExports},
      {"receiving", makeReceiving},
      {"measuring", makeMeasuring},
      {"measurement charts", makeMeasurementCharts},
      {"curved planes", makeCurvedPlanes},
      {"registration", makeRegistration},
      {"hanging protocols", makeHangingProtocols},
      {"priors", makePriors},
      {"derived objects", makeDerivedObjects},
      {"key images", makeKeyImages},
      {"key image pages", makeKeyImagePages},
      {"frames", makeFrameActions},
      {"views", makeViewActions},
      {"flat tools", makeFlatTools},
      {"picture turns", makePictureTurns},
      {"windows", makeWindowChoices},
      {"window alone", makeWindowAlone},
      {"study list", makeStudyListing},
      {"second window", makeSecondWindow},
      {"plane lines", makePlaneLines},
      {"tools in focus", makeToolsInFocus},
      {"focus keys", makeFocusKeys},
      {"commands", makeCommands},
      {"help", makeHelp},
  };
  return table;
}

Feature::Feature(Workbench& bench)
    : QObject(&bench.window),
      bench_(bench),
      session_(bench.document.session),
      open_(bench.document.open),
      grid_(bench.grid) {}

bool Feature::mayClose(const QString&) { return true; }

void Feature::tell(const QString& sentence) {
  takeBack();
  bench_.status.tell(sentence);
}

void Feature::warn(const QString& sentence, const QStringList& details) {
  bench_.banner.tell({sentence, details, this, true});
}

void Feature::warnUntilDone(const QString& sentence, const QStringList& details) {
  bench_.banner.tell({sentence, details, this});
}

void Feature::takeBack() { bench_.banner.takeBack(this); }

}  // namespace volumen
