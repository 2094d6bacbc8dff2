#include "ui/workspace/session_json.h"

#include "ui/workspace/moved.h"
#include "ui/workspace/session_check.h"
#include "ui/workspace/session_entries.h"
#include "ui/workspace/session_fields.h"
#include "ui/workspace/session_segments.h"
#include "ui/workspace/session_views.h"
#include "ui/workspace/session_words.h"

namespace volumen {

namespace {

constexpr int version = 1;
constexpr std::size_t mostMiB = 8;

}  // namespace

// One list of fields for each struct, for writing and reading (session_fields.h).

static void fields(SessionFields& f, Window& w) {
  f("centre", w.centre, valueLimits);
  f("width", w.width, valueLimits);
  f.require("width", w.width != 0, "must not be 0");
}

// The directions of a picture in the patient. Rounding may take a cosine a little beyond 1.
static void fields(SessionFields& f, Lasso& lasso) {
  f("origin", lasso.origin, mmLimits);
  directions(f, lasso.right, lasso.down);
  f("perspective", lasso.perspective);
  f("inside", lasso.inside);
  f("points", lasso.points, mmLimits);
}

static void fields(SessionFields& f, ChosenWindow& chosen) {
  f("window", chosen.window);
  f("namedGrey", chosen.namedGrey, {0, 1e6});
}

static void fields(SessionFields& f, SeriesState& s) {
  std::vector<Lasso> lassos;
  for (const auto& lasso : s.mask.lassos) lassos.push_back(*lasso);
  f("tableRemoved", s.mask.tableRemoved);
  f("lassos", lassos);
  s.mask.lassos.clear();
  for (Lasso& lasso : lassos) s.mask.lassos.push_back(std::make_shared<const Lasso>(std::move(lasso)));
  f("window", s.window);
  f("namedGrey", s.namedGrey, {0, 1e6});
  f("frameWindow", s.frameWindow, frameWindowWords);
  f("colours", s.colours, colourWords);
}

static void fields(SessionFields& f, SavedFolder& folder) { f("path", folder.path); }

struct SavedPlace {
  glm::dvec3 at{0};
};
static void fields(SessionFields& f, SavedPlace& place) { f("at", place.at, mmLimits); }

static void fields(SessionFields& f, SavedCurve& curve) {
  CurvedRecipe& recipe = curve.recipe;
  std::vector<SavedPlace> points;
  for (const glm::dvec3 p : recipe.points) points.push_back({p});
  f("name", curve.name);
  f("kind", recipe.kind, curvedWords);
  f("points", points);
  f("ruled", recipe.ruled, {-1 - 1e-6, 1 + 1e-6});
  f("halfWidth", recipe.halfWidth, {1e-3, 1e4});
  recipe.points.clear();
  for (const SavedPlace& place : points) recipe.points.push_back(place.at);
}

static void fields(SessionFields& f, SeriesEntry& s) {
  f("path", s.saved.series.path);
  f("relativePath", s.saved.relativePath);
  f("folders", s.saved.folders);
  f("id", s.saved.series.id);
  f("format", s.saved.series.format);
  f("seriesUid", s.saved.series.seriesUid);
  f("frameOfReferenceUid", s.saved.series.frameOfReferenceUid);
  f("modality", s.saved.series.modality);
  f("seriesNumber", s.saved.series.seriesNumber);
  f("description", s.saved.series.description);
  f("geometry", s.saved.proof.geometry);
  f("valueType", s.saved.proof.valueType);
  f("files", s.saved.proof.files, {0, 1e9});
  f("instances", s.saved.proof.instances);
  f.unlessNone("curve", s.curve);
  f.require("curve", !s.curve || CurvedGrid::make(s.curve->recipe, s.saved.proof.geometry).ok(),
            "must be one that the series can be laid out along");
  fields(f, s.state);
}

static void fields(SessionFields& f, ChosenPreset& p) {
  f("name", p.name);
  f("scene", p.scene);
}

static void fields(SessionFields& f, DerivedKey& object) {
  f("path", object.path);
  f("id", object.id);
}

static void fields(SessionFields& f, SavedObject& saved) {
  fields(f, saved.key);
  f("relativePath", saved.relativePath);
  f("kind", saved.kind, derivedWords);
}

static void fields(SessionFields& f, KeyImage& image) {
  f("series", image.series);
  f("sopInstanceUid", image.sopInstanceUid);
  f("frame", image.frame, {0, 1e9});
  f.unlessNone("window", image.window);
}

static void fields(SessionFields& f, RegionsLook& look) {
  f("kind", look.kind, regionWords);
  f("label", look.label);
  f("frameOfReferenceUid", look.frameOfReferenceUid);
  f("opacity", look.opacity, {0, 1});
  mapField(f, "regions", look.shown, [](SessionFields& item, int& number, bool& shown) {
    item("number", number, {-2147483648.0, 2147483647.0});
    item("shown", shown);
  });
}

static void fields(SessionFields& f, PictureLevel& level) {
  f("quality", level.quality, qualityWords);
  f("edge", level.edge, {1, 16});
}

static void fields(SessionFields& f, QualityGoal& goal) {
  f("aim", goal.aim, aimWords);
  f("level", goal.level);
  f("frameMs", goal.frameMs, {1e-3, 1e9});
  f("errorOf255", goal.errorOf255, {1e-9, 1e3});
}

static void fields(SessionFields& f, Measurement& m) {
  bool placed = m.textOffset.has_value();
  glm::dvec3 offset = m.textOffset.value_or(glm::dvec3(0));
  f("id", m.id, {1, 1e9});
  f("series", m.series);
  f("shape", m.shape);
  f("textPlaced", placed);
  f("textOffset", offset, mmLimits);
  if (placed) m.textOffset = offset;
}

// Views in their initial state at the end of the list are not written, except for the first eight.
static void viewsField(SessionFields& f, SharedList<ViewState>& views) {
  constexpr std::size_t always = 8;
  const Workspace first;
  std::size_t count = views.size();
  while (count > always && views[count - 1] == first.views[count - 1]) --count;
  std::vector<ViewState> written(views.begin(), views.end());
  written.resize(count);
  f("views", written);
  static_assert(viewCount == 44);
  f.require("views", written.size() >= always && written.size() <= std::size_t(viewCount), "must be 8 to 44");
  for (std::size_t n = written.size(); n < std::size_t(viewCount); ++n) written.push_back(first.views[n]);
  views.assign(written);
}

// Written only if it is not the default, so that older versions can read sessions without a second window.
static void fields(SessionFields& f, SecondWindow& second) {
  f("shown", second.shown);
  f("layout", second.layout, gridWords);
  f("mainFocus", second.mainFocus, {0, firstSecondId - 1});
}

// All fields except the series, whose list comes first.
static void fields(SessionFields& f, Workspace& w) {
  f("layout", w.layout, layoutWords);
  f.unless({}, "second", w.second);
  f("focus", w.focus, {0, viewCount - 1});
  f("goal", w.goal);
  crosshairsField(f, w.crosshairs);
  f("links", w.links);
  f("frameLinks", w.frameLinks);
  viewsField(f, w.views);
  f("measurements", w.measurements);
  f("measurementsShown", w.measurementsShown);
  f("keyImages", w.keyImages);
  mapField(f, "regions", w.regions, [](SessionFields& item, DerivedKey& object, RegionsLook& look) {
    fields(item, object);
    fields(item, look);
  });
}

static void fields(SessionFields& f, SavedPatient& patient) {
  f("name", patient.name);
  f("id", patient.id);
}

static void fields(SessionFields& f, ExportedMap& map) {
  f("series", map.series);
  f("number", map.number, {0, 1e6});
}

Result<SavedSession> sessionFromJson(const std::string& text, const FindSeries& find,
                                     const FindObject& findObject) {
  const auto parsed = parseJson(text, mostMiB);
  if (!parsed) return parsed.error();
  std::string problem;
  NumberedSeries numbers;
  SavedSession session;
  SessionFields read(JsonFields(*parsed, "", problem), {&numbers, &session.unreadSteps});
  int found = 0;
  read("volumenSession", found, {-1e9, 1e9});
  if (found != version)
    read.refuse("volumenSession", "must be " + std::to_string(version) + ", the version of the format, not " +
                                      std::to_string(found));
  std::vector<SeriesEntry> entries;
  read("series", entries);
  if (!problem.empty()) return Error{problem};
  for (SeriesEntry& entry : entries) {
    const SeriesState state = stateOf(std::move(entry), find);
    numbers.add(*state.series);
    if (!session.workspace.series.add(numbers.keys.back(), state))
      return Error{read.pathOf("series", numbers.keys.size() - 1) + " is there twice."};
  }
  fields(read, session.workspace);
  read("segmentMaps", session.workspace.segmentMaps);
  read("savedAs", session.savedAs);
  read("patients", session.patients);
  read("exported", session.exported);
  std::vector<SavedObject> derived;
  read("references", derived);
  read.refuseOthers();
  if (problem.empty()) checkViews(read, session.workspace);
  if (!problem.empty()) return Error{problem};
  if (findObject) session.workspace = withObjectsFound(std::move(session.workspace), derived, findObject);
  return session;
}

Result<std::string> sessionToJson(const Workspace& workspace, const std::string& folder,
                                  const std::string& savedAs, std::vector<SavedPatient> patients,
                                  std::vector<ExportedMap> exported) {
  std::string problem;
  NumberedSeries numbers;
  JsonFields::Json json;
  SessionFields write(JsonFields(json, "", problem), {&numbers});
  std::vector<SeriesEntry> entries;
  for (const auto& [key, state] : workspace.series) {
    entries.push_back(entryOf(state, folder));
    numbers.add(*state.series);
  }
  int written = version;
  Workspace copy = withLastingObjects(workspace);
  std::string of = savedAs;
  write("volumenSession", written, {version, version});
  write("series", entries);
  fields(write, copy);
  std::vector<SavedObject> derived;
  for (const UsedObject& used : derivedObjectsOf(copy))
    derived.push_back({used.key, relativeTo(folder, used.key.path), used.kind});
  if (!copy.segmentMaps.empty()) write("segmentMaps", copy.segmentMaps);
  if (!derived.empty()) write("references", derived);
  if (!savedAs.empty()) write("savedAs", of);
  if (!patients.empty()) write("patients", patients);
  if (!exported.empty()) write("exported", exported);
  if (!problem.empty()) return Error{problem};
  // Names that are not UTF-8 get replacement characters; such series are reported as missing later.
  std::string text = json.dump(1, ' ', false, JsonFields::Json::error_handler_t::replace) + "\n";
  if (text.size() > mostMiB << 20)
    return Error{"The session is larger than " + std::to_string(mostMiB) + " MiB."};
  return text;
}

}  // namespace volumen
