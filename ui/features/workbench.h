#pragma once

#include <QAction>
#include <QMainWindow>
#include <functional>
#include <map>

#include "results/pictures/own_presets.h"
#include "ui/controller/accuracy_meter.h"
#include "ui/controller/derived_objects.h"
#include "ui/controller/draw_service.h"
#include "ui/controller/frame_service.h"
#include "ui/controller/loader.h"
#include "ui/controller/opener.h"
#include "ui/controller/recent_files.h"
#include "ui/controller/segment_editing.h"
#include "ui/controller/session_files.h"
#include "ui/controller/slice_service.h"
#include "ui/controller/study_sources.h"
#include "ui/derivations/drawn_scenes.h"
#include "ui/derivations/measured_numbers.h"
#include "ui/document/jobs.h"
#include "ui/document/open_studies.h"
#include "ui/features/menus.h"
#include "ui/features/shared_actions.h"
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

/// Services that the window takes from outside: drawing, scenes of presets, the list of presets and study
/// sources.
struct Services {
  MakeDraw makeDraw;
  MakeScene makeScene;
  std::function<std::vector<PresetEntry>()> presets;
  std::string indexFolder = userIndexFolder();  ///< folder of the study list
  MakeStudySources makeSources = makeStudySources;
};

/// The document with the services that read and draw it.
struct Document {
  explicit Document(const Services& services);

  Session session;
  Jobs jobs;
  SegmentEditing segments{session, jobs};
  DrawnScenes drawn{session, segments.painter(), jobs};
  OpenStudies open;
  StudySources sources;
  DrawService drawService;
  SliceService slices;
  FrameService frames;
  DerivedObjects derived{session, jobs};
  MeasuredNumbers measurer{session, frames};
  Loader loader;
  Opener opener{session, loader, open};
  AccuracyMeter meter{drawService};
  SessionFiles files{session, jobs};
  RecentFiles recent;
};

/// The parts of the window that features extend.
struct WindowParts {
  QMainWindow& window;
  ViewGrid& grid;
  Banner& banner;
  StatusLine& status;
  QStackedWidget& pages;  ///< the views or the start page
  QSplitter& split;       ///< contains `pages`
  QVBoxLayout& column;    ///< contains `split` as its last item
};

/// Shared by all features: the document, its views, and the frame for actions and docks.
class Workbench : public QObject, public WindowParts {
  Q_OBJECT
 public:
  Workbench(const Services& services, Document& document, const WindowParts& parts);

  const Services& services;
  Document& document;
  std::map<QString, QAction*> actions;          ///< all actions, by object name
  std::map<const Tool*, QAction*> toolActions;  ///< the actions that choose a tool
  SharedActions shared;
  Menus menus;

  /// A row of a table of actions.
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
  /// Adds an action created elsewhere under its object name.
  void addAction(QAction* action, const std::vector<Place>& places);
  /// Adds an empty menu that others may extend by its object name.
  QMenu* addMenu(const char* name, const QString& title, const std::vector<Place>& places);
  /// Adds a button to the tool bar for a menu that opens at once.
  QToolButton* addMenuButton(const char* name, int order);

  /// The kind of view a panel is about. A view in focus of one kind brings its panels before those of the
  /// other.
  enum class About { any, scene, flat };
  /// Default place of a panel: left, or right with tabs above for orders below `firstBelow` and tabs below
  /// for others. `isOpen` is its default visibility.
  struct DockPlace {
    Qt::DockWidgetArea area;
    int order;
    bool isOpen = true;
    About about = About::any;
  };
  static constexpr int firstBelow = 10;
  /// A row of a table of panels.
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
  /// Adds the dock NAMEDock with a title that folds it; the panel is called NAMEPanel. Wraps a panel about
  /// the scene by ofScene().
  QDockWidget* addDock(const DockEntry& entry);
  /// Makes a panel scroll vertically down to `leastHeight` pixels, so that the window fits small screens.
  /// Never reduces its width.
  static QWidget* scrolling(QWidget* panel, int leastHeight = 60);
  /// Shows a panel that works on the scene of view(), or a sentence while view() does not show what is in
  /// focus.
  QWidget* ofScene(QWidget* panel);

  /// Returns the window for a dialog: the active one or the one with an active dialog, else that of the view
  /// in focus.
  QWidget* dialogParent() const;
  /// Adds a widget between the messages and the views.
  void addAboveViews(QWidget* widget);

  /// Returns the 3D view that the panels work on.
  VolumeView* view() const;
  /// Returns the session's scene as that view draws it, independent of the view's size.
  Scene sceneInView() const;
  /// Returns the slice or frame view that receives keys, or null if there is none or it is hidden.
  FlatView* flatViewInFocus() const;
  /// Returns the frame view that receives keys and menus, or null.
  FrameView* framesInFocus() const;
  /// Calls `call` with each 3D view, including those created later.
  void forEachVolumeView(const std::function<void(VolumeView*)>& call);

 private:
  QString whyNoScene() const;

 Q_SIGNALS:
  /// All features are created and the menus filled.
  void made();
  /// Requests to open files, folders, phantoms or sessions. Shows the largest series of the first study that
  /// has any, drawn by `scene` if given.
  void openRequested(const QStringList& paths, const std::optional<volumen::Scene>& scene = {});
  /// Requests to send a study or series of the listed source, called `name`, to an archive.
  void sendRequested(const volumen::IndexedChoice& choice, const QString& name);
  /// Requests to send an open object to an archive.
  void objectSendRequested(const volumen::DerivedObjectPtr& object);
  /// Requests to import segments of these files into the series of the Segments panel.
  void segmentsRequested(const QStringList& paths);
  /// The view in focus shows another series, or shows its series in another way.
  void otherShown();
  /// view() has a new picture.
  void drawn(const volumen::ScreenPicture& picture);
  /// The picture is the final one of the session's scene. `complete` is that scene with the camera in use.
  void drawnAtRest(const volumen::ScreenPicture& picture, const volumen::Scene& complete);
  /// The user chose an object of the list.
  void objectChosen(const volumen::DerivedObjectPtr& object);
  /// A context menu of slices or frames is about to open. Features add their entries.
  void sliceMenuOpens(QMenu* menu, volumen::FlatView* view);
  /// A context menu of 3D views is about to open. Features add their entries.
  void sceneMenuOpens(QMenu* menu);
  /// The command list opens. Features add menus of commands that no other menu has.
  void commandsOpen(QMenu* more);
  /// Requests to show a range, or none, on the axis of the curve. rangeDragged reports drags of its ends.
  void rangeShown(const std::optional<volumen::ValueRange>& range);
  void rangeDragged(const volumen::ValueRange& range, bool ended);
  /// The user dragged the curve of the 3D view in focus.
  void curvePulled();
  /// Requests to run a recipe on the series of the Segments panel.
  void recipeWanted(const volumen::Recipe& recipe);
};

}  // namespace volumen
