#pragma once

#include "ui/widgets/bind.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Returns bindings that edit the session in undo steps.
inline Bindings bindingsTo(Session& session) {
  return Bindings([&session](const QString& what,
                             const std::function<void(Scene&)>& change) { session.edit(what, change, what); },
                  [&session] { session.endGesture(); });
}

}  // namespace volumen
