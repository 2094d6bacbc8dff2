#pragma once

#include <array>

#include "viewer/evaluation/accuracy_study.h"
#include "viewer/evaluation/progress.h"
#include "viewer/render/render.h"

namespace volumen {

// Tables 1 and 2, Figure 9 and section 4 of the paper, measured on this machine (`bench --paper`).

/// One of the five pictures of the tables: W x W pixels, samples a ray (0: one a voxel, "volume depth").
struct PaperPicture {
  int width = 0, samples = 0;
  bool operator==(const PaperPicture&) const = default;
};
extern const std::array<PaperPicture, 5> paperPictures;

/// The seven volumes of the tables, in their order: the three phantoms, lobster, silicon, MRI head, CT head.
constexpr int paperVolumes = 7;
extern const std::array<const char*, paperVolumes> paperVolumeNames;

/// What the paper measured, s: algorithm 1 (Planes) and 2 (Blend), by picture and volume.
double paperSeconds(Method method, int picture, int volume);

/// A volume that is measured: the paper's own phantom, or what stands in for one of its scans.
struct PaperVolume {
  int column = 0;    ///< of the paper's tables
  std::string name;  ///< what it really is
  VolumePtr volume;
  Scene scene;
};

/// The three phantoms exactly as the paper has them: 64^3, opacity 1/255, 4/255 and 1 per voxel, lit.
std::vector<PaperVolume> paperPhantoms();

struct PaperCell {
  Method method = Method::planes;
  int picture = 0, volume = 0;  ///< indices: paperPictures, and the volumes measured
  double medianMs = 0, minimumMs = 0;
};

/// Speed by threads: 128 x 128 pixels, 84 samples (Figure 9).
struct PaperThreads {
  int volume = 0, threads = 1;
  double medianMs = 0;
};

/// One size of the opaque sphere: 100 x 100 pixels, 100 samples.
struct PaperSize {
  int edge = 0;
  double medianMs = 0;
};

/// A method of the paper's section 4, on one scene.
struct PaperRival {
  std::string name, what;
  double medianMs = 0;
  PictureError own;      ///< against the reference of the picture that it means to draw
  PictureError against;  ///< against the reference of the lit, translucent picture
};

struct PaperBench {
  std::vector<PaperVolume> volumes;
  std::vector<PaperCell> cells;
  std::vector<PaperThreads> threads;
  std::vector<PaperSize> sizes;
  std::vector<PaperRival> rivals;
  std::string rivalsOn;  ///< volume and picture of the rivals
  std::string kernel;
};

struct PaperOptions {
  int rounds = 5;   ///< frames a figure, interleaved
  int threads = 0;  ///< of the tables; 0: all allowed
};

/// Measures all of it on `volumes` (the phantoms first). An Error: "cancelled" or the renderer's.
Result<PaperBench> measurePaper(std::vector<PaperVolume> volumes, const PaperOptions& options,
                                const StudyProgress& progress = {}, const CancelToken& cancel = {});

/// All tables as Markdown, for people.
std::string paperText(const PaperBench& bench, const std::string& machine, const std::string& date);
/// The cells of Tables 1 and 2: method, picture, volume, ms, the paper's seconds, speed-up.
std::string paperTablesCsv(const PaperBench& bench);
/// Figure 9: volume, threads, ms, speed-up.
std::string paperThreadsCsv(const PaperBench& bench);
/// Section 4: method, ms, errors.
std::string paperRivalsCsv(const PaperBench& bench);

/// Figure 3: a sphere lit directly in 8 bits a component beside the 4-index 5-bit table.
struct PaperFigure3 {
  Picture direct, table;
};
Result<PaperFigure3> drawFigure3(int edge);

}  // namespace volumen
