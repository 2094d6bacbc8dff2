#pragma once

#include <QObject>
#include <map>

#include "ui/controller/loader.h"
#include "ui/document/open_studies.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Puts open studies into views: a series with what belongs to it in the layout of its modality, or its
/// frames.
class Opener : public QObject {
  Q_OBJECT
 public:
  Opener(Session& session, Loader& loader, OpenStudies& open);

  /// Adds a study to the list, also one removed before.
  void list(const QString& path, const std::shared_ptr<const Study>& study);
  /// Adds what came of a study in the list since. What was removed from the list stays removed. Does nothing
  /// if that is all of the study.
  void join(const QString& path, const std::shared_ptr<const Study>& study);
  /// Shows a series in the view in focus: its volume, or its frames if it is read that way.
  void show(const Series& series);
  /// Shows the frames of a series in the view in focus.
  void showFrames(const Series& series);
  /// Returns the firstSeries() of an open study.
  std::optional<Series> firstOf(const Study& study, const std::string& seriesUid = {}) const;
  /// Reads a series and then shows it with `scene` in the view in focus, as its volume.
  void read(const Series& series, const std::optional<Scene>& scene = {});
  /// Reads the firstOf() a study and shows it, or its largest volume with this scene.
  void showFirst(const Study& study, const std::optional<Scene>& scene);
  /// Shows a study opened together with the one shown first: a PET over its CT, or the CT under its PET.
  void showFused(const Study& study);

  /// Returns the main window in the layout last chosen for the modality. If there is none, or comparison
  /// views would stay empty, uses the usual layout. If the series comes into the second window, the main
  /// window stays unchanged.
  Workspace inLayoutOf(Workspace workspace, const Series& series) const {
    return inLayoutOf(std::move(workspace), series, false);
  }
  /// Divides the window in focus by `layout` from now on. In the main window this applies to the modality in
  /// focus or being opened. The first empty comparison view shows the most likely series
  /// (withLikelySecond()).
  void chooseLayout(Layout layout);
  /// Stores the chosen layouts for the next start.
  void keepLayouts() const;

 private:
  void listBut(const Unlisted& known, const QString& path, const std::shared_ptr<const Study>& study);
  Workspace inLayoutOf(Workspace workspace, const Series& series, bool mayBeEmpty) const;
  Workspace arranged(Workspace workspace, const Series& series, bool isNew, bool isLayoutWanted) const;
  Session::Arrange arrangedFor(const Series& series);
  std::optional<Layout> layoutChosenFor(const Series& series) const;
  Workspace compared(Workspace workspace, Layout layout) const;

  Session& session_;
  Loader& loader_;
  OpenStudies& open_;
  std::map<QString, Layout> layoutsChosen_;  // by modality, since the program began
};

}  // namespace volumen
