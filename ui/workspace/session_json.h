#pragma once

#include <functional>
#include <memory>
#include <string>

#include "ui/workspace/session_fields.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// What a session says of one of its series, to find it again.
struct SavedSeries {
  Series series;  ///< what names it; path as it was, where it lay in an archive below that (lastingPath)
  std::string relativePath;          ///< from the session's folder; empty: of what is no file (phantoms)
  std::vector<SavedFolder> folders;  ///< that hold its files, where these do not lie directly in `path`
  SeriesProof proof;
};

/// What a session says of an object that refers to pictures, to find it again.
struct SavedObject {
  DerivedKey key;            ///< as it was; its id is the object's UID
  std::string relativePath;  ///< from the session's folder; empty: not said
  DerivedKind kind = DerivedKind::presentation;
};

/// Finds an object again, under its own path. Nothing: it is not there.
using FindObject = std::function<std::optional<DerivedKey>(const SavedObject& saved)>;

/// Finds a series again. Null: it is not there, or no longer what it was.
using FindSeries = std::function<std::shared_ptr<const Series>(const SavedSeries& saved)>;

/// Whose pictures a session shows, as their files say.
struct SavedPatient {
  std::string name, id;
  bool operator==(const SavedPatient&) const = default;
};

struct SavedSession {
  Workspace workspace;
  std::string savedAs;  ///< of what was kept on the way: the session file it belongs to; empty: none yet
  std::vector<SavedPatient> patients;    ///< of what was kept on the way: those of its series
  std::vector<UnreadSteps> unreadSteps;  ///< of segments whose record is empty for that: as made by hand
};

/// Reads a session (JSON in UTF-8) that nobody has checked. Where `find` finds a series the workspace holds
/// that one, under its own path; else what the session says of it, as missing. Where `findObject` finds an
/// object that refers to pictures, it is named by its own path; else by the one it had. Every refusal is one
/// sentence that names the field; unknown fields, texts above 8 MiB and what no window can show are refused.
Result<SavedSession> sessionFromJson(const std::string& text, const FindSeries& find,
                                     const FindObject& findObject = {});

/// The workspace with every field: what is read from it is equal where the series are found. `folder`: where
/// the session is to lie. An Error names the field that could not be read again, such as a number that is not
/// finite.
Result<std::string> sessionToJson(const Workspace& workspace, const std::string& folder,
                                  const std::string& savedAs = {}, std::vector<SavedPatient> patients = {});

}  // namespace volumen
