#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/open_volume.h"
#include "app/render_options.h"
#include "app/session_view.h"
#include "results/segments/segment_picture_text.h"
#include "viewer/render/render.h"

namespace volumen {

/// The options that say what is drawn in 3D, as typed.
struct DrawnOptions {
  std::string path, series;
  SceneOptions scene;
  MethodOptions method;
  bool removeTable = false;
};

/// What these options and their files ask for.
struct AskedScene {
  std::optional<SessionView> session{};
  std::optional<Scene> scene{};  ///< of the session or --scene; empty: that of a preset
  RenderOptions options{};       ///< with the session's level, unless the command line sets one
};

/// Reads the session or the scene file. The Error names the file.
Result<AskedScene> readAskedScene(const DrawnOptions& options, const RenderOptions& render,
                                  const CancelToken& cancel);

/// Returns an option that contradicts the session of PATH; empty: none, or no session.
std::string saidBySession(const DrawnOptions& options);

/// A scene with its volume, ready to be planned and rendered.
class SceneToDraw {
 public:
  /// Loads what was asked for. The Error is a sentence for the user.
  static Result<SceneToDraw> load(const DrawnOptions& options, const AskedScene& asked,
                                  const CancelToken& cancel);

  /// Does the same with a volume that was opened.
  static Result<SceneToDraw> of(Opened opened, const DrawnOptions& options, const AskedScene& asked,
                                const CancelToken& cancel);

  /// Takes a reduced copy of the volume, with a note and a warning, if there is too little memory for it. The
  /// Error: even that does not fit.
  Status fitToMemory(const std::string& path, const RenderOptions& options);
  /// Returns the plan of picture `n` of a turn of `pictures`. The Error (wrong usage): options contradict
  /// each other.
  Result<Plan> plan(const RenderOptions& options, int n, int pictures) const;
  /// Returns the scene with camera and window as they are in plan(), for other volumes of the series.
  Result<Scene> sceneForOthers(const RenderOptions& options) const;
  /// Returns the text entries of a picture's PNG.
  PictureText textOf(const Rendered& done) const;

  RenderCaches& caches() const { return *caches_; }
  const Volume& volume() const { return *volume_; }
  int reducedBy() const { return reducedBy_; }  ///< along each axis

  Series series{};
  std::vector<std::string> notes{};  ///< sentences for stderr
  std::vector<Warning> warnings{};
  std::vector<Unread> unread{};
  std::vector<Series> timePoints{};  ///< as in Opened

 private:
  VolumePtr volume_;
  Scene scene_;
  SegmentsInPicture said_;
  std::unique_ptr<RenderCaches> caches_;
  int reducedBy_ = 1;
};

}  // namespace volumen
