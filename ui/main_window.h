#pragma once

#include <QMainWindow>

#include "ui/controller/open_intent.h"
#include "ui/features/feature.h"
#include "ui/features/theme.h"

class QSplitter;
class QStackedWidget;
class QVBoxLayout;

namespace volumen {

class StartPage;
class StudiesPanel;

/// The real ones: render() and presetScene().
Services realServices();

/// Stacks the views, the docks and the features around one document, and opens, saves and closes it; holds no
/// state of its own.
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
  VolumeView* view() const { return bench_->view(); }
  ViewGrid* views() const { return grid_; }
  Document& document() { return document_; }
  Jobs& jobs() { return document_.jobs; }
  const DrawService& drawService() const { return document_.drawService; }
  const AccuracyMeter& meter() const { return document_.meter; }

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
  void makeActions();
  void makeFeatures();
  void makeMenus();
  void makeToolBar();
  void connectSession();
  void connectLoader();
  void connectDrawing();
  void connectRecent();

  void showStudy(const QString& path, const std::shared_ptr<const Study>& study, const OpenIntent& intent);
  void showDrawn(const ScreenPicture& drawn);
  void showPage();
  void choosePage();
  void showWarnings();
  void showRecent();
  void askForFolder();
  void askForFile();

  void resetLayout();
  void shareRoom();
  void restoreLayout();
  void keepLayout();
  void setMaximised(bool alone);
  void applyPreferences(const Preferences& before, const Preferences& after);
  void showTheme();
  void showPreferences();
  bool triggerByPlace(const QKeyEvent& event);

  Services services_;
  Document document_;
  Session& session_ = document_.session;
  OpenStudies& open_ = document_.open;
  Loader& loader_ = document_.loader;
  RecentFiles& recent_ = document_.recent;

  ViewGrid* grid_;
  QStackedWidget* pages_;
  StartPage* start_;
  Banner* banner_;
  StatusLine* status_;
  StudiesPanel* studies_;
  std::unique_ptr<Workbench> bench_;
  std::vector<std::unique_ptr<Feature>> features_;
  QByteArray layoutBefore_;  // of the docks, while the view is alone
  bool layoutKept_ = false;  // from an earlier start
  QMenu* recentMenu_;
};

}  // namespace volumen
