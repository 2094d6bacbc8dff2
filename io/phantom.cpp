#include "io/phantom.h"

#include "io/files/sample_cache.h"
#include "viewer/phantoms/phantoms.h"

namespace volumen {
namespace {

constexpr std::string_view phantomPrefix = "phantom:", sampleStudy = "ct-head";

std::string phantomName(const std::string& path) { return path.substr(phantomPrefix.size()); }

}  // namespace

bool isPhantom(const std::string& path) { return path.starts_with(phantomPrefix); }

Result<Study> openPhantom(const std::string& path) {
  const Result<PhantomHeader> phantom = phantomHeader(phantomName(path));
  if (!phantom) return phantom.error();
  Series series;
  series.id = series.path = path;
  series.format = "phantom";
  series.description = phantomName(path);
  series.modality = phantom->modality;
  if (series.modality == "CT") series.unit = "HU";
  series.acquired = phantom->geometry;
  series.valueType = phantom->valueType;
  Study study;
  study.volumes.push_back(series);
  return study;
}

Result<Loaded> loadPhantom(const Series& series, const Progress& progress) {
  const std::string name = phantomName(series.path);
  if (progress) progress("making the phantom", 0, 0);
  Result<VolumePtr> volume = name == sampleStudy ? cachedPhantom(name, userCacheFolder()) : makePhantom(name);
  if (!volume) return volume.error();
  return Loaded{*volume, *volume, {}};
}

}  // namespace volumen
