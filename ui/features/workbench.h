#pragma once

#include <QAction>
#include <QMainWindow>
#include <functional>
#include <map>

#include "ui/controller/accuracy_meter.h"
#include "ui/controller/derived_objects.h"
#include "ui/controller/draw_service.h"
#include "ui/controller/frame_service.h"
#include "ui/controller/loader.h"
#include "ui/controller/measure_jobs.h"
#include "ui/controller/opener.h"
#include "ui/controller/recent_files.h"
#include "ui/controller/segment_jobs.h"
#include "ui/controller/session_files.h"
#include "ui/controller/slice_service.h"
#include "ui/controller/study_sources.h"
#include "ui/document/jobs.h"
#include "ui/document/open_studies.h"
#include "ui/features/menus.h"
#include "ui/workspace/own_presets.h"
#include "ui/workspace/session.h"

class QDockWidget;
class QMenu;
class QSplitter;
class QStackedWidget;
class QToolButton;
class QVBoxLayout;

namespace volumen {

class Banner;
class FlatView;
class FrameView;
class StatusLine;
struct Tool;
class ViewGrid;
class VolumeView;

/// What the window has done by others: how volumes are drawn, how presets are made, and which there are.
struct Services {
  MakeDraw makeDraw;
  MakeScene makeScene;
  std::function<std::vector<PresetEntry>()> presets;
  std::string indexFolder = userIndexFolder();  ///< of the list of studies
  MakeStudySources makeSources = makeStudySources;
};

/// The document, and what reads it and draws it.
struct Document {
  explicit Document(const Services& services);

  Session session;
  Jobs jobs;
  OpenStudies open;
  StudySources sources;
  DrawService drawService;
  SliceService slices;
  FrameService frames;
  DerivedObjects derived{jobs};
  MeasureJobs measurer{session, frames};
  Loader loader;
  Opener opener{session, loader, open};
  AccuracyMeter meter{drawService};
  SessionFiles files{session, jobs};
  RecentFiles recent;
};

/// The places of the window that features add to.
struct WindowParts {
  QMainWindow& window;
  ViewGrid& grid;
  Banner& banner;
  StatusLine& status;
  QStackedWidget& pages;  ///< the views, or the start page
  QSplitter& split;       ///< holds them
  QVBoxLayout& column;    ///< and that, last
};

/// What the features of the window share: the document, its views, and the frame that they add actions and
/// docks to.
class Workbench : public QObject, public WindowParts {
  Q_OBJECT
 public:
  Workbench(const Services& services, Document& document, const WindowParts& parts);

  const Services& services;
  Document& document;
  std::map<QString, QAction*> actions;
  Menus menus;

  /// One line of a table of actions.
  struct ActionEntry {
    const char* name;
    QString text;
    QList<QKeySequence> shortcuts;
    const char* icon;
    bool checkable;
    std::function<void(bool)> run;
    std::vector<Place> places = {};
  };
  QAction* addAction(const ActionEntry& entry);
  /// One that was made elsewhere, under its object name.
  void addAction(QAction* action, const std::vector<Place>& places);
  QAction* action(const char* name) const { return actions.at(QLatin1String(name)); }
  /// The one that chooses a tool.
  QAction* actionOf(const Tool& tool) const;
  /// An empty menu that others may add to by this object name.
  QMenu* addMenu(const char* name, const QString& title, const std::vector<Place>& places);
  /// A button of the tool bar, for a menu that opens at once.
  QToolButton* addMenuButton(const char* name, int order);

  /// What a panel is about. With the one kind of view in focus, tabs of the other one give way.
  enum class About { any, scene, flat };
  /// Where a panel stands while nobody has moved it: at the left, or at the right, where those before
  /// `firstBelow` are tabs above and the others tabs below them; and whether it is open.
  struct DockPlace {
    Qt::DockWidgetArea area;
    int order;
    bool isOpen = true;
    About about = About::any;
  };
  static constexpr int firstBelow = 10;
  /// One line of a table of panels.
  struct DockEntry {
    const char* name;
    QString title;
    QWidget* panel;
    DockPlace place;
  };
  struct Dock {
    QDockWidget* widget;
    DockPlace place;
  };
  std::map<QString, Dock> docks;
  /// In the window as NAMEDock, with a title that folds it; the panel is called NAMEPanel. One about the
  /// scene is ofScene().
  QDockWidget* addDock(const DockEntry& entry);
  QDockWidget* dock(const char* name) const { return docks.at(QLatin1String(name)).widget; }
  /// A panel that may be given less height than it has, `leastHeight` at the least, so that the window fits a
  /// small screen; never less width.
  static QWidget* scrolling(QWidget* panel, int leastHeight = 60);
  /// A panel that works on the scene of view(): seen while that shows what is in focus, else a sentence
  /// stands in its place.
  QWidget* ofScene(QWidget* panel);

  /// The window that a dialog stands over: the one in use, which is active or has a dialog that is; where
  /// there is none, that of the view in focus.
  QWidget* dialogParent() const;
  /// Between what is told and the views.
  void addAboveViews(QWidget* widget);

  /// The 3D view that the panels work on.
  VolumeView* view() const;
  /// The session's scene as it is drawn and seen there, whatever size the view has.
  Scene sceneInView() const;
  /// The view of slices or frames that keys are for; null: there is none, or it is not seen.
  FlatView* flatViewInFocus() const;
  /// The view of frames that keys and menus are for; null: there is none.
  FrameView* framesInFocus() const;
  /// Calls it with each 3D view, also with those that are made later.
  void forEachVolumeView(const std::function<void(VolumeView*)>& call);

 private:
  QString whyNoScene() const;

 Q_SIGNALS:
  /// All features are made, and the menus are filled.
  void made();
  /// Files, folders, phantoms or sessions are to be opened; the largest series of the first that holds any is
  /// shown, by the scene where one is given.
  void openRequested(const QStringList& paths, const std::optional<volumen::Scene>& scene = {});
  /// Segments of these files are to become segments of the series that the panel of segments is about.
  void segmentsRequested(const QStringList& paths);
  /// The view in focus shows another series than before, or shows it in another way.
  void otherShown();
  /// A picture of view().
  void drawn(const volumen::ScreenPicture& picture);
  /// That picture is the one at rest of the session's scene; `complete`: with the camera in use.
  void drawnAtRest(const volumen::ScreenPicture& picture, const volumen::Scene& complete);
  /// An object of the list was chosen.
  void objectChosen(const volumen::DerivedObjectPtr& object);
  /// A menu over slices or frames is about to open: features add what they have for it.
  void sliceMenuOpens(QMenu* menu, volumen::FlatView* view);
  /// The list of commands opens: features add a menu of what they have that stands in no menu.
  void commandsOpen(QMenu* more);
  /// The axis of the curve is to show this range, or none; an end of it is dragged there.
  void rangeShown(const std::optional<volumen::ValueRange>& range);
  void rangeDragged(const volumen::ValueRange& range, bool ended);
  /// The curve of the 3D view in focus was just pulled.
  void curvePulled();
  /// Segments are to be changed.
  void segmentWorkWanted(const volumen::SegmentWork& work);
  /// A recipe is to be followed on the series that the panel Segments shows.
  void recipeWanted(const volumen::Recipe& recipe);
};

}  // namespace volumen
