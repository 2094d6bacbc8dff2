#include "app/commands/convert_volumes.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "app/open_volume.h"
#include "io/dicom/data_set.h"
#include "io/dicom/kept_headers.h"
#include "io/export/dicom_source.h"
#include "io/files/header_text.h"
#include "io/files/output_file.h"
#include "io/files/write_volume.h"
#include "io/paths/open_path.h"
#include "io/load.h"

namespace volumen {

namespace {

constexpr std::uint32_t repetitionTime = 0x00180080, triggerTime = 0x00181060,
                        frameReferenceTime = 0x00541300, gradientDirection = 0x00189089;

// Attributes of the first slice of a series.
struct Said {
  std::optional<double> repetitionMs, referenceMs, triggerMs;
  std::vector<double> direction;  // patient space; empty: missing
};

std::vector<double> numbersOf(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\\', begin), text.size());
    const auto number = dicom::parseNumber(text.substr(begin, end - begin));
    if (!number) return {};
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers;
}

// Reads the first slices of volumes. Each file is read once, even if several volumes begin in it.
class FirstSlices {
 public:
  explicit FirstSlices(const CancelToken& cancel) : cancel_(cancel) {}

  Said of(const Series& series) {
    if (series.format != "DICOM") return {};
    const std::string& path = series.files.front();
    auto at = sources_.find(path);
    if (at == sources_.end()) {
      Series first = series;
      first.files.resize(1), first.frames.resize(1);
      at = sources_.emplace(path, readDicomSource(first, {}, cancel_)).first;
    }
    if (!at->second) return {};
    const DicomSourceFile& file = at->second->files.front();
    const std::size_t frame = std::size_t(series.frames.front());
    if (frame >= file.frames.size()) return {};
    return saidBy(file, file.frames[frame]);
  }

 private:
  static Said saidBy(const DicomSourceFile& file, const DicomSourceFrame& frame) {
    const auto value = [&](std::uint32_t tag) {
      const std::string ofFrame = valueOf(frame.elements, tag);
      return ofFrame.empty() ? valueOf(file.elements, tag) : ofFrame;
    };
    Said said{dicom::parseNumber(value(repetitionTime)), dicom::parseNumber(value(frameReferenceTime)),
              dicom::parseNumber(value(triggerTime)), numbersOf(value(gradientDirection))};
    if (said.direction.size() != 3) said.direction.clear();
    return said;
  }

  const CancelToken& cancel_;
  std::map<std::string, Result<DicomSource>> sources_;  // keys: files
};

// Returns the step from one volume to the next if it is constant; 0 if it is not, or unknown.
double evenStep(const std::vector<Said>& said, std::optional<double> Said::*ms) {
  const double step = (said[1].*ms).value_or(0) - (said[0].*ms).value_or(0);
  for (std::size_t n = 1; n < said.size(); ++n) {
    const auto &before = said[n - 1].*ms, &after = said[n].*ms;
    if (!before || !after || std::abs(*after - *before - step) > 1e-3 * step) return 0;
  }
  return step;
}

// Takes the time step from reference times (PET) or trigger times. Without these, it is the repetition time
// (MR), if that is the same for all volumes.
double stepSeconds(const std::vector<Said>& said) {
  constexpr double second = 1000;  // ms
  for (const auto ms : {&Said::referenceMs, &Said::triggerMs}) {
    if (const double step = evenStep(said, ms); step > 0) return step / second;
    if (said[0].*ms != said[1].*ms) return 0;
  }
  const auto alike = [&](const Said& s) { return s.repetitionMs == said[0].repetitionMs; };
  return std::ranges::all_of(said, alike) ? said[0].repetitionMs.value_or(0) / second : 0;
}

// FSL's convention: directions relative to the voxel axes; the first is inverted if the axes are right-handed
// (in LPS as in RAS).
glm::dvec3 alongVoxels(const std::vector<double>& direction, const glm::dmat3& L) {
  const glm::dvec3 d(direction[0], direction[1], direction[2]);
  glm::dvec3 v;
  for (int a = 0; a < 3; ++a) v[a] = glm::dot(d, glm::normalize(L[a]));
  if (glm::determinant(L) > 0) v.x = -v.x;
  return v;
}

Status writeText(const std::string& path, const std::string& text) {
  auto out = OutputFile::create(path);
  if (!out) return out.error();
  if (Status s = out->write(text); !s) return s;
  return out->commit();
}

// Returns the b-values; empty if one is unknown or all are 0.
std::vector<double> bValuesOf(const std::vector<Series>& volumes) {
  std::vector<double> values;
  for (const Series& series : volumes) {
    const auto b = dicom::parseNumber(series.bValue);
    if (!b || !(*b >= 0)) return {};
    values.push_back(*b);
  }
  return std::ranges::max(values) > 0 ? values : std::vector<double>();
}

// Returns one line for each axis; empty if a weighted volume has no direction.
std::string directionsText(const std::vector<double>& b, const std::vector<Said>& said, const glm::dmat3& L) {
  std::string lines[3];
  for (std::size_t n = 0; n < b.size(); ++n) {
    if (said[n].direction.empty() && b[n] > 0) return {};
    const glm::dvec3 v = said[n].direction.empty() ? glm::dvec3(0) : alongVoxels(said[n].direction, L);
    for (int a = 0; a < 3; ++a) lines[a] += (n ? " " : "") + exactText(v[a] + 0.0);
  }
  return lines[0] + '\n' + lines[1] + '\n' + lines[2] + '\n';
}

Result<std::vector<std::string>> writeDiffusion(const std::vector<Series>& volumes,
                                                const std::vector<Said>& said, const glm::dmat3& L,
                                                const std::string& output) {
  const std::vector<double> b = bValuesOf(volumes);
  if (b.empty()) return std::vector<std::string>();
  const std::string stem = output.substr(0, output.size() - std::string(".nii.gz").size());
  std::string weights;
  for (std::size_t n = 0; n < b.size(); ++n) weights += (n ? " " : "") + exactText(b[n]);
  if (Status s = writeText(stem + ".bval", weights + '\n'); !s) return s.error();
  const std::string directions = directionsText(b, said, L);
  if (directions.empty())
    return std::vector{stem + ".bval holds the b values; their directions are not known."};
  if (Status s = writeText(stem + ".bvec", directions); !s) return s.error();
  return std::vector{stem + ".bval and .bvec hold the b values and their directions."};
}

}  // namespace

Result<std::vector<Series>> severalVolumes(const std::string& path, const std::string& series,
                                           const Progress& progress, const CancelToken& cancel) {
  std::vector<Series> volumes;
  if (series.empty()) return volumes;
  const Result<Study> study = openPath(path, progress, cancel);
  if (!study) return study.error();
  for (const std::size_t n : volumesOfUid(*study, series)) volumes.push_back(study->volumes[n]);
  return volumes;
}

Result<WrittenVolumes> writeVolumes(const std::vector<Series>& volumes, const std::string& output,
                                    const Progress& progress, const CancelToken& cancel) {
  const dicom::HeldHeaders held;
  FirstSlices firstSlices(cancel);
  std::vector<Said> said;
  for (const Series& series : volumes) said.push_back(firstSlices.of(series));
  const NiftiTime time{int(volumes.size()), stepSeconds(said)};
  WrittenVolumes written;
  std::vector<std::string>& notes = written.notes;
  glm::dmat3 L(1);
  const auto volumeAt = [&](int n) -> Result<VolumePtr> {
    const Result<Loaded> loaded = loadSeries(volumes[std::size_t(n)], {}, cancel);
    if (!loaded) return loaded.error();
    if (Status whole = checkLosses(volumes[std::size_t(n)].path, loaded->unread); !whole)
      return whole.error();
    addUnread(written.unread, loaded->unread);
    for (const Warning& w : loaded->warnings)
      if (std::ranges::find(notes, w.sentence) == notes.end()) notes.push_back(w.sentence);
    L = loaded->drawn->geometry().patientFromVoxelStep;
    return loaded->drawn;
  };
  if (Status s = writeNiftiVolumes(time, volumeAt, output, progress, cancel); !s) return s.error();
  const auto diffusion = writeDiffusion(volumes, said, L, output);
  if (!diffusion) return diffusion.error();
  notes.push_back(std::to_string(volumes.size()) + " volumes of series " + volumes[0].seriesUid +
                  " were written.");
  notes.insert(notes.end(), diffusion->begin(), diffusion->end());
  return written;
}

}  // namespace volumen
