#pragma once

#include <map>

#include "io/study/frame_series.h"
#include "ui/workspace/own_protocols.h"

namespace volumen::tests {

/// A series of a study of one patient.
struct HangSeries {
  const char *modality, *description;
  const char *part = "", *laterality = "", *view = "";
  const char* day = "20260301";
  int slices = 20;
};

inline Series madeFor(const HangSeries& s, int number) {
  Series series;
  series.modality = s.modality, series.description = s.description, series.bodyPart = s.part;
  series.laterality = s.laterality, series.viewPosition = s.view;
  series.studyDate = s.day, series.studyUid = std::string("1.2.") + s.day;
  series.patientId = "7", series.patientName = "Doe^Jane", series.format = "DICOM";
  series.seriesNumber = std::to_string(number);
  series.id = series.studyUid + "." + series.seriesNumber, series.seriesUid = series.id;
  series.path = "/data/" + series.id;
  series.frameOfReferenceUid = series.studyUid + ".1";
  series.acquired.size = {64, 64, s.slices};
  series.acquired.calibrated = s.slices > 1;
  series.unit = series.modality == "CT" ? "HU" : "";
  series.files.assign(std::size_t(s.slices), series.path + "/1");
  series.frames.assign(std::size_t(s.slices), 0);
  return series;
}

inline std::vector<const Series*> pointersTo(const std::vector<Series>& series) {
  std::vector<const Series*> all;
  for (const Series& s : series) all.push_back(&s);
  return all;
}

struct OpenPictures {
  std::vector<Series> series;

  explicit OpenPictures(const std::vector<HangSeries>& all) {
    for (const HangSeries& s : all) series.push_back(madeFor(s, int(series.size()) + 1));
  }
  /// Stacks all series of a day into one series.
  static OpenPictures stacked(const std::vector<HangSeries>& all) {
    std::map<std::string, std::vector<HangSeries>> byDay;
    for (const HangSeries& s : all) byDay[s.day].push_back(s);
    OpenPictures open({});
    for (auto day = byDay.rbegin(); day != byDay.rend(); ++day) {
      HangSeries whole = day->second.front();
      whole.slices = int(day->second.size());
      Series& stack = open.series.emplace_back(madeFor(whole, int(open.series.size()) + 1));
      stack.acquired.calibrated = false;
      std::vector<ProjectionView> views;
      for (std::size_t n = 0; n < day->second.size(); ++n) {
        stack.files[n] = std::to_string(n);
        views.push_back({day->second[n].laterality, day->second[n].view});
      }
      setProjections(stack, views);
    }
    return open;
  }
  std::vector<const Series*> pictures() const { return pointersTo(series); }
  PatientStudies studies(std::size_t current = 0) const { return studiesAround(pictures(), series[current]); }
};

inline HangSeries mammogramOf(const char* side, const char* view, const char* day = "20260301") {
  return {"MG", "MAMMO", "BREAST", side, view, day, 1};
}
inline HangSeries xRayOf(const char* view, const char* day = "20260301") {
  return {"DX", "Chest", "CHEST", "", view, day, 1};
}

inline const std::vector<HangSeries> fourBreasts{mammogramOf("L", "MLO"), mammogramOf("R", "CC"),
                                                 mammogramOf("R", "MLO"), mammogramOf("L", "CC")};
inline const std::vector<HangSeries> brainSeries{{"MR", "t1_mprage_sag"},
                                                 {"MR", "t2_tse_tra", "BRAIN"},
                                                 {"MR", "t2_flair_tra"},
                                                 {"MR", "ep2d_diff_trace"},
                                                 {"MR", "ep2d_diff_ADC"},
                                                 {"MR", "T1 tse tra +C"},
                                                 {"MR", "localizer", "", "", "", "20260301", 3}};

inline const HangingProtocol& protocolNamed(const KnownProtocols& known, const char* name) {
  for (const HangingProtocol& protocol : known.protocols)
    if (protocol.name == name) return protocol;
  qFatal("no protocol %s", name);
}

}  // namespace volumen::tests
