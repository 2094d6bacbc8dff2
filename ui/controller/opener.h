#pragma once

#include <QObject>
#include <map>

#include "ui/controller/loader.h"
#include "ui/document/open_studies.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Puts what is open into views: a series in the layout of its modality with what belongs to it, or its
/// frames.
class Opener : public QObject {
  Q_OBJECT
 public:
  Opener(Session& session, Loader& loader, OpenStudies& open);

  /// Puts a study into the list; what was taken off it stands there again.
  void list(const QString& path, const std::shared_ptr<const Study>& study);
  /// Shows a series in the view in focus: its volume, or its frames where that is how it is read.
  void show(const Series& series);
  /// Shows its frames there.
  void showFrames(const Series& series);
  /// Shows the largest volume of a study by this scene, without one a PET whose CT that is over it, or a
  /// largerStack(); where there is no volume, its first pictures.
  void showFirst(const Study& study, const std::optional<Scene>& scene);
  /// Of a study that is opened together with the one that is shown first: a PET over the CT of that, or the
  /// CT under its PET.
  void showFused(const Study& study);

  /// What a series brings with it: the layout of its modality, unless series are being compared; where it was
  /// never shown before its time points, and the CT under a PET.
  /// A layout that was chosen while the series was on its way is from now on that of its modality.
  Session::Arrange arrangedFor(const Series& series);
  /// The main window in the layout that was chosen last for the modality of the series, else, or where views
  /// to compare would stay empty, in the usual one; as it is where the series comes into the second window.
  Workspace inLayoutOf(Workspace workspace, const Series& series) const {
    return inLayoutOf(std::move(workspace), series, false);
  }
  /// Shares the window in focus so from now on; the main one with all of the modality in focus, or of what is
  /// being opened, and of views to compare the first empty one shows what is most likely wanted there
  /// (withLikelySecond()).
  void chooseLayout(Layout layout);
  /// Keeps the layouts that were chosen for the next start.
  void keepLayouts() const;

 private:
  Workspace inLayoutOf(Workspace workspace, const Series& series, bool mayBeEmpty) const;
  Workspace arranged(Workspace workspace, const Series& series, bool isNew, bool isLayoutWanted) const;
  std::optional<Layout> layoutChosenFor(const Series& series) const;
  Workspace compared(Workspace workspace, Layout layout) const;
  const Series* ctUnder(const Series& pet) const;
  const Series& petOver(const Series& ct, const Study& study) const;

  Session& session_;
  Loader& loader_;
  OpenStudies& open_;
  std::map<QString, Layout> layoutsChosen_;  // by modality, since the program began
  std::optional<Layout> layoutOfNext_;       // chosen while a series is on its way
};

}  // namespace volumen
