#include "ui/panels/sources.h"

namespace volumen {

Source<Scene> sceneSource(Session& session) {
  return {.edit = [&session](const QString& what,
                             const std::function<void(Scene&)>& change) { session.edit(what, change, what); },
          .done = [&session] { session.endGesture(); },
          .follow =
              [&session](QObject* owner, const Follower<Scene>& show) {
                show(session.scene());
                QObject::connect(&session, &Session::changed, owner,
                                 [show](const SessionState&, const SessionState& now) { show(now.scene); });
              }};
}

Source<Preferences> preferencesSource(Session& session) {
  return {.edit = [&session](const QString&,
                             const std::function<void(Preferences&)>& change) { session.prefer(change); },
          .follow =
              [&session](QObject* owner, const Follower<Preferences>& show) {
                show(session.preferences());
                QObject::connect(&session, &Session::preferencesChanged, owner,
                                 [show](const Preferences&, const Preferences& now) { show(now); });
              }};
}

Source<SegmentOptions> optionsSource(SegmentEditing& editing) {
  return {.edit = [&editing](const QString&,
                             const std::function<void(SegmentOptions&)>& change) { editing.choose(change); },
          .follow =
              [&editing](QObject* owner, const Follower<SegmentOptions>& show) {
                show(editing.options());
                QObject::connect(&editing, &SegmentEditing::optionsChanged, owner,
                                 [&editing, show] { show(editing.options()); });
              }};
}

}  // namespace volumen
