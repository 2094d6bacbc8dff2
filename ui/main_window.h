#pragma once

#include <QMainWindow>

#include "ui/features/feature.h"

namespace volumen {

/// Returns the services of the program: render() and presetScene().
Services realServices();

/// Stacks the views and the features around one document, which they open, save and close. Holds no state of
/// its own.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(const Services& services, QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Opens files, folders, phantoms or sessions and shows the largest series of the first study that has any.
  /// Draws it by `scene` if given, else fuses a PET with its CT if both are among them.
  void open(const QStringList& paths, const std::optional<Scene>& scene = {});
  /// Closes the window without asking. The next start offers to restore unsaved work.
  void end();
  Session& session() { return document_.session; }
  /// Returns the 3D view that the panels work on.
  VolumeView* view() const { return bench_->view(); }
  ViewGrid* views() const { return &bench_->grid; }
  Document& document() { return document_; }
  Jobs& jobs() { return document_.jobs; }
  const DrawService& drawService() const { return document_.drawService; }
  const AccuracyMeter& meter() const { return document_.meter; }

 Q_SIGNALS:
  /// Emitted when the final picture of the session's scene is on screen.
  void settled();

 protected:
  void closeEvent(QCloseEvent*) override;

 private:
  WindowParts makeParts();

  Services services_;
  Document document_;
  std::unique_ptr<Workbench> bench_;
  std::vector<std::unique_ptr<Feature>> features_;
};

}  // namespace volumen
