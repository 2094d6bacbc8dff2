#pragma once

#include "ui/widgets/bind.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Bindings whose edits are steps of this session.
inline Bindings bindingsTo(Session& session) {
  return Bindings([&session](const QString& what,
                             const std::function<void(Scene&)>& change) { session.edit(what, change, what); },
                  [&session] { session.endGesture(); });
}

}  // namespace volumen
