#pragma once

#include <QMainWindow>
#include <map>

#include "ui/controller/accuracy_meter.h"
#include "ui/controller/loader.h"
#include "ui/controller/render_controller.h"
#include "ui/controller/segmenter.h"
#include "ui/controller/snapshot.h"
#include "ui/session/session.h"
#include "ui/theme.h"

class QComboBox;
class QStackedWidget;

namespace volumen {

class AccuracyPanel;
class Banner;
class EffectsPanel;
class SegmentPanel;
class SnapshotPanel;
class StatusLine;
class StudiesPanel;
class TableRemover;
class VolumeView;

/// What the window has done by others: how volumes are drawn, how presets are made, and their names.
struct Services {
  MakeDraw makeDraw;
  MakeScene makeScene;
  std::vector<std::string> presetNames;
};

/// The real ones: render() and presetScene().
Services realServices();

/// Stacks the view and the docks around one session, and connects them; holds no state of its own.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(const Services& services, QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Opens files, folders or phantoms; the largest series of the first that holds any is shown.
  void open(const QStringList& paths);
  Session& session() { return session_; }
  VolumeView* view() const { return view_; }
  const RenderController& controller() const { return controller_; }
  const AccuracyMeter& meter() const { return meter_; }

 Q_SIGNALS:
  /// The picture at rest of the session's scene is on screen.
  void settled();

 protected:
  void dragEnterEvent(QDragEnterEvent*) override;
  void dropEvent(QDropEvent*) override;
  void closeEvent(QCloseEvent*) override;

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
  void connectTableRemover();
  void connectAccuracy();
  void restoreLayout();

  void requestFrame();
  void applyLevel();
  void showFrame(const Frame& frame);
  void showStudy(const QString& path, const std::shared_ptr<const Study>& study);
  void showSeries();
  void showVolume();
  void applyPreset(const QString& name, const Scene& scene);
  void saveSnapshot(const struct SnapshotRequest& request);
  void askForFolder();
  void askForFile();
  void setMaximised(bool alone);
  void setResampler(Resampler resampler);
  void setTheme(Theme theme);
  void showAbout();
  void showShortcuts();

  Services services_;
  Session session_;
  RenderController controller_;
  Loader loader_;
  AccuracyMeter meter_;
  Snapshot snapshot_;
  Segmenter segmenter_;

  VolumeView* view_;
  QStackedWidget* pages_;
  Banner* banner_;
  StatusLine* status_;
  StudiesPanel* studies_;
  EffectsPanel* effects_;
  AccuracyPanel* accuracy_;
  SegmentPanel* segment_;
  TableRemover* tableRemover_;
  SnapshotPanel* snapshotPanel_;
  QComboBox* presets_;
  std::map<QString, QAction*> actions_;
  std::map<QString, QDockWidget*> docks_;
  QByteArray layoutBefore_;  // of the docks, while the view is alone
  bool showFirst_ = false;   // the next study opened is shown
};

}  // namespace volumen
