#include "app/space_relation.h"

#include <cstdio>

#include "ui/controller/open_session.h"
#include "viewer/register/rigid_registration.h"

namespace volumen {

namespace {

// Returns a motion as the rows of a matrix of 3 x 4.
std::string matrixText(const Rigid& rigid) {
  std::string text;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      char number[32];
      std::snprintf(number, sizeof number, "%s%.9g", text.empty() ? "" : " ",
                    column < 3 ? rigid.rotation[column][row] : rigid.translation[row]);
      text += number;
    }
  return text;
}

SpaceRelation relationBy(const Rigid& toFromFrom, const std::string& how) {
  return {toFromFrom,
          how + " (from mm of the slices to mm of the series put on them: " + matrixText(toFromFrom) + ")",
          {}};
}

Result<SpaceRelation> relationIn(const std::string& session, const Series& from, const Series& to) {
  const auto read = relationInSession(session, frameOfReference(from), frameOfReference(to));
  if (!read) return read.error();
  const std::optional<FrameRelation>& relation = *read;
  if (!relation)
    return Error{session + " does not link the frames of reference of " + from.path + " and " + to.path +
                 ": register or lock them in the window, and save the session."};
  return relationBy(relation->toFromFrom, relation->byHand ? "placed by hand" : "placed by a registration");
}

// Returns a note if one of the series names no frame of reference, and nothing if both are in one. The Error:
// they are in two.
Result<std::string> comparedFrames(const Series& from, const Series& to) {
  const std::string &a = from.frameOfReferenceUid, &b = to.frameOfReferenceUid;
  const bool isOneSeries = from.files == to.files && from.frames == to.frames;
  if (isOneSeries || (a == b && !a.empty())) return std::string();
  if (!a.empty() && !b.empty())
    return Error{from.path + " and " + to.path +
                 " are in different frames of reference: say how they relate by --register or --registration "
                 "SESSION."};
  return (a.empty() ? from : to).path +
         " names no frame of reference: its positions are taken to be in that of the other series.";
}

Result<SpaceRelation> relationAsked(const Opened& from, const Opened& to, const RelationOptions& options,
                                    const CancelToken& cancel) {
  if (!options.session.empty()) return relationIn(options.session, from.series, to.series);
  if (options.registers) {
    const auto found = registerRigidly(*from.loaded.drawn, *to.loaded.drawn, cancel);
    if (!found) return found.error();
    return relationBy(*found, "registered rigidly by mutual information");
  }
  const auto note = comparedFrames(from.series, to.series);
  if (!note) return note.error();
  SpaceRelation same;
  if (!note->empty()) same.notes.push_back(*note);
  return same;
}

}  // namespace

void addRelationOptions(CLI::App& app, RelationOptions& options) {
  CLI::Option* registers =
      app.add_flag("--register", options.registers,
                   "Register the two series, whose frames of reference differ (rigid, mutual information)");
  app.add_option("--registration", options.session,
                 "A session of the window in which the two series are linked, by registration or by hand")
      ->type_name("SESSION")
      ->excludes(registers);
}

Result<SpaceRelation> relationOfSpaces(const Opened& from, const Opened& to, const RelationOptions& options,
                                       const CancelToken& cancel) {
  auto relation = relationAsked(from, to, options, cancel);
  if (!relation) return relation;
  const std::string &a = from.series.patientId, &b = to.series.patientId;
  if (!a.empty() && !b.empty() && a != b)
    relation->notes.push_back(from.series.path + " and " + to.series.path + " are of different patients (" +
                              a + ", " + b + ").");
  return relation;
}

}  // namespace volumen
