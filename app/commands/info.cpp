#include <zlib.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/derived_json.h"
#include "app/info_text.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/usage.h"
#include "io/paths/open_path.h"
#include "io/load.h"
#include "io/study/iso_date.h"
#include "io/study/study.h"
#include "io/zip_archive.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  std::string path;
  bool json = false, values = false, verbose = false;
};

Json toJson(glm::dvec3 v) { return Json::array({v.x, v.y, v.z}); }
Json toJson(glm::ivec3 v) { return Json::array({v.x, v.y, v.z}); }

// Adds the geometry keys of design.md 7; null if not calibrated.
void addGeometry(Json& out, const VoxelGeometry& g) {
  const bool known = g.calibrated;
  const glm::dvec3 spacing = g.spacing();
  Json directions = Json::array();
  for (int a = 0; a < 3; ++a) directions.push_back(toJson(g.patientFromVoxelStep[a] / spacing[a]));
  out["dims"] = toJson(g.size);
  out["calibrated"] = known;
  out["spacing"] = known ? toJson(spacing) : Json();
  out["origin"] = known ? toJson(g.origin) : Json();
  out["directions"] = known ? directions : Json();
  out["farCorner"] = known ? toJson(g.patientFromVoxel(glm::dvec3(g.size - 1))) : Json();
}

struct Values {
  double low = HUGE_VAL, high = -HUGE_VAL, mean = 0;
  Json crc;  // eight hexadecimal digits; null if the rescale is not whole
};

// Returns the CRC-32 of the real values: as 32-bit integers if all are whole, else as floats (little endian).
std::string crcOf(const Volume& volume, std::size_t count, bool whole) {
  uLong crc = crc32(0, nullptr, 0);
  std::vector<std::int32_t> block;
  constexpr std::size_t blockSize = 1 << 16;
  for (std::size_t n = 0; n < count; n += blockSize) {
    block.clear();
    for (std::size_t m = n; m < std::min(count, n + blockSize); ++m) {
      const float v = volume.valueAt(m);
      block.push_back(whole ? std::int32_t(v) : std::bit_cast<std::int32_t>(v));
    }
    crc = crc32(crc, reinterpret_cast<const Bytef*>(block.data()), uInt(block.size() * 4));
  }
  char text[16];
  std::snprintf(text, sizeof text, "%08lx", crc);
  return text;
}

Values valuesOf(const Volume& volume) {
  Values out;
  const std::size_t count = std::size_t(volume.geometry().voxelCount());
  bool whole = true;
  for (std::size_t n = 0; n < count; ++n) {
    const double v = volume.valueAt(n);
    out.low = std::min(out.low, v);
    out.high = std::max(out.high, v);
    out.mean += v;
    whole = whole && v == std::round(v) && std::abs(v) < 2147483648.0;
  }
  out.mean /= double(count);
  const bool wholeRescale =
      volume.slope() == std::round(volume.slope()) && volume.intercept() == std::round(volume.intercept());
  if (wholeRescale) out.crc = crcOf(volume, count, whole);
  return out;
}

// Adds the sentences of warnings, and their kinds.
void addWarnings(Json& out, const std::vector<Warning>& warnings) {
  out["warnings"] = out["warningKinds"] = Json::array();
  for (const Warning& w : warnings) {
    out["warnings"].push_back(w.sentence);
    out["warningKinds"].push_back(kindName(w.kind));
  }
}

void addIdentity(Json& out, const SeriesIdentity& s) {
  out["patient"] = {{"name", s.patientName},
                    {"id", s.patientId},
                    {"issuer", s.patientIdIssuer},
                    {"birthDate", isoDate(s.patientBirthDate)},
                    {"sex", s.patientSex}};
  out["study"] = {{"uid", s.studyUid},
                  {"date", isoDate(s.studyDate)},
                  {"time", s.studyTime},
                  {"accessionNumber", s.accessionNumber},
                  {"description", s.studyDescription}};
  out["seriesUid"] = s.seriesUid;
  out["frameOfReferenceUid"] = s.frameOfReferenceUid;
  out["modality"] = s.modality;
  out["description"] = s.description;
}

// Returns the available SUV factors, and the reason why others are missing; empty if the series is not PET.
Json suvJson(const SuvFactors& suv) {
  Json out;
  for (const auto& [key, factor] : {std::pair("bodyWeight", &suv.bodyWeight),
                                    {"leanBodyMass", &suv.leanBodyMass},
                                    {"bodySurface", &suv.bodySurface}})
    if (*factor) out[key] = **factor;
  if (!suv.why.empty()) out["why"] = suv.why;
  return out;
}

void addRegular(Json& out, const VoxelGeometry& grid, int interpolated) {
  out["regular"] = {
      {"dims", toJson(grid.size)}, {"spacing", toJson(grid.spacing())}, {"interpolatedSlices", interpolated}};
}

Json seriesJson(const Series& s) {
  Json out{{"id", s.id}, {"path", pathForJson(lastingPath(s.path))}, {"format", s.format}};
  addIdentity(out, s);
  out["series"] = {{"number", s.seriesNumber}, {"description", s.description}, {"files", s.files.size()}};
  addGeometry(out, s.acquired);
  out["valueType"] = s.valueType;
  for (const auto& [key, text] : {std::pair("echoTime", &s.echoTime), std::pair("bValue", &s.bValue),
                                  std::pair("timePoint", &s.timePoint), std::pair("label", &s.label)})
    if (!text->empty()) out[key] = *text;
  out["unit"] = s.unit;
  if (const Json suv = suvJson(s.suv); !suv.empty()) out["suv"] = suv;
  out["splitBy"] = Json::array();
  for (const SplitBy& by : s.splitBy)
    out["splitBy"].push_back({{"attribute", by.attribute}, {"value", by.value}, {"words", by.words}});
  if (s.regular) addRegular(out, s.regular->geometry, s.regular->interpolatedSlices);
  addWarnings(out, s.warnings);
  out["unread"] = unreadJson(s.unread);
  return out;
}

Json imageJson(const Image& image) {
  Json out{{"id", image.id}, {"path", pathForJson(lastingPath(image.path))}};
  addIdentity(out, image);
  out["sopInstanceUid"] = image.sopInstanceUid;
  out["frames"] = image.frames;
  out["rows"] = image.rows;
  out["columns"] = image.columns;
  out["photometric"] = image.photometric;
  out["notVolume"] = image.notVolume;
  return out;
}

// Loads the series and adds min .. crc32Values. The Error: its values cannot be read.
Status addValues(InfoSeries& entry, const Series& series, const CancelToken& cancel) {
  Json& out = entry.json;
  auto loaded = loadSeries(series, terminalProgress(), cancel);
  if (!loaded) return loaded.error();
  const Values v = valuesOf(*loaded->acquired);
  out["dims"] = toJson(loaded->acquired->size());
  out["valueType"] = loaded->acquired->typeName();
  addWarnings(out, loaded->warnings);
  entry.unread = loaded->unread;
  out["unread"] = unreadJson(entry.unread);
  if (loaded->drawn != loaded->acquired)
    addRegular(out, loaded->drawn->geometry(), loaded->interpolatedSlices());
  out["min"] = v.low;
  out["max"] = v.high;
  out["mean"] = v.mean;
  out["crc32Values"] = v.crc;
  return {};
}

// Describes every series, with its values if requested. A series with unreadable values is refused instead.
std::vector<InfoSeries> describe(Study& study, bool values, const CancelToken& cancel) {
  std::vector<InfoSeries> all;
  for (const Series& s : study.volumes) {
    InfoSeries entry{&s, seriesJson(s), s.unread};
    if (values) {
      if (Status added = addValues(entry, s, cancel); !added) {
        study.refused.push_back({s.path, added.message()});
        continue;
      }
    }
    all.push_back(std::move(entry));
  }
  endTerminalProgress();
  return all;
}

// Describes an object; with `values` also its contents, or the reason why they cannot be read.
Json describeDerivedObject(const DerivedObject& object, bool values) {
  Json out = derivedToJson(object);
  if (!values) return out;
  Result<Json> contents = contentsToJson(object);
  out[contents ? "contents" : "problem"] = contents ? std::move(*contents) : Json(contents.message());
  return out;
}

Json studyJson(const Study& study, const std::vector<InfoSeries>& series, bool values) {
  Json out{{"volumes", Json::array()},
           {"images", Json::array()},
           {"refused", Json::array()},
           {"other", Json::array()},
           {"references", Json::array()}};
  for (const InfoSeries& s : series) out["volumes"].push_back(s.json);
  for (const Image& image : study.images) out["images"].push_back(imageJson(image));
  for (const Refused& r : study.refused)
    out["refused"].push_back({{"path", pathForJson(lastingPath(r.path))}, {"reason", r.reason}});
  for (const Other& o : study.other)
    out["other"].push_back({{"path", pathForJson(lastingPath(o.path))}, {"kind", o.kind}});
  for (const DerivedObject& object : study.derived)
    out["references"].push_back(describeDerivedObject(object, values));
  return out;
}

int run(const InfoOptions& options, const CancelToken& cancel) {
  auto study = openPath(options.path, terminalProgress(), cancel);
  endTerminalProgress();
  if (!study) return fail(study.message(), cancel);
  const std::vector<InfoSeries> series = describe(*study, options.values, cancel);
  if (cancel.cancelled()) return fail({}, cancel);
  for (const InfoSeries& s : series)
    if (Status whole = checkStrict(s.series->path, s.unread); !whole) return fail(whole.message());
  if (options.json)
    std::cout << jsonText(studyJson(*study, series, options.values));
  else
    std::cout << infoText(*study, series, options.verbose);
  if (!series.empty() || !study->images.empty()) return exitDone;
  // Volumes that are there, but whose values cannot be read.
  if (!study->volumes.empty()) return fail(study->refused.back().reason);
  return fail("No images found in " + options.path + ".");
}

}  // namespace

std::function<int()> makeInfo(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<InfoOptions>();
  addPath(app, options->path)->required();
  app.add_flag("--json", options->json, "Write one JSON object to stdout");
  app.add_flag(
      "--values", options->values,
      "Read the pixels too: minimum, maximum, mean and checksum of the values; and what objects that "
      "refer to pictures hold");
  app.add_flag("--verbose", options->verbose, "Also ids, folders and every file that is not shown");
  addExamples(app, {"volumen info scans/", "volumen info scans/ --values --json"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
