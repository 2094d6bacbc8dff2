#include "app/info_text.h"

#include <set>
#include <sstream>

#include "app/command.h"
#include "io/study/study.h"
#include "io/zip_archive.h"
#include "results/text/series_text.h"
#include "results/text/text.h"

namespace volumen {

namespace {

constexpr std::size_t fewFiles = 5;
constexpr const char* indent = "       ";

std::string patientLine(const Series& s) {
  if (s.format == "phantom") return "Phantoms";
  if (s.format != "DICOM") return "Files";
  return "Patient " + patientText(s).toStdString();
}

std::string studyLine(const Series& s) {
  return s.format == "DICOM" ? "  Study " + studyText(s).toStdString() : "";
}

std::string numberText(double value, int digits = 4) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string gridText(const Series& s) {
  const VoxelGeometry& g = s.acquired;
  std::ostringstream out;
  out << g.size.x << " x " << g.size.y << " x " << g.size.z << " voxels";
  if (g.calibrated) {
    const glm::dvec3 mm = g.spacing();
    out << " of " << numberText(mm.x) << " x " << numberText(mm.y) << " x " << numberText(mm.z) << " mm";
  }
  if (s.regular) out << " (in 3D: " << s.regular->geometry.size.z << " even slices)";
  out << ", " << s.valueType << ", " << s.format;
  const std::set<std::string> files(s.files.begin(), s.files.end());  // a file may hold several slices
  if (files.size() > 1) out << ", " << files.size() << " files";
  return out.str();
}

std::string nameLine(const Series& s, const std::vector<InfoSeries>& all) {
  std::vector<const Series*> namesakes;
  for (const InfoSeries& other : all)
    if (areNamesakes(*other.series, s)) namesakes.push_back(other.series);
  return (QStringList{seriesText(s)} + tellingApart(s, namesakes)).join(QStringLiteral(", ")).toStdString();
}

void addSeries(std::ostream& out, std::size_t n, const std::vector<InfoSeries>& all, bool verbose) {
  const Series& s = *all[n].series;
  const auto& json = all[n].json;
  out << "    " << n + 1 << "  " << printable(nameLine(s, all)) << '\n'
      << indent << printable(gridText(s)) << '\n';
  if (json.contains("min"))
    out << indent << "values " << numberText(json["min"], 7) << " to " << numberText(json["max"], 7)
        << (s.unit.empty() ? "" : ' ' + printable(s.unit)) << ", mean " << numberText(json["mean"], 7)
        << '\n';
  if (const ValueScale scale = valueScale(s, PetUnit::suvBodyWeight); s.modality == "PT") {
    out << indent << "unit " << printable(s.unit.empty() ? "not known" : s.unit);
    if (!scale.why.empty())
      out << " (" << printable(scale.why) << ")";
    else if (s.suv.bodyWeight)
      out << ", times " << numberText(scale.factor, 6) << " " << scale.unit;
    out << '\n';
  }
  if (verbose)
    out << indent << "id " << printable(s.id) << '\n'
        << indent << "in " << printable(lastingPath(s.path)) << '\n';
  for (const auto& warning : json["warnings"])
    out << indent << "! " << printable(warning.get<std::string>()) << '\n';
}

// Prints one file a line; only the first few unless `verbose`.
template <class Files, class Why>
void addFiles(std::ostream& out, const Files& files, bool verbose, Why why) {
  for (std::size_t n = 0; n < files.size(); ++n) {
    if (n == fewFiles && !verbose && files.size() > fewFiles + 1) {
      out << "  ... and " << files.size() - n << " more (--verbose lists all)\n";
      return;
    }
    out << "  " << printable(lastingPath(files[n].path)) << ": " << printable(why(files[n])) << '\n';
  }
}

std::string referenceLine(const DerivedObject& object) {
  std::ostringstream out;
  out << kindName(object.kind);
  for (const std::string& words : {object.label, object.text})
    if (!words.empty()) out << ", " << words;
  const std::size_t count = object.pictures.size();
  out << "; refers to " << count << (count == 1 ? " picture" : " pictures");
  if (object.notHere == 0) return out.str();
  out << (object.notHere < count ? ", of which " + std::to_string(object.notHere) : ", which")
      << (object.notHere == 1 ? " is not here" : " are not here");
  return out.str();
}

void addDerivedObjects(std::ostream& out, const std::vector<DerivedObject>& derived) {
  if (!derived.empty()) out << "Objects that refer to pictures\n";
  for (std::size_t n = 0; n < derived.size(); ++n) {
    out << "    " << n + 1 << "  " << printable(lastingPath(derived[n].path)) << ": "
        << printable(referenceLine(derived[n])) << '\n';
    for (const std::string& warning : derived[n].warnings)
      out << indent << "! " << printable(warning) << '\n';
  }
}

// Returns a study with the images and files that are not derived objects.
Study unshown(const Study& study) {
  Study rest;
  rest.images = study.images;
  rest.refused = study.refused;
  std::set<std::string> told;
  for (const DerivedObject& object : study.derived) told.insert(object.path);
  for (const Other& other : study.other)
    if (!told.contains(other.path)) rest.other.push_back(other);
  return rest;
}

std::string imageLine(const Image& image) {
  std::ostringstream out;
  out << image.columns << " x " << image.rows;
  if (image.frames > 1) out << ", " << image.frames << " frames";
  out << ", " << image.photometric << "; " << image.notVolume;
  return out.str();
}

}  // namespace

std::string infoText(const Study& study, const std::vector<InfoSeries>& series, bool verbose) {
  std::ostringstream out;
  std::string patient, when;
  for (std::size_t n = 0; n < series.size(); ++n) {
    const Series& s = *series[n].series;
    const bool samePatient = patientLine(s) == patient && n > 0;
    if (!samePatient) out << printable(patientLine(s)) << '\n';
    if (!samePatient || studyLine(s) != when)
      if (!studyLine(s).empty()) out << printable(studyLine(s)) << '\n';
    patient = patientLine(s), when = studyLine(s);
    addSeries(out, n, series, verbose);
  }
  addDerivedObjects(out, study.derived);
  const Study rest = unshown(study);
  const QString unread = noVolumesText(rest);
  if (unread.isEmpty()) return out.str();
  out << unread.toStdString() << '\n';
  addFiles(out, rest.images, verbose, imageLine);
  addFiles(out, rest.refused, verbose, [](const Refused& file) { return file.reason; });
  addFiles(out, rest.other, verbose, [](const Other& file) { return file.kind; });
  return out.str();
}

}  // namespace volumen
