#pragma once

#include <functional>
#include <vector>

class QObject;

namespace volumen {

class Session;
class View;

/// Calls `take` as soon as all `views` show the present workspace (View::hasItsPicture). Calls `changed`
/// instead if the workspace changes first. Calls neither after `context` is deleted.
void onceDrawn(const std::vector<View*>& views, const Session& session, QObject* context,
               const std::function<void()>& take, const std::function<void()>& changed);

}  // namespace volumen
