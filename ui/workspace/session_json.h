#pragma once

#include <functional>
#include <memory>
#include <string>

#include "ui/workspace/session_fields.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// A session's entry for one of its series, to find it again.
struct SavedSeries {
  Series series;  ///< identifies it; `path` as it was, below an archive if it lay in one (lastingPath)
  std::string relativePath;          ///< from the session's folder; empty: no file (phantom)
  std::vector<SavedFolder> folders;  ///< folders of its files, if these do not lie directly in `path`
  SeriesProof proof;
};

/// A session's entry for an object that refers to pictures, to find it again.
struct SavedObject {
  DerivedKey key;            ///< as it was; its id is the object's UID
  std::string relativePath;  ///< from the session's folder; empty: unknown
  DerivedKind kind = DerivedKind::presentation;
};

/// Finds an object again and returns it under its present path; empty if it is not there.
using FindObject = std::function<std::optional<DerivedKey>(const SavedObject& saved)>;

/// Finds a series again; null if it is not there or has changed.
using FindSeries = std::function<std::shared_ptr<const Series>(const SavedSeries& saved)>;

/// A patient whose pictures a session shows, as named in the files.
struct SavedPatient {
  std::string name, id;
  bool operator==(const SavedPatient&) const = default;
};

/// A map of segments that also has a file of its own.
struct ExportedMap {
  SeriesKey series;
  int number{};  ///< of the map among those of its series
  bool operator==(const ExportedMap&) const = default;
};

struct SavedSession {
  Workspace workspace;
  std::string savedAs;                   ///< autosave only: the session file it belongs to; empty: none yet
  std::vector<SavedPatient> patients;    ///< autosave only: the patients of its series
  std::vector<ExportedMap> exported;     ///< autosave only
  std::vector<UnreadSteps> unreadSteps;  ///< segments with these steps count as made by hand
};

/// Reads a session from unchecked JSON (UTF-8). Series that `find` finds get their present path; others are
/// missing and keep the session's entries. Objects that `findObject` finds get their present path; others
/// keep theirs. The Error is one sentence that names the field. Refuses unknown fields, texts above 8 MiB and
/// sessions that no window can show.
Result<SavedSession> sessionFromJson(const std::string& text, const FindSeries& find,
                                     const FindObject& findObject = {});

/// Returns the workspace as JSON with every field. It reads back as an equal workspace if the series are
/// found. `folder` is where the session will be stored. The Error names a field that could not be read back,
/// such as a number that is not finite.
Result<std::string> sessionToJson(const Workspace& workspace, const std::string& folder,
                                  const std::string& savedAs = {}, std::vector<SavedPatient> patients = {},
                                  std::vector<ExportedMap> exported = {});

}  // namespace volumen
