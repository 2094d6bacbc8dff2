#pragma once

#include <functional>
#include <vector>

class QObject;

namespace volumen {

class Session;
class View;

/// Calls `take` once all these views have the pictures of the workspace as it is now (View::hasItsPicture),
/// at once where they have; `changed` where the workspace is another before that. Neither once `context` is
/// gone.
void onceDrawn(const std::vector<View*>& views, const Session& session, QObject* context,
               const std::function<void()>& take, const std::function<void()>& changed);

}  // namespace volumen
