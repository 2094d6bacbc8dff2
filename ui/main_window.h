#pragma once

#include <QMainWindow>
#include <map>

#include "ui/controller/accuracy_meter.h"
#include "ui/controller/autosave.h"
#include "ui/controller/draw_service.h"
#include "ui/controller/frame_service.h"
#include "ui/controller/index_service.h"
#include "ui/controller/loader.h"
#include "ui/controller/measurer.h"
#include "ui/controller/open_intent.h"
#include "ui/controller/preset_thumbnails.h"
#include "ui/controller/recent_files.h"
#include "ui/controller/references.h"
#include "ui/controller/scene_files.h"
#include "ui/controller/segmenter.h"
#include "ui/controller/slice_service.h"
#include "ui/controller/snapshot.h"
#include "ui/document/open_studies.h"
#include "ui/theme.h"
#include "ui/workspace/own_presets.h"
#include "ui/workspace/session.h"

class QActionGroup;
class QLabel;
class QSplitter;
class QStackedWidget;

namespace volumen {

class AccuracyPanel;
class Banner;
class EffectsPanel;
class KeyImagesPanel;
class MeasurementsPanel;
class OfferBar;
class PresetBar;
class Registrar;
class SegmentPanel;
class SnapshotPanel;
class StartPage;
class StatusLine;
class StudiesPanel;
class StudyBrowser;
class Masker;
class SliceView;
class ViewGrid;
class VolumeView;

/// What the window has done by others: how volumes are drawn, how presets are made, and which there are.
struct Services {
  MakeDraw makeDraw;
  MakeScene makeScene;
  std::function<std::vector<PresetEntry>()> presets;
  std::string indexFolder = userIndexFolder();  ///< of the list of studies
};

/// The real ones: render() and presetScene().
Services realServices();

/// Stacks the view and the docks around one session, and connects them; holds no state of its own.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(const Services& services, QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Opens files, folders, phantoms or sessions; the largest series of the first that holds any is shown, by
  /// the scene where one is given.
  void open(const QStringList& paths, const std::optional<Scene>& scene = {});
  /// Closes the window without asking; what is not saved is offered at the next start.
  void end();
  Session& session() { return session_; }
  /// The 3D view that the panels work on.
  VolumeView* view() const;
  ViewGrid* views() const { return grid_; }
  Jobs& jobs() { return jobs_; }
  const DrawService& drawService() const { return drawService_; }
  const AccuracyMeter& meter() const { return meter_; }

 Q_SIGNALS:
  /// The picture at rest of the session's scene is on screen.
  void settled();

 protected:
  void dragEnterEvent(QDragEnterEvent*) override;
  void dropEvent(QDropEvent*) override;
  void closeEvent(QCloseEvent*) override;
  void showEvent(QShowEvent*) override;
  void keyPressEvent(QKeyEvent*) override;

 private:
  void makeCentre();
  void makeDocks();
  void addDock(const QString& name, const QString& title, QWidget* panel, Qt::DockWidgetArea area);
  void makeActions();
  void makeMenus();
  void makeToolBar();
  void connectSession();
  void connectLoader();
  void connectDrawing();
  void connectSegmenter();
  void connectMasker();
  void connectAccuracy();
  void connectSnapshots();
  void connectViews();
  void makeLayoutActions();
  void makeFrameActions();
  void connectFrames();
  void connectVolumeViews();
  void makeKindActions();
  void showKindActions();
  void addKinds(QMenu* menu) const;
  void showVolumeMenu(QPoint global);
  SliceView* framesInFocus() const;
  void setShowAsFrames(bool asFrames);
  void showFrameActions();
  void showFramesInFocus(const Series& series);
  void showFlatMenu(SliceView& view, QPoint global);
  void makeReferenceActions();
  void makeReferenceDocks();
  void connectReferences();
  void showReference(const ReferencePtr& object);
  void showPresentation(const ReferencePtr& object);
  void showRegions(const ReferencePtr& object);
  void showReport(const ReferencePtr& object, const Report& report);
  void showPicture(const Series& series, int index);
  void showAsFrame(const QString& text, const Series& series, int index, const ReferenceKey& presentation);
  void showPictureNamed(const ReferencedPicture& picture);
  void showPlace(const std::string& frameOfReferenceUid, glm::dvec3 pPatient);
  void toggleKeyImage();
  void goToKeyImage(int step);
  void fillPresentations(QMenu* menu, SliceView& view);
  SliceView* sliceViewInFocus() const;
  void choosePage();
  void showPage();
  void showFirst(const Study& study, const std::optional<Scene>& scene);
  void addStudy(const QString& path, const std::shared_ptr<const Study>& study);
  QWidget* makeBrowser();
  void makeBrowserActions();
  void connectBrowser();
  void showBrowser(bool on);
  void arrangeBrowser();
  void showPatients();
  void askForImport();
  void showImport(const ImportReport& report);
  void openIndexed(const IndexedChoice& choice, bool beside);
  void openFound(const IndexedChoice& choice, const std::vector<std::string>& files,
                 const OpenIntent& intent);
  void showIndexed(const QString& place, const std::shared_ptr<const Study>& study, const OpenIntent& intent);
  void showChosen(const Study& study, const OpenIntent& intent);
  void showOpened(const Series& series, OpenHow how);
  void focusNextView();
  void makeMeasureActions();
  void makeSceneToolActions();
  void connectLinks();
  void registerViews();
  QWidget* makeMeasureButton();
  void connectMeasurements(MeasurementsPanel* panel);
  void showMeasurement(int id);
  void showOnFrame(const Measurement& m);
  void resetViewInFocus();
  Workspace arranged(Workspace workspace, const Series& series, bool isNew) const;
  Session::Arrange arrangedFor(const Series& series) const;
  Workspace inLayoutOf(Workspace workspace, const Series& series) const;
  const Series* ctUnder(const Series& pet) const;
  void keepLayouts() const;
  void showInFocus(const Series& series);
  void connectScenes();
  void connectSessions();
  void showSession(const QString& path, const OpenedSession& opened);
  void offerToLocate();
  void askWhereMissing();
  void showLocated(const Located& located);
  void saveSession();
  void askForSession();
  void askForSessionFile();
  void offerLost(const LostSession& lost);
  void showEarlier(const std::vector<LostSession>& discarded);
  QString unsavedText() const;
  void askBeforeClosing(const QString& lost);
  void saveAndClose();
  void connectRecent();
  void resetLayout();
  void shareRoom();
  void restoreLayout();
  void keepLayout();

  void applyLevel();
  void showDrawn(const ScreenPicture& drawn);
  void showStudy(const QString& path, const std::shared_ptr<const Study>& study, const OpenIntent& intent);
  void showSeries();
  void showVolume();
  void showWarnings();
  void makePresetBar(QToolBar* bar);
  void drawThumbnails();
  Scene sceneInView() const;
  void takeSnapshot(const SnapshotRequest& request);
  void askForScene();
  void askForSceneFile();
  void showRecent();
  void askForFolder();
  void askForFile();
  void setMaximised(bool alone);
  void setResampler(Resampler resampler);
  void applyPreferences(const Preferences& before, const Preferences& after);
  void showTheme();
  void showNames();
  void showPreferences();
  bool triggerByPlace(const QKeyEvent& event);
  void showAbout();
  void showShortcuts();

  Services services_;
  Session session_;
  Jobs jobs_;
  OpenStudies open_{this};
  IndexService index_;
  DrawService drawService_;
  SliceService slices_;
  FrameService frames_;
  References references_{jobs_};
  Measurer measurer_{session_, frames_};
  Loader loader_;
  AccuracyMeter meter_;
  Snapshot snapshot_;
  Segmenter segmenter_{jobs_};
  SceneFiles sceneFiles_{jobs_};
  RecentFiles recent_;
  SessionFiles sessionFiles_{session_, jobs_};
  Autosave autosave_{session_, sessionFiles_};
  PresetThumbnails thumbnails_;

  ViewGrid* grid_;
  QStackedWidget* pages_;
  StartPage* start_;
  Banner* banner_;
  OfferBar* offer_;
  StatusLine* status_;
  StudiesPanel* studies_;
  StudyBrowser* browser_;
  QSplitter* split_;  // the browser above the views
  QLabel* patients_;
  KeyImagesPanel* keyImages_;
  EffectsPanel* effects_;
  AccuracyPanel* accuracy_;
  SegmentPanel* segment_;
  Masker* masker_;
  Registrar* registrar_;
  SnapshotPanel* snapshotPanel_;
  PresetBar* presets_;
  std::map<QString, QAction*> actions_;
  QActionGroup* sceneTools_ = nullptr;  // of 3D views
  std::map<QString, QDockWidget*> docks_;
  QByteArray layoutBefore_;           // of the docks, while the view is alone
  bool layoutKept_ = false;           // from an earlier start
  std::optional<LostSession> lost_;   // offered, or being restored
  std::vector<LostSession> earlier_;  // discarded within a week
  bool closesWhenSaved_ = false;      // the window, once the session is
  bool closesUnasked_ = false;
  QMenu* recentMenu_;
  QMenu* earlierMenu_;
  QMenu* layoutMenu_;
  QMenu* measureMenu_;
  QMenu* linkMenu_;
  QActionGroup* kinds_;
  std::map<QString, Layout> layoutsChosen_;  // by modality, since the program began
  VolumePtr thumbnailsOf_;                   // the volume whose presets have thumbnails
  bool listedOnce_ = false;                  // the studies of the index, since the program began
  std::map<QString, std::vector<std::string>>
      filesOf_;  // what studies of the index that are open were made of
};

}  // namespace volumen
