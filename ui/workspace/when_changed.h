#pragma once

#include <functional>
#include <type_traits>

#include "ui/workspace/session.h"

namespace volumen {

namespace when_changed {

template <class Part, class Document>
constexpr bool compares = std::is_invocable_v<const Part&, const Document&, const Document&>;
template <class Part, class Document>
constexpr bool isOf = compares<Part, Document> || std::is_invocable_v<const Part&, const Document&>;

template <class Part, class Document>
bool differs(const Part& part, const Document& before, const Document& after) {
  if constexpr (compares<Part, Document>)
    return std::invoke(part, before, after);
  else if constexpr (isOf<Part, Document>)
    return std::invoke(part, before) != std::invoke(part, after);
  else
    return false;
}

template <class Document, class Signal, class Context, class Act, class... Parts>
void connectTo(const Session& session, Signal signal, Context* context, Act act,
               [[maybe_unused]] Parts... parts) {
  if constexpr ((isOf<Parts, Document> || ...))
    QObject::connect(&session, signal, context, [=](const Document& before, const Document& after) {
      if (!(differs(parts, before, after) || ...)) return;
      if constexpr (std::is_member_pointer_v<Act>)
        std::invoke(act, context);
      else
        act();
    });
}

}  // namespace when_changed

/// Calls `act`, a function or a member of `context`, whenever one of these parts has changed, as long as
/// `context` exists. A part is a member of Workspace or Preferences, a function that returns a value of one
/// of them, or a comparison of before and after that returns whether they differ.
template <class Context, class Act, class... Parts>
void whenChanged(const Session& session, Context* context, Act act, Parts... parts) {
  static_assert(((when_changed::isOf<Parts, Workspace> || when_changed::isOf<Parts, Preferences>)&&...));
  when_changed::connectTo<Workspace>(session, &Session::workspaceChanged, context, act, parts...);
  when_changed::connectTo<Preferences>(session, &Session::preferencesChanged, context, act, parts...);
}

}  // namespace volumen
