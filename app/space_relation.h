#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/open_volume.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// The options that say how the patient spaces of two series relate, as typed.
struct RelationOptions {
  bool registers = false;  ///< finds it out (registerRigidly)
  std::string session;     ///< a session of the window in which the two are linked
};

/// How the patient spaces of two series relate.
struct SpaceRelation {
  Rigid toFromFrom{};
  std::string words{};               ///< how it was found; empty: they are one space
  std::vector<std::string> notes{};  ///< sentences for the user
};

/// Adds --register and --registration.
void addRelationOptions(CLI::App& app, RelationOptions& options);

/// Returns how the patient spaces of two series relate. Without options both must be in one frame of
/// reference. A series without a frame of reference is taken to be in that of the other, which a note says.
/// Another note says that the patients differ. The Error: they are in two frames of reference that the
/// session does not link, or they cannot be registered.
Result<SpaceRelation> relationOfSpaces(const Opened& from, const Opened& to, const RelationOptions& options,
                                       const CancelToken& cancel);

}  // namespace volumen
